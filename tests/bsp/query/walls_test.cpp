// SPDX-License-Identifier: Apache-2.0
//
// Points on splitting planes of the cell tree. No double is on one, so they are rationals: where
// edges pass through such planes, where faces meet one or two of them. What a leaf lists says
// nothing about its neighbours' cells, so these are the points at which leaves have to agree.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/bsp/query/index/index_core.h>

#include "support/query_oracle.h"
#include "support/random_result.h"

namespace {

using trisect::BrepIndex;
using trisect::ExactPoint;
using trisect::ExactRational;
using trisect::detail::IndexBase;
using trisect::detail::LeafInTree;

struct Wall {
    std::size_t axis = 0;
    ExactRational at;
};

std::vector<Wall> walls_of(const IndexBase& base) {
    std::vector<Wall> out;
    std::vector<const trisect::detail::CellNode*> pending{base.root().node.get()};
    while (!pending.empty()) {
        const auto& n = trisect::detail::refined(*pending.back());
        pending.pop_back();
        if (n.is_leaf()) continue;
        out.push_back(
            {static_cast<std::size_t>(n.axis()),
             ExactRational(n.splitter()) / ExactRational(trisect::detail::splitting_scale)});
        for (int i = 0; i < 2; ++i) pending.push_back(n.child(i).node.get());
    }
    return out;
}

// Where a closed polygon's sides pass through a wall.
std::vector<ExactPoint> cut(const std::vector<ExactPoint>& corners, const Wall& wall) {
    std::vector<ExactPoint> out;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const ExactPoint& a = corners[i];
        const ExactPoint& b = corners[(i + 1) % corners.size()];
        const ExactRational from = a[wall.axis] - wall.at;
        const ExactRational to = b[wall.axis] - wall.at;
        if (from.sign() * to.sign() >= 0) continue;
        const ExactRational t = from / (from - to);
        ExactPoint p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + t * (b[k] - a[k]);
        p[wall.axis] = wall.at;
        out.push_back(p);
    }
    return out;
}

std::vector<std::vector<ExactPoint>> polygons_of(const IndexBase& base) {
    std::vector<std::vector<ExactPoint>> out;
    for_tree_leaves(
        base, [](const auto&) { return true; },
        [&](const LeafInTree& leaf) {
            if (leaf.node.size() == 0) return;
            const auto& polygons = leaf.index().polygons();
            for (std::uint32_t id = 0; id < polygons.size(); ++id) {
                if (polygons.is_unbounded(id)) continue;
                std::vector<ExactPoint>& corners = out.emplace_back();
                for (const trisect::Point& c : polygons.corners(id))
                    corners.push_back(trisect::detail::IndexPoint(c).rational());
            }
        });
    return out;
}

class Comparison {
public:
    explicit Comparison(std::uint64_t seed) : result_(brute::random_result(seed, 4, true)) {}

    void run() {
        const IndexBase base(result_.solid);
        const BrepIndex index(result_.solid);
        const std::vector<Wall> walls = walls_of(base);
        for (const auto& corners : polygons_of(base))
            for (const Wall& wall : walls) {
                const std::vector<ExactPoint> on_wall = cut(corners, wall);
                for (const ExactPoint& p : on_wall) compare(index, p);
                if (on_wall.size() != 2) continue;
                for (const Wall& other : walls)
                    for (const ExactPoint& p : cut(on_wall, other)) {
                        compare(index, p);
                        ++on_two_walls;
                    }
                if (testing::Test::HasFailure()) return;
            }
    }
    std::size_t compared = 0;
    std::size_t on_two_walls = 0;
    std::size_t off_boundary = 0;

private:
    void compare(const BrepIndex& index, const ExactPoint& p) {
        // A result's lattice is that of its operands, of unit 1.
        const brute::Answer expected = result_.boundary.locate(
            {brute::rational(p[0]), brute::rational(p[1]), brute::rational(p[2])});
        const trisect::Place found = index.locate(p);
        EXPECT_TRUE(brute::agrees(found, expected, false))
            << brute::to_string(found) << " instead of " << brute::to_string(expected);
        ++compared;
        if (!found.is_on_boundary()) ++off_boundary;
    }

    brute::RandomResult result_;
};

TEST(SplittingPlanes, PointsOnThemAreWhereBruteForceSaysTheyAre) {
    std::size_t compared = 0;
    std::size_t on_two_walls = 0;
    std::size_t off_boundary = 0;
    for (std::uint64_t seed = 1; seed <= 600; ++seed) {
        SCOPED_TRACE(seed);
        Comparison comparison(seed);
        comparison.run();
        compared += comparison.compared;
        on_two_walls += comparison.on_two_walls;
        off_boundary += comparison.off_boundary;
        if (HasFailure()) return;
    }
    EXPECT_GT(compared, 10000U);
    EXPECT_GT(on_two_walls, 3000U);
    // Polygons that are listed whole where something has cut them away.
    EXPECT_GT(off_boundary, 20U);
}

}  // namespace
