// SPDX-License-Identifier: Apache-2.0
//
// Many things at one place: operands on one plane, bodies around one edge, a hundred edges at one
// vertex; and needles.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/measure.h>

#include "figures.h"

namespace valence_test {
namespace {

using degeneracy::checked_figures;
using degeneracy::cube;
using degeneracy::Figures;
using reference::Expression;
using reference::LatticePolygon;
using reference::Operand;
using Kind = Expression::Kind;

Expression all(Kind kind, std::size_t count) {
    std::vector<Expression> leaves;
    for (std::size_t i = 0; i < count; ++i) leaves.push_back(Expression::leaf(i));
    return Expression::node(kind, std::move(leaves));
}

// Box i stands on z = 0 from x = i to i + 2 and is 1, 2 or 3 high.
std::vector<Operand> skyline() {
    std::vector<Operand> out;
    for (std::int64_t i = 0; i < 20; ++i)
        out.push_back(reference::box({i, 0, 0}, {i + 2, 3, 1 + i % 3}));
    return out;
}

TEST(ManyOperands, TwentyBoxesOnOnePlane) {
    // Heights over [x, x+1]: 1, then max of boxes x-1 and x: 2 3 3 2 3 3 ..., and 2 at the end.
    std::vector<std::int64_t> heights;
    for (std::int64_t x = 0; x <= 20; ++x) {
        const std::int64_t own = x < 20 ? 1 + x % 3 : 0;
        const std::int64_t before = x > 0 ? 1 + (x - 1) % 3 : 0;
        heights.push_back(std::max(own, before));
    }
    const auto steps = static_cast<std::size_t>(
        std::inner_product(heights.begin(), heights.end() - 1, heights.begin() + 1, 0,
                           std::plus<>(), std::not_equal_to<>()));
    const std::int64_t section = std::accumulate(heights.begin(), heights.end(), std::int64_t{0});
    std::int64_t outline = 2 * 21 + heights.front() + heights.back();
    for (std::size_t i = 0; i + 1 < heights.size(); ++i)
        outline += std::abs(heights[i] - heights[i + 1]);
    // A prism over a polygon with two corners for each step and four at the ends.
    const std::size_t corners = 4 + 2 * steps;
    EXPECT_EQ(
        checked_figures(skyline(), all(Kind::Union, 20)),
        (Figures{2 * corners, 3 * corners, corners + 2, corners + 2, 1, std::to_string(3 * section),
                 static_cast<double>(2 * section + 3 * outline)}));
}

TEST(ManyOperands, TwentyBoxesOnOnePlaneInAnyFormula) {
    (void)checked_figures(skyline(), all(Kind::Xor, 20));
    (void)checked_figures(skyline(), all(Kind::Difference, 20));
    EXPECT_EQ(checked_figures(skyline(), all(Kind::Intersection, 20)), Figures{});
}

TEST(ManyOperands, TwentyFlushSlabsAreOneBox) {
    std::vector<Operand> slabs;
    for (std::int64_t i = 0; i < 20; ++i) slabs.push_back(reference::box({i, 0, 0}, {i + 1, 5, 7}));
    EXPECT_EQ(checked_figures(slabs, all(Kind::Union, 20)),
              (Figures{8, 12, 6, 6, 1, "700", 2 * (100 + 140 + 35)}));
    EXPECT_EQ(checked_figures(slabs, all(Kind::Xor, 20)),
              (Figures{8, 12, 6, 6, 1, "700", 2 * (100 + 140 + 35)}));
}

// The eight triangles of a square around its centre, as prisms of height 2.
std::vector<Operand> sectors(std::size_t first, std::size_t step) {
    constexpr std::array<std::array<std::int64_t, 2>, 8> rim{
        {{4, 0}, {4, 4}, {0, 4}, {-4, 4}, {-4, 0}, {-4, -4}, {0, -4}, {4, -4}}};
    std::vector<Operand> out;
    for (std::size_t i = first; i < 8; i += step)
        out.push_back(reference::prism({{0, 0}, rim[i], rim[(i + 1) % 8]}, 0, 2));
    return out;
}

TEST(AroundAnEdge, FourSectorsOfEightAreFourShells) {
    // One edge with eight faces, taken apart into four.
    const double area = 4 * (2 * 8 + 2 * (8 + 4 * std::sqrt(2.0)));
    EXPECT_EQ(checked_figures(sectors(0, 2), all(Kind::Union, 4)),
              (Figures{24, 36, 20, 20, 4, "64", area, 2, 1}));
}

TEST(AroundAnEdge, AllEightSectorsAreABox) {
    EXPECT_EQ(checked_figures(sectors(0, 1), all(Kind::Union, 8)),
              (Figures{8, 12, 6, 6, 1, "128", 192}));
}

TEST(AroundAVertex, EightOctantsInTurn) {
    // Four boxes of the eight around the origin, no two with a common face: they meet pairwise in
    // six edges and all in the origin.
    std::vector<Operand> boxes;
    for (int i = 0; i < 8; ++i) {
        if (((i ^ (i >> 1) ^ (i >> 2)) & 1) != 0) continue;
        reference::LatticePoint low;
        for (std::size_t k = 0; k < 3; ++k) low[k] = (i >> k & 1) != 0 ? 0 : -2;
        boxes.push_back(reference::box(low, {low[0] + 2, low[1] + 2, low[2] + 2}));
    }
    EXPECT_EQ(checked_figures(boxes, all(Kind::Union, 4)),
              (Figures{32, 48, 24, 24, 4, "32", 96, 7, 6}));
}

// ---------------------------------------------------------------------------------------------

// A convex polygon with 100 corners: 25 primitive vectors of a quadrant, turned four times.
LatticePolygon hundred_corners() {
    std::vector<std::array<std::int64_t, 2>> steps;
    for (std::int64_t s = 1; steps.size() < 25; ++s)
        for (std::int64_t x = s; x >= 1 && steps.size() < 25; --x)
            if (std::gcd(x, s - x) == 1) steps.push_back({x, s - x});
    std::sort(steps.begin(), steps.end(),
              [](const auto& a, const auto& b) { return a[0] * b[1] - a[1] * b[0] > 0; });
    LatticePolygon out;
    std::array<std::int64_t, 2> at{0, 0};
    for (int turn = 0; turn < 4; ++turn)
        for (auto& s : steps) {
            out.push_back(at);
            at = {at[0] + s[0], at[1] + s[1]};
            s = {-s[1], s[0]};
        }
    return out;
}

class HundredEdges : public ::testing::Test {
protected:
    HundredEdges() {
        for (const auto& c : base_) {
            low_ = std::min(low_, c[0]);
            high_ = std::max(high_, c[0]);
            top_ = std::max(top_, c[1]);
        }
        apex_ = {(low_ + high_) / 2, top_ / 2, 60};
        cone_ = reference::pyramid(base_, 0, apex_);
    }
    LatticePolygon base_ = hundred_corners();
    std::int64_t low_ = 0;
    std::int64_t high_ = 0;
    std::int64_t top_ = 0;
    reference::LatticePoint apex_{};
    Operand cone_;
};

TEST_F(HundredEdges, MeetInTheApex) {
    const trisect::Brep brep = trisect::evaluate(engines::solid(cone_)).to_brep();
    EXPECT_EQ(brep.counts().vertices, 101U);
    EXPECT_EQ(brep.counts().faces, 101U);
    std::size_t largest = 0;
    for (const trisect::VertexId v : brep.vertices())
        largest = std::max(largest, brep.outgoing_halfedges(v).size());
    EXPECT_EQ(largest, 100U);
}

TEST_F(HundredEdges, CutThroughTheApexByABox) {
    const Operand half = reference::box({apex_[0], -99, -1}, {999, 999, 99});
    const Figures kept =
        checked_figures({cone_, half}, reference::pair_expression(Kind::Intersection));
    const Figures rest =
        checked_figures({cone_, half}, reference::pair_expression(Kind::Difference));
    EXPECT_EQ(trisect::ExactRational::from_string(kept.volume) +
                  trisect::ExactRational::from_string(rest.volume),
              trisect::ExactRational::from_string(reference::signed_volume(cone_).get_str()));
    EXPECT_EQ(kept.shells, 1U);
    EXPECT_EQ(rest.shells, 1U);
    (void)checked_figures({cone_, half}, reference::pair_expression(Kind::Union));
    (void)checked_figures({cone_, half}, reference::pair_expression(Kind::Xor));
}

TEST_F(HundredEdges, CutThroughTheApexByThreePlanes) {
    const Operand octant = reference::box(apex_, {999, 999, 99});
    EXPECT_EQ(checked_figures({cone_, octant}, reference::pair_expression(Kind::Intersection)),
              Figures{});
    EXPECT_EQ(
        checked_figures({cone_, octant}, reference::pair_expression(Kind::Union)).vertex_contacts,
        1U);
    const Operand below = reference::box({apex_[0], apex_[1], -1}, {999, 999, 60});
    (void)checked_figures({cone_, below}, reference::pair_expression(Kind::Difference));
}

TEST_F(HundredEdges, TwoConesTipToTipAndInEachOther) {
    Operand other = cone_;
    for (auto& triangle : other) {
        for (auto& p : triangle) p[2] = 120 - p[2];
        std::swap(triangle[1], triangle[2]);
    }
    const Figures joined = checked_figures({cone_, other}, reference::pair_expression(Kind::Union));
    EXPECT_EQ(joined.vertices, 202U);
    EXPECT_EQ(joined.shells, 2U);
    EXPECT_EQ(joined.vertex_contacts, 1U);
    EXPECT_EQ(checked_figures({cone_, other}, reference::pair_expression(Kind::Intersection)),
              Figures{});
    // The same apex, another base: every face meets every other one in the apex.
    Operand smaller =
        reference::pyramid({{5, 5}, {apex_[0], 5}, {apex_[0] + 4, top_ - 9}}, 10, apex_);
    (void)checked_figures({cone_, smaller}, reference::pair_expression(Kind::Difference));
    (void)checked_figures({cone_, smaller}, reference::pair_expression(Kind::Xor));
}

// ---------------------------------------------------------------------------------------------

constexpr std::int64_t far_out = std::int64_t{1} << 40;

// A tetrahedron of length 2^41 and thickness 1 along axis x, y or z.
Operand needle(std::size_t turns) {
    return reference::axes_rotated(
        reference::tetrahedron({-far_out, 0, 0}, {far_out, 1, 0}, {far_out, 0, 1}, {far_out, 0, 0}),
        turns);
}

TEST(Needles, CrossEachOtherAndABox) {
    for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor}) {
        (void)checked_figures({needle(0), needle(1)}, reference::pair_expression(kind));
        (void)checked_figures({needle(0), cube(-3, 3)}, reference::pair_expression(kind));
        (void)checked_figures({cube(-3, 3), needle(2)}, reference::pair_expression(kind));
        (void)checked_figures({needle(0), needle(0)}, reference::pair_expression(kind));
    }
    (void)checked_figures({needle(0), needle(1), needle(2)}, all(Kind::Union, 3));
    (void)checked_figures({needle(0), needle(1), needle(2)}, all(Kind::Intersection, 3));
}

TEST(Needles, AlmostParallelSheets) {
    // Slabs whose top and bottom rise by one unit over 2^40: they cross in a very flat angle.
    const Operand rising = reference::axes_rotated(
        reference::prism({{-far_out, 0}, {far_out, 1}, {far_out, 3}, {-far_out, 2}}, 0, 4), 0);
    const Operand falling = reference::axes_rotated(
        reference::prism({{-far_out, 1}, {far_out, 0}, {far_out, 2}, {-far_out, 3}}, 0, 4), 0);
    for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor})
        (void)checked_figures({rising, falling}, reference::pair_expression(kind));
    // Bottom and top each bend once: a prism over a hexagon.
    EXPECT_EQ(
        checked_figures({rising, falling}, reference::pair_expression(Kind::Intersection)).vertices,
        12U);
}

}  // namespace
}  // namespace valence_test
