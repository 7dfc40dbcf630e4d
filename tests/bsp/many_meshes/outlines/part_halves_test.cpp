// SPDX-License-Identifier: Apache-2.0
//
// Boxes of both ends of a part whose middle is gone (part_halves.h).

#include <trisect/bsp/many_meshes/outlines/part_halves.h>

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/bsp/cells/outlined_facets.h>

namespace trisect::detail {
namespace {

// One facet with triangles as loops.
class Part {
public:
    void add_loop(double from, double to) {
        const auto first = static_cast<std::uint32_t>(vertices_.size());
        for (const Vector3& at : {Vector3{from, 0, 0}, Vector3{to, 0, 1}, Vector3{to, 1, 0}}) {
            OutlineVertex v;
            v.at.c = at;
            vertices_.push_back(v);
            box_.add(v.at);
        }
        for (std::uint32_t i = 0; i < 3; ++i)
            edges_.push_back({first + i, first + (i + 1) % 3, EdgeOrigin(i)});
    }
    [[nodiscard]] auto halves(double length_of_solid, bool whole = false) const {
        OutlinedSolid::Facet facet;
        facet.count = static_cast<std::uint32_t>(edges_.size());
        facet.whole = whole;
        OutlinedSolid solid;
        solid.vertices = vertices_;
        solid.edges = edges_;
        solid.box = {{0, 0, 0}, {length_of_solid, 1, 1}};
        return PartHalves(solid).of(facet, box_);
    }

private:
    std::vector<OutlineVertex> vertices_;
    std::vector<OutlinedSolid::Edge> edges_;
    OutlineBox box_ = OutlineBox::none();
};

TEST(PartHalves, OfBothEnds) {
    Part part;
    part.add_loop(0, 2);
    part.add_loop(9, 10);
    const auto halves = part.halves(10);
    ASSERT_TRUE(halves);
    EXPECT_EQ((*halves)[0].lo, (Vector3{0, 0, 0}));
    EXPECT_EQ((*halves)[0].hi, (Vector3{2, 1, 1}));
    EXPECT_EQ((*halves)[1].lo, (Vector3{9, 0, 0}));
    EXPECT_EQ((*halves)[1].hi, (Vector3{10, 1, 1}));
}

TEST(PartHalves, AreNotOfWhatIsWholeOrShortOrReachesOverTheMiddle) {
    Part ends;
    ends.add_loop(0, 2);
    ends.add_loop(9, 10);
    EXPECT_FALSE(ends.halves(10, true));
    EXPECT_TRUE(ends.halves(40));
    EXPECT_FALSE(ends.halves(41));
    ends.add_loop(4, 6);
    EXPECT_FALSE(ends.halves(10));
    Part one;
    one.add_loop(0, 2);
    EXPECT_FALSE(one.halves(2));
}

}  // namespace
}  // namespace trisect::detail
