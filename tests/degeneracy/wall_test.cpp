// SPDX-License-Identifier: Apache-2.0
//
// Walls of the partition lie off the lattice, but vertices and edges of a result can lie exactly in
// them: at 127/256 of a unit, for example. Nothing of it may show.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <trisect/bsp/cells/work_budget.h>

#include "figures.h"

namespace wall_test {
namespace {

using degeneracy::checked_figures;
using degeneracy::Figures;
using degeneracy::octahedron;
using reference::Operand;
using Kind = reference::Expression::Kind;

// Runs body for walls at many offsets and for small leaves.
template <class Body>
void for_all_walls(Body&& body) {
    for (const std::uint32_t offset : {1U, 61U, 127U, 191U})
        for (const std::uint32_t leaf : {1U, 4U, 10U}) {
            SCOPED_TRACE("wall offset " + std::to_string(offset) + ", leaf size " +
                         std::to_string(leaf));
            trisect::EvaluateOptions options;
            const trisect::detail::SplittingOffset at(offset);
            options.leaf_polygons = leaf;
            body(options);
        }
}

// x = 127 y and x = 1 - 65 y meet at (127/192, 1/192). The bodies lie below these lines and the box
// that they share runs from -127 to 128, so that the first wall is x = 0 + offset / 192.
struct SlopesThatMeetInAWall {
    Operand a = reference::prism({{-127, -1}, {127, 1}, {128, 1}, {128, -5}, {-127, -5}}, 0, 2);
    Operand b = reference::prism({{131, -2}, {-129, 2}, {-129, -5}, {131, -5}}, 0, 2);

    [[nodiscard]] Operand turned(const Operand& o, std::size_t turns) const {
        return reference::axes_rotated(o, turns);
    }
};

TEST(Walls, AnEdgeOfTheResultLiesInAWall) {
    const SlopesThatMeetInAWall s;
    for (const std::size_t turns : {0U, 1U, 2U})
        for_all_walls([&](const trisect::EvaluateOptions& options) {
            for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor})
                (void)checked_figures({s.turned(s.a, turns), s.turned(s.b, turns)},
                                      reference::pair_expression(kind), options);
        });
}

TEST(Walls, AVertexOfTheResultLiesInAWall) {
    const SlopesThatMeetInAWall s;
    // A third slope cuts the common edge at z = 1/3, and walls of other axes run through it.
    const Operand cut = reference::tetrahedron({-9, -9, 0}, {9, -9, 1}, {-9, 9, 0}, {0, 0, 40});
    for_all_walls([&](const trisect::EvaluateOptions& options) {
        (void)checked_figures(
            {s.a, s.b, cut},
            reference::Expression::node(Kind::Difference, {reference::pair_expression(Kind::Union),
                                                           reference::Expression::leaf(2)}),
            options);
    });
}

TEST(Walls, OctahedraOverlapInAnOctahedron) {
    // |y| + |z| < 4 - max(|x|, |x - 4|): the octahedron of radius 2 about (2, 0, 0).
    for_all_walls([&](const trisect::EvaluateOptions& options) {
        EXPECT_EQ(checked_figures({octahedron({0, 0, 0}, 4), octahedron({4, 0, 0}, 4)},
                                  reference::pair_expression(Kind::Intersection), options),
                  (Figures{6, 12, 8, 8, 1, "32/3", 16 * std::sqrt(3.0)}));
    });
}

TEST(Walls, OctahedraInGeneralPositionsOnTheLattice) {
    reference::Random random(77);
    for (int round = 0; round < 6; ++round) {
        const reference::LatticePoint centre{random.between(-5, 5), random.between(-5, 5),
                                             random.between(-5, 5)};
        const std::int64_t radius = random.between(2, 6);
        for_all_walls([&](const trisect::EvaluateOptions& options) {
            for (const Kind kind : {Kind::Union, Kind::Xor})
                (void)checked_figures({octahedron({0, 0, 0}, 5), octahedron(centre, radius)},
                                      reference::pair_expression(kind), options);
        });
    }
}

// Two coplanar triangles that face each other, larger than the cells: in every cell the one speaks
// for both, and so it must be the same one in all of them.
TEST(Walls, CoincidentFacetsReachAcrossWalls) {
    const Operand below = reference::prism({{0, 0}, {61, 7}, {11, 59}}, 0, 9);
    const Operand above = reference::pyramid({{5, 3}, {64, 31}, {2, 47}}, 9, {20, 20, 30});
    const Operand flush = reference::prism({{-3, 10}, {40, -6}, {50, 40}, {8, 52}}, 4, 9);
    for_all_walls([&](const trisect::EvaluateOptions& options) {
        for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor}) {
            (void)checked_figures({below, above}, reference::pair_expression(kind), options);
            (void)checked_figures({below, flush}, reference::pair_expression(kind), options);
        }
    });
}

// Both halves of a cut lie in one tree: the next operation must not see the wall between them.
TEST(Walls, FacesCutByWallsAreOneAgain) {
    for_all_walls([&](const trisect::EvaluateOptions& options) {
        trisect::Solid s = engines::solid(degeneracy::cube(0, 64));
        for (const std::int64_t x : {8, 24, 40}) {
            const auto bite = engines::solid(reference::box({x, 8, 60}, {x + 8, 16, 70}));
            s = trisect::evaluate(s - bite, options);
        }
        // Three pockets: 8 vertices and 5 faces each, and three holes in the top.
        EXPECT_EQ(
            degeneracy::figures(s.to_brep()),
            (Figures{32, 48, 21, 24, 1, std::to_string(262144 - 3 * 256), 24576 + 3 * 4 * 32}));
    });
}

}  // namespace
}  // namespace wall_test
