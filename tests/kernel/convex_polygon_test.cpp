// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/convex_polygon.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include <trisect/kernel/counters.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>

#include "support/gmp_oracle.h"
#include "support/lattice_arithmetic.h"

namespace {

using trisect::ConvexPolygon;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::Point;
using trisect::Side;
using Classification = ConvexPolygon::Classification;

constexpr std::int64_t far = trisect::coordinate_limit - 1;

// Twice the area of the projection along an axis, positive when counter-clockwise seen from above
// the support; projections of polygons with one support add up exactly when the areas do.
mpq_class projected_area(const ConvexPolygon& polygon) {
    if (polygon.is_empty()) return 0;
    const int axis = polygon.support().dominant_axis();
    const auto j = static_cast<std::size_t>((axis + 1) % 3);
    const auto l = static_cast<std::size_t>((axis + 2) % 3);
    mpq_class sum = 0;
    oracle::RationalPoint before = oracle::rational(polygon.vertices().back());
    for (const Point& v : polygon.vertices()) {
        const oracle::RationalPoint here = oracle::rational(v);
        sum += before[j] * here[l] - before[l] * here[j];
        before = here;
    }
    return polygon.support().normal(axis) > 0 ? sum : mpq_class(-sum);
}

// Strict convexity and names of vertices, by GMP alone.
void expect_sound(const ConvexPolygon& polygon) {
    ASSERT_TRUE(polygon.is_consistent());
    const std::size_t n = polygon.size();
    ASSERT_GE(n, 3U);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n;
        const auto v = oracle::rational(polygon.vertex(i));
        EXPECT_EQ(v, oracle::rational(polygon.support(), polygon.edge(before), polygon.edge(i)));
        for (std::size_t k = 0; k < n; ++k)
            EXPECT_EQ(oracle::side(v, polygon.edge(k)), k == i || k == before ? 0 : -1);
    }
    EXPECT_GT(projected_area(polygon), 0);
}

// Cuts and checks everything that can be said about the outcome.
bool checked_split(const ConvexPolygon& polygon, const Plane& plane, ConvexPolygon& below,
                   ConvexPolygon& above) {
    Classification expected;
    for (const Point& v : polygon.vertices()) {
        const int s = oracle::side(oracle::rational(v), plane);
        ++(s < 0 ? expected.below : (s > 0 ? expected.above : expected.on));
    }
    EXPECT_EQ(polygon.classify(plane), expected);
    below = {};
    above = {};
    const Classification counts = polygon.split(plane, below, above);
    EXPECT_EQ(counts, expected);
    if (!counts.is_cut()) {
        EXPECT_TRUE(below.is_empty() && above.is_empty());
        return false;
    }
    expect_sound(below);
    expect_sound(above);
    // Every vertex that is On belongs to both, each crossing adds one to both.
    EXPECT_EQ(below.size(), counts.below + 2);
    EXPECT_EQ(above.size(), counts.above + 2);
    EXPECT_EQ(below.classify(plane), (Classification{counts.below, 2, 0}));
    EXPECT_EQ(above.classify(plane), (Classification{0, 2, counts.above}));
    EXPECT_EQ(projected_area(below) + projected_area(above), projected_area(polygon));
    const ConvexPolygon lower = polygon.clip_below(plane);
    const ConvexPolygon upper = polygon.clip_above(plane);
    EXPECT_EQ(projected_area(lower), projected_area(below));
    EXPECT_EQ(projected_area(upper), projected_area(above));
    EXPECT_EQ(lower.size(), below.size());
    EXPECT_EQ(upper.size(), above.size());
    return true;
}

ConvexPolygon square() {
    const std::vector<LatticePoint> corners{{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}};
    return ConvexPolygon::from_corners(Plane::axis_aligned(2, 1, 0), corners);
}

TEST(ConvexPolygon, EmptyIsOnNoSide) {
    const ConvexPolygon empty;
    EXPECT_TRUE(empty.is_empty());
    EXPECT_TRUE(empty.is_consistent());
    EXPECT_EQ(empty.classify(Plane::axis_aligned(0, 1, 0)), Classification{});
    EXPECT_FALSE(Classification{}.is_coplanar());
    EXPECT_TRUE(empty.flipped().is_empty());
    EXPECT_TRUE(empty.clip_below(Plane::axis_aligned(0, 1, 0)).is_empty());
}

