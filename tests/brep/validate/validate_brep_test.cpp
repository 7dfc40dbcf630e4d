// SPDX-License-Identifier: Apache-2.0
//
// Boundaries whose holes lie inside, outside and beside their faces. Whether a hole is outside is
// known from the cells of a coarse grid that the outlines are drawn on.

#include <trisect/brep/validate/validate.h>

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <utility>

#include "support/breps.h"
#include "support/lattice_arithmetic.h"

namespace {

using namespace trisect;
using namespace trisect::test;

using Map = std::array<std::array<std::int64_t, 3>, 3>;

constexpr Map upright{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Map slanted{{{1, 0, 0}, {0, 1, 0}, {1, 2, 1}}};
constexpr Map lying{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
constexpr Map upside_down{{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}};

LatticePoint mapped(const Map& m, const LatticePoint& p) {
    const auto row = [&](std::size_t i) { return m[i][0] * p.x + m[i][1] * p.y + m[i][2] * p.z; };
    return {row(0), row(1), row(2)};
}

Polygon mapped(const Map& m, Polygon polygon) {
    for (LatticePoint& p : polygon) p = mapped(m, p);
    return polygon;
}

// A prism with a square tunnel, wherever the tunnel is.
Brep tunnel(const Polygon& outline, const Polygon& square, const Map& map) {
    constexpr std::int64_t height = 5;
    SolidSketch s;
    for (const Polygon& loop : {outline, reversed(square)}) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const LatticePoint a = loop[i];
            const LatticePoint b = loop[(i + 1) % loop.size()];
            const LatticePoint up{0, 0, height};
            s.face({mapped(map, {a, b, b + up, a + up})});
        }
    }
    s.face({mapped(map, reversed(outline)), mapped(map, square)});
    s.face({mapped(map, lifted(outline, height)), mapped(map, lifted(reversed(square), height))});
    return s.build();
}

// Outlines with corners at multiples of 6, and the cells of side 6 that they bound.
struct Shape {
    Polygon outline;
    std::set<std::pair<std::int64_t, std::int64_t>> cells;
};

const Shape u_shape{{{0, 0, 0},
                     {18, 0, 0},
                     {18, 18, 0},
                     {12, 18, 0},
                     {12, 6, 0},
                     {6, 6, 0},
                     {6, 18, 0},
                     {0, 18, 0}},
                    {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {2, 1}, {0, 2}, {2, 2}}};
const Shape s_shape{
    {{18, 6, 0}, {18, 12, 0}, {6, 12, 0}, {6, 6, 0}, {0, 6, 0}, {0, 0, 0}, {12, 0, 0}, {12, 6, 0}},
    {{0, 0}, {1, 0}, {1, 1}, {2, 1}}};

std::int64_t cell_of(std::int64_t x) { return (x + 60) / 6 - 10; }

TEST(ValidateBrep, SquareHolesInsideOutsideAndAlongSidesOfOutlines) {
    std::size_t inside = 0;
    std::size_t outside = 0;
    for (const Shape& shape : {u_shape, s_shape}) {
        for (const Map& map : {upright, slanted, lying, upside_down}) {
            for (std::int64_t x = -4; x <= 20; ++x) {
                for (std::int64_t y = -4; y <= 20; ++y) {
                    // Within one cell, perhaps along its sides, not in its corners.
                    const bool in_cell =
                        cell_of(x) == cell_of(x + 1) && cell_of(y) == cell_of(y + 1);
                    const bool at_corner =
                        (x % 6 == 0 || (x + 2) % 6 == 0) && (y % 6 == 0 || (y + 2) % 6 == 0);
                    if (!in_cell || at_corner) continue;
                    const Polygon square = rectangle(x, y, x + 2, y + 2);
                    const bool expected = !shape.cells.contains({cell_of(x), cell_of(y)});
                    const auto report = validate(tunnel(shape.outline, square, map));
                    EXPECT_EQ(report.count(DefectKind::HoleOutsideFace), expected ? 2U : 0U)
                        << x << " " << y;
                    EXPECT_EQ(report.is_solid(), !expected);
                    ++(expected ? outside : inside);
                }
            }
        }
    }
    EXPECT_GT(inside, 500U);
    EXPECT_GT(outside, 1000U);
}

TEST(ValidateBrep, HoleOutsideIsNamedWithItsPlace) {
    const auto report = validate(tunnel(rectangle(0, 0, 6, 6), rectangle(8, 1, 10, 3), upright));
    ASSERT_EQ(report.defects().size(), 2U);
    const Defect& d = report.defects()[1];
    EXPECT_EQ(d.kind, DefectKind::HoleOutsideFace);
    EXPECT_EQ(d.severity(), Severity::Error);
    ASSERT_EQ(d.faces.size(), 1U);
    EXPECT_EQ(d.faces[0], 9U);
    EXPECT_EQ(d.place[2], 5.0);
    EXPECT_NE(d.sentence.find("a hole of face 9"), std::string::npos) << d.sentence;
}

// A box whose lid is two coplanar faces that meet at x = edge/2; a tunnel belongs to the left one.
Brep divided_lid(std::int64_t twice_edge, const Polygon& square) {
    SolidSketch s;
    const Plane across = Plane::axis_aligned(0, 2, twice_edge);
    const auto on_edge = [&](std::int64_t y) {
        // A lattice point where it is one, as from the library's own arrangements.
        if (twice_edge % 2 == 0) return s.vertex({twice_edge / 2, y, 5});
        return s.builder().add_vertex(
            Point(across, Plane::axis_aligned(1, 1, y), Plane::axis_aligned(2, 1, 5)));
    };
    const auto ids = [&](const Polygon& p) {
        std::vector<std::uint32_t> out;
        for (const LatticePoint& q : p) out.push_back(s.vertex(q));
        return out;
    };
    const std::uint32_t front = on_edge(0);
    const std::uint32_t back = on_edge(18);
    const auto v = ids(rectangle(0, 0, 18, 18));
    const auto w = ids(lifted(rectangle(0, 0, 18, 18), 5));
    const Plane top = Plane::axis_aligned(2, 1, 5);
    BrepBuilder& b = s.builder();
    b.add_face(Plane::axis_aligned(1, 1, 0).flipped(), {{v[0], v[1], w[1], front, w[0]}}, {});
    b.add_face(Plane::axis_aligned(0, 1, 18), {{v[1], v[2], w[2], w[1]}}, {});
    b.add_face(Plane::axis_aligned(1, 1, 18), {{v[2], v[3], w[3], back, w[2]}}, {});
    b.add_face(Plane::axis_aligned(0, 1, 0).flipped(), {{v[3], v[0], w[0], w[3]}}, {});
    b.add_face(top, {{front, w[1], w[2], back}}, {});
    b.add_face(top, {{w[0], front, back, w[3]}, ids(lifted(reversed(square), 5))}, {});
    b.add_face(Plane::axis_aligned(2, 1, 0).flipped(), {{v[3], v[2], v[1], v[0]}, ids(square)}, {});
    s.walls(reversed(square), 5);
    return s.build();
}

TEST(ValidateBrep, HoleBeyondAnEdgeBetweenCoplanarFaces) {
    const auto count = [](std::int64_t twice_edge, std::int64_t x) {
        return validate(divided_lid(twice_edge, rectangle(x, 8, x + 2, 10)))
            .count(DefectKind::HoleOutsideFace);
    };
    EXPECT_EQ(count(12, 2), 0U);
    EXPECT_EQ(count(12, 4), 0U);  // along the edge, inside
    EXPECT_EQ(count(12, 6), 1U);  // along the edge, outside
    EXPECT_EQ(count(12, 9), 1U);
    EXPECT_EQ(count(12, 20), 2U);
}

// No plane but the common one of the two faces knows where their edge is.
TEST(ValidateBrep, HoleBeyondAnEdgeOffTheLatticeBetweenCoplanarFacesIsNotJudged) {
    EXPECT_EQ(validate(divided_lid(13, rectangle(2, 8, 4, 10))).defects().size(), 0U);
    EXPECT_EQ(validate(divided_lid(13, rectangle(9, 8, 11, 10))).defects().size(), 0U);
}

TEST(ValidateBrep, CubesAndTheEmptyBoundaryHaveNoDefects) {
    EXPECT_TRUE(validate(Brep()).empty());
    EXPECT_TRUE(validate(cube(3)).empty());
}

}  // namespace
