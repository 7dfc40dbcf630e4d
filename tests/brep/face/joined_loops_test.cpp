// SPDX-License-Identifier: Apache-2.0
//
// Holes joined to outlines by bridges, and parted again.
#include <trisect/brep/joined_loops.h>

#include <algorithm>

#include <gtest/gtest.h>

namespace {

using namespace trisect;

/// Rings of squares around each other do not nest here: `holes` small squares in a row in a large
/// one.
struct Plate {
    std::vector<Point> points;
    std::vector<IndexLoop> loops;

    explicit Plate(int holes) {
        add(0, 0, 10 * holes, 10, false);
        for (int i = 0; i < holes; ++i) add(10 * i + 3, 3, 10 * i + 6, 7, true);
    }
    void add(int x0, int y0, int x1, int y1, bool clockwise) {
        const auto first = static_cast<std::uint32_t>(points.size());
        const auto point = [&](int x, int y) { points.emplace_back(LatticePoint{x, y, 0}); };
        point(x0, y0);
        point(x1, y0);
        point(x1, y1);
        point(x0, y1);
        IndexLoop loop{first, first + 1, first + 2, first + 3};
        if (clockwise) std::reverse(loop.begin() + 1, loop.end());
        loops.push_back(loop);
    }
    [[nodiscard]] std::vector<IndexTriangle> triangles() const {
        return triangulate(Plane::through({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), points, loops);
    }
};

/// Each loop with its least corner first, in the order of these.
std::vector<IndexLoop> sorted(std::vector<IndexLoop> loops) {
    for (IndexLoop& l : loops)
        std::rotate(l.begin(), std::min_element(l.begin(), l.end()), l.end());
    std::sort(loops.begin(), loops.end());
    return loops;
}

TEST(JoinedLoops, BackAndForth) {
    for (const int holes : {1, 2, 3, 40}) {
        const Plate plate(holes);
        const auto joined = joined_loops(plate.loops, plate.triangles());
        ASSERT_TRUE(joined);
        // Two corners more for each bridge.
        EXPECT_EQ(joined->size(), plate.points.size() + 2 * static_cast<std::size_t>(holes));
        EXPECT_EQ(joined->front(), 0U);
        EXPECT_EQ(sorted(parted_loops(*joined)), sorted(plate.loops));
    }
}

TEST(JoinedLoops, OneLoop) {
    const IndexLoop loop{4, 2, 7};
    const std::vector<IndexLoop> loops{loop};
    EXPECT_EQ(joined_loops(loops, {}), loop);
    EXPECT_EQ(parted_loops(loop), loops);
}

TEST(JoinedLoops, Nothing) {
    const Plate plate(2);
    EXPECT_FALSE(joined_loops(plate.loops, {}));
    // Two faces apart are not joined.
    const Plate one(1);
    std::vector<IndexLoop> loops{one.loops[0], {4, 5, 6, 7}};
    const std::vector<IndexTriangle> triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
    EXPECT_FALSE(joined_loops(loops, triangles));
}

TEST(PartedLoops, KeepsWhatItCannotPart) {
    // A spike, and a polygon that touches itself.
    const IndexLoop spike{0, 1, 2, 1, 3};
    EXPECT_EQ(parted_loops(spike), (std::vector<IndexLoop>{spike}));
    const IndexLoop touching{0, 1, 2, 3, 1, 4};
    EXPECT_EQ(parted_loops(touching), (std::vector<IndexLoop>{touching}));
}

}  // namespace