TEST(ConvexPolygon, TrianglesOfEveryOrientation) {
    oracle::Source random(1);
    for (int round = 0; round < 2000; ++round) {
        const int bits = static_cast<int>(1 + random.below(53));
        const LatticePoint a = random.point(bits);
        const LatticePoint b = random.point(bits);
        const LatticePoint c = random.point(bits);
        if (trisect::are_collinear(a, b, c)) {
            EXPECT_THROW((void)ConvexPolygon::from_triangle(a, b, c), trisect::Error);
            continue;
        }
        const ConvexPolygon t = ConvexPolygon::from_triangle(a, b, c);
        expect_sound(t);
        EXPECT_EQ(t.vertex(0), Point(a));
        EXPECT_EQ(t.vertex(1), Point(b));
        EXPECT_EQ(t.vertex(2), Point(c));
        expect_sound(t.flipped());
        // The same triangle from its planes alone.
        const ConvexPolygon again(t.support(), {t.edges().begin(), t.edges().end()});
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(again.vertex(i), t.vertex(i));
    }
}

TEST(ConvexPolygon, FlippedTwiceIsTheSame) {
    const ConvexPolygon s = square();
    const ConvexPolygon f = s.flipped();
    expect_sound(f);
    EXPECT_EQ(f.vertex(0), s.vertex(0));
    EXPECT_EQ(f.vertex(1), s.vertex(3));
    EXPECT_EQ(f.support(), s.support().flipped());
    const ConvexPolygon g = f.flipped();
    for (std::size_t i = 0; i < s.size(); ++i) {
        EXPECT_EQ(g.vertex(i), s.vertex(i));
        EXPECT_EQ(g.edge(i), s.edge(i));
    }
}

TEST(ConvexPolygon, TouchingIsNoCut) {
    const ConvexPolygon s = square();
    ConvexPolygon below;
    ConvexPolygon above;
    // Along an edge, in both orientations.
    EXPECT_FALSE(checked_split(s, Plane::axis_aligned(0, 1, 0), below, above));
    EXPECT_FALSE(checked_split(s, Plane::axis_aligned(0, 1, 8), below, above));
    EXPECT_FALSE(checked_split(s, Plane::axis_aligned(0, 1, 8).flipped(), below, above));
    // In a corner.
    const Plane corner = Plane::along_axis({0, 16, 0}, {16, 0, 0}, 2);
    EXPECT_FALSE(checked_split(s, corner, below, above));
    EXPECT_EQ(s.classify(corner).on, 1U);
    // Coplanar and parallel.
    EXPECT_FALSE(checked_split(s, s.support(), below, above));
    EXPECT_TRUE(s.classify(s.support()).is_coplanar());
    EXPECT_TRUE(s.classify(Plane::axis_aligned(2, 5, 0).flipped()).is_coplanar());
    EXPECT_EQ(s.classify(Plane::axis_aligned(2, 2, 1)).side(), Side::Below);
    // Clipping keeps what touches from the kept side.
    EXPECT_TRUE(s.clip_below(Plane::axis_aligned(0, 1, 0)).is_empty());
    EXPECT_EQ(s.clip_above(Plane::axis_aligned(0, 1, 0)).size(), 4U);
    EXPECT_EQ(s.clip_below(s.support()).size(), 4U);
    EXPECT_EQ(s.clip_above(s.support()).size(), 4U);
    EXPECT_TRUE(s.clip_above(Plane::axis_aligned(2, 2, 1)).is_empty());
}

TEST(ConvexPolygon, CutsThroughCorners) {
    const ConvexPolygon s = square();
    ConvexPolygon below;
    ConvexPolygon above;
    ASSERT_TRUE(checked_split(s, Plane::along_axis({0, 0, 0}, {8, 8, 0}, 2), below, above));
    EXPECT_EQ(below.size(), 3U);
    EXPECT_EQ(above.size(), 3U);
    ASSERT_TRUE(checked_split(s, Plane::along_axis({0, 8, 0}, {8, 0, 0}, 2), below, above));
    EXPECT_EQ(below.size() + above.size(), 6U);
    // Through one corner and the opposite edge.
    ASSERT_TRUE(checked_split(s, Plane::along_axis({0, 0, 0}, {8, 3, 0}, 2), below, above));
    EXPECT_EQ(below.size() + above.size(), 7U);
    // Tilted planes with the same trace give the same pieces.
    const Plane tilted = Plane::through({0, 0, 0}, {8, 8, 0}, {3, 0, 5});
    ASSERT_TRUE(checked_split(s, tilted, below, above));
    EXPECT_EQ(below.size(), 3U);
}

TEST(ConvexPolygon, OutputsMayBeTheInput) {
    ConvexPolygon s = square();
    ConvexPolygon above;
    const mpq_class whole = projected_area(s);
    EXPECT_TRUE(s.split(Plane::axis_aligned(0, 1, 3), s, above).is_cut());
    EXPECT_EQ(projected_area(s) * 8, whole * 3);
    EXPECT_TRUE(above.split(Plane::axis_aligned(1, 1, 3), s, above).is_cut());
    expect_sound(s);
    expect_sound(above);
}

TEST(ConvexPolygon, NamedVerticesNeedNoArithmetic) {
    const ConvexPolygon t = ConvexPolygon::from_triangle({0, 0, 0}, {7, 1, 2}, {1, 9, 4});
    const Plane cut = Plane::through({1, 0, 1}, {2, 7, 0}, {1, 1, 5});
    ConvexPolygon below;
    ConvexPolygon above;
    ASSERT_TRUE(t.split(cut, below, above).is_cut());
    const trisect::Diagnostics<trisect::PredicateCounters> diagnostics;
    EXPECT_EQ(above.classify(cut).on, 2U);
    EXPECT_EQ(above.classify(cut.flipped()).on, 2U);
    EXPECT_EQ(diagnostics.counters().exact_narrow, 0U);
    EXPECT_EQ(diagnostics.counters().exact_wide, 0U);
    EXPECT_EQ(diagnostics.counters().symbolic, 4U);
}

// Cuts everything by everything; area must be conserved to the last digit.
void cascade(const ConvexPolygon& start, const std::vector<Plane>& planes, std::size_t limit) {
    std::vector<ConvexPolygon> pieces{start};
    const mpq_class whole = projected_area(start);
    for (const Plane& plane : planes) {
        std::vector<ConvexPolygon> next;
        for (const ConvexPolygon& piece : pieces) {
            ConvexPolygon below;
            ConvexPolygon above;
            if (next.size() < limit && checked_split(piece, plane, below, above)) {
                next.push_back(below);
                next.push_back(above);
            } else {
                next.push_back(piece);
            }
        }
        pieces.swap(next);
    }
    mpq_class sum = 0;
    for (const ConvexPolygon& piece : pieces) sum += projected_area(piece);
    EXPECT_EQ(sum, whole);
}

// A rectangle in the plane 2 x_j = x_l, from x_j = 1/100 to 301/100, as long as the lattice along
// `axis`. Its corners are so far out that doubles cannot tell them from planes nearby.
ConvexPolygon upright_strip(int axis) {
    const int j = (axis + 1) % 3;
    const int l = (axis + 2) % 3;
    std::array<trisect::Int128, 3> n{};
    n[static_cast<std::size_t>(j)] = trisect::Int128{2} << 20;
    n[static_cast<std::size_t>(l)] = -(trisect::Int128{1} << 20);
    const std::int64_t scale = 1 << 12;
    return {
        Plane(n[0], n[1], n[2], Plane::Coefficient()),
        {Plane::axis_aligned(axis, scale, scale << 49), Plane::axis_aligned(j, 100, 1).flipped(),
         Plane::axis_aligned(axis, scale, -(scale << 49)).flipped(),
         Plane::axis_aligned(j, 100, 301)}};
}

// The plane with one of its four coefficients changed by so much.
Plane with_other_coefficient(const Plane& p, int coefficient, int change) {
    std::array<Plane::Coefficient, 3> n{p.normal(0), p.normal(1), p.normal(2)};
    Plane::Coefficient d = p.offset();
    if (coefficient < 3)
        n[static_cast<std::size_t>(coefficient)] += change;
    else
        d += change;
    return {n[0], n[1], n[2], d};
}

TEST(ConvexPolygon, PlanesThatDifferInOneCoefficientFromThoseOfAVertexFarOut) {
    for (int axis = 0; axis < 3; ++axis) {
        const ConvexPolygon strip = upright_strip(axis);
        ASSERT_TRUE(strip.is_consistent());
        for (std::size_t i = 0; i < 4; ++i) {
            const auto v = oracle::rational(strip.vertex(i));
            for (const Plane& named : {strip.support(), strip.edge((i + 3) % 4), strip.edge(i)})
                for (const Plane& p : {named, named.flipped()}) {
                    const trisect::Diagnostics<trisect::PredicateCounters> by_name;
                    EXPECT_EQ(strip.side_of_vertex(i, p), Side::On);
                    EXPECT_EQ(by_name.counters().symbolic, 1U);
                    for (int coefficient = 0; coefficient < 4; ++coefficient)
                        for (const int change : {-1, 1}) {
                            const Plane other = with_other_coefficient(p, coefficient, change);
                            EXPECT_EQ(static_cast<int>(strip.side_of_vertex(i, other)),
                                      oracle::side(v, other))
                                << axis << ' ' << i << ' ' << coefficient;
                        }
                }
        }
    }
}

TEST(ConvexPolygon, CascadesOnSmallGridsHitCornersAndEdges) {
    oracle::Source random(2);
    for (int round = 0; round < 60; ++round) {
        const int bits = static_cast<int>(1 + random.below(3));
        LatticePoint a;
        LatticePoint b;
        LatticePoint c;
        do {
            a = random.point(bits + 1);
            b = random.point(bits + 1);
            c = random.point(bits + 1);
        } while (trisect::are_collinear(a, b, c));
        std::vector<Plane> planes;
        for (int k = 0; k < 8; ++k) planes.push_back(random.plane(bits));
        for (int k = 0; k < 3; ++k) planes.push_back(Plane::axis_aligned(k, 2, 1));
        cascade(ConvexPolygon::from_triangle(a, b, c), planes, 24);
    }
}

TEST(ConvexPolygon, CascadesAtEverySize) {
    oracle::Source random(3);
    for (const int bits : {8, 16, 25, 26, 40, 53}) {
        for (int round = 0; round < 4; ++round) {
            std::vector<Plane> planes;
            for (int k = 0; k < 8; ++k) planes.push_back(random.plane(bits));
            const LatticePoint a = random.point(bits);
            const LatticePoint b = random.point(bits);
            const LatticePoint c = random.point(bits);
            if (trisect::are_collinear(a, b, c)) continue;
            cascade(ConvexPolygon::from_triangle(a, b, c), planes, 24);
        }
    }
}

TEST(ConvexPolygon, PlanesOfOneLineFan) {
    // Many planes through one line that crosses the triangle: after the first cut every plane
    // passes through the same two points, so nothing more is cut but the fan's two sides.
    const ConvexPolygon t = ConvexPolygon::from_triangle({0, 0, 0}, {64, 0, 0}, {0, 64, 0});
    std::vector<Plane> planes;
    for (std::int64_t h = 1; h < 12; ++h)
        planes.push_back(Plane::through({3, -5, 0}, {20, 70, 0}, {40, 0, h}));
    std::vector<ConvexPolygon> pieces{t};
    for (const Plane& plane : planes) {
        std::vector<ConvexPolygon> next;
        for (const ConvexPolygon& piece : pieces) {
            ConvexPolygon below;
            ConvexPolygon above;
            if (checked_split(piece, plane, below, above)) {
                next.push_back(below);
                next.push_back(above);
            } else {
                next.push_back(piece);
            }
        }
        pieces.swap(next);
    }
    EXPECT_EQ(pieces.size(), 2U);
}

TEST(ConvexPolygon, TinyAndNeedleTriangles) {
    // Unit triangles far away from the origin, cut between lattice points.
    const LatticePoint o{far - 1, -far, far - 2};
    const ConvexPolygon t =
        ConvexPolygon::from_triangle(o, {o.x + 1, o.y, o.z}, {o.x, o.y + 1, o.z + 1});
    expect_sound(t);
    ConvexPolygon below;
    ConvexPolygon above;
    ASSERT_TRUE(checked_split(t, Plane::axis_aligned(0, 2, 2 * o.x + 1), below, above));
    ConvexPolygon corner;
    ASSERT_TRUE(checked_split(below, Plane::axis_aligned(1, 4, 4 * o.y + 1), corner, above));
    // A needle as long as the lattice and less than a unit wide.
    const ConvexPolygon needle =
        ConvexPolygon::from_triangle({-far, -far, -far}, {far, far, far}, {1, 0, 0});
    expect_sound(needle);
    ASSERT_TRUE(checked_split(needle, Plane::axis_aligned(0, 2, 1), below, above));
    cascade(
        needle,
        {Plane::axis_aligned(0, 2, 1), Plane::through({far, -far, far}, {-far, far, 1}, {1, 2, 3}),
         Plane::through({far, far, -far}, {-far, 5, far}, {0, 0, 1}),
         Plane::through({-far, -far, far}, {far, far, far - 1}, {0, 1, 0})},
        16);
}

TEST(ConvexPolygon, TooFewEdgesAreRefused) {
    const ConvexPolygon s = square();
    EXPECT_THROW(ConvexPolygon(s.support(), {s.edge(0), s.edge(1)}), trisect::Error);
    // Parallel neighbours share no point.
    EXPECT_THROW(ConvexPolygon(s.support(), {s.edge(0), s.edge(2), s.edge(1)}), trisect::Error);
}

TEST(ConvexPolygon, EdgesInClockwiseOrderAreInconsistent) {
    const ConvexPolygon s = square();
    try {
        EXPECT_FALSE(ConvexPolygon(s.support(), {s.edge(3), s.edge(2), s.edge(1), s.edge(0)})
                         .is_consistent());
    } catch (const trisect::Error&) {  // audit builds refuse it at once
    }
}

}  // namespace
