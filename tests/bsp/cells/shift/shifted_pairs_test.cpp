// SPDX-License-Identifier: Apache-2.0
//
// Facets of a mesh that is moved by less than any number (shifted_pairs.h), against the same facets
// on a grid that is so fine that it can be moved by a little.

#include <trisect/bsp/cells/shift/shifted_pairs.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace {

using trisect::LatticePoint;
using trisect::detail::coplanar_overlap;
using trisect::detail::FacetCorners;
using trisect::detail::InfinitesimalShift;
using trisect::detail::order_along_shifted;
using trisect::detail::Overlap;
using trisect::detail::relate_exactly;
using trisect::detail::relate_in_doubles;
using trisect::detail::relate_shifted;
using trisect::detail::ShiftedPair;
using trisect::detail::side_of_shifted;

using Corner = std::array<std::int64_t, 3>;
using Triangle = std::array<Corner, 3>;

// Determinants of the small grid and the centre of growth are below 2^12; so one of three corners
// changes less by a shift along one axis than by the smallest one along the axis before it, or by
// growth, and by none as much as from one number to the next.
constexpr std::int64_t scale = std::int64_t{1} << 48;
constexpr std::int64_t growth = std::int64_t{1} << 36;
constexpr std::array<std::int64_t, 3> steps{std::int64_t{1} << 24, std::int64_t{1} << 12, 1};

FacetCorners corners(const std::array<LatticePoint, 3>& points) {
    return {&points[0], &points[1], &points[2]};
}

std::array<LatticePoint, 3> points_of(const Triangle& t) {
    std::array<LatticePoint, 3> out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = {t[i][0], t[i][1], t[i][2]};
    return out;
}

Triangle fine(Triangle t, const InfinitesimalShift* shift) {
    for (Corner& c : t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t from_centre =
                shift == nullptr ? 0 : c[k] - shift->centre[static_cast<int>(k)].to_integer();
            c[k] = c[k] * scale;
            if (shift != nullptr) c[k] += shift->growth * growth * from_centre;
        }
    for (Corner& c : t)
        for (std::size_t k = 0; shift != nullptr && k < 3; ++k)
            c[shift->axes[k]] += shift->signs[k] * steps[k];
    return t;
}

// Along the axes by powers of two that leave no bits unused. What is in special position stays so.
std::array<LatticePoint, 3> stretched(const std::array<LatticePoint, 3>& points) {
    std::array<LatticePoint, 3> out;
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = {trisect::Coordinate(points[i].x.to_double() * 0x1p-73),
                  trisect::Coordinate(points[i].y.to_double() * 0x1p49),
                  trisect::Coordinate(points[i].z.to_double() * 0x1p-20)};
    return out;
}

InfinitesimalShift stretched(InfinitesimalShift shift) {
    shift.centre = stretched({shift.centre, {}, {}})[0];
    return shift;
}

bool has_area(const Triangle& t) {
    Corner u;
    Corner v;
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = t[1][k] - t[0][k];
        v[k] = t[2][k] - t[0][k];
    }
    return u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0];
}

class Triangles {
public:
    explicit Triangles(std::uint32_t seed) : random_(seed) {}
    Triangle next(std::int64_t size) {
        while (true) {
            Triangle t;
            for (Corner& c : t)
                for (std::int64_t& x : c)
                    x = static_cast<std::int64_t>(random_() % static_cast<std::uint32_t>(size));
            if (has_area(t)) return t;
        }
    }
    InfinitesimalShift shift() {
        InfinitesimalShift s;
        std::shuffle(s.axes.begin(), s.axes.end(), random_);
        for (std::int8_t& sign : s.signs) sign = random_() % 2 == 0 ? 1 : -1;
        s.growth = static_cast<std::int8_t>(static_cast<int>(random_() % 3) - 1);
        const Triangle centre = next(4);
        s.centre = {centre[0][0], centre[0][1], centre[0][2]};
        return s;
    }

private:
    std::mt19937 random_;
};

TEST(ShiftedPairs, AreRelatedAsThoseThatAreMoved) {
    std::array<int, 4> kinds{};
    int touching = 0;
    for (std::uint32_t seed = 0; seed < 20000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Triangles random(seed);
        const std::int64_t size = 2 + seed % 4;
        const Triangle a = random.next(size);
        const Triangle b = random.next(size);
        const InfinitesimalShift shift = random.shift();
        const auto at_a = points_of(a);
        const auto at_b = points_of(b);
        const ShiftedPair pair = relate_shifted(corners(at_a), corners(at_b), shift);
        ++kinds[static_cast<std::size_t>(pair.kind)];
        touching += pair.touches ? 1 : 0;
        const auto wide_a = stretched(at_a);
        const auto wide_b = stretched(at_b);
        const ShiftedPair wide = relate_shifted(corners(wide_a), corners(wide_b), stretched(shift));
        EXPECT_EQ(wide.kind, pair.kind);
        EXPECT_EQ(wide.touches, pair.touches);
        EXPECT_EQ(wide.is_above, pair.is_above);
        EXPECT_EQ(wide.same_side, pair.same_side);
        if (pair.kind == ShiftedPair::Kind::Coplanar) {
            EXPECT_EQ(side_of_shifted(corners(at_a), shift), pair.is_above ? 1 : -1);
            EXPECT_EQ(side_of_shifted(corners(wide_a), stretched(shift)), pair.is_above ? 1 : -1);
            EXPECT_EQ(coplanar_overlap(corners(wide_a), corners(wide_b)),
                      coplanar_overlap(corners(at_a), corners(at_b)));
        }
        const auto fine_a = points_of(fine(a, nullptr));
        const auto fine_b = points_of(fine(b, &shift));
        const ShiftedPair moved = relate_shifted(corners(fine_a), corners(fine_b), shift);
        EXPECT_FALSE(moved.touches);
        const bool crosses = pair.kind == ShiftedPair::Kind::Crossing;
        ASSERT_EQ(moved.kind, crosses ? ShiftedPair::Kind::Crossing : ShiftedPair::Kind::Apart);
        for (std::size_t k = 0; crosses && k < 2; ++k) {
            EXPECT_EQ(pair.ends[k].of_second, moved.ends[k].of_second);
            EXPECT_EQ(pair.ends[k].edge, moved.ends[k].edge);
            EXPECT_EQ(pair.ends[k].of_second, wide.ends[k].of_second);
            EXPECT_EQ(pair.ends[k].edge, wide.ends[k].edge);
            EXPECT_EQ(pair.ends[k].corner, wide.ends[k].corner);
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_NEAR(pair.ends[k].at.c[i] * static_cast<double>(scale),
                            moved.ends[k].at.c[i], 0x1p45);
            if (pair.ends[k].corner < 0) continue;
            const auto& own = pair.ends[k].of_second ? at_b : at_a;
            const LatticePoint& corner = own[static_cast<std::size_t>(pair.ends[k].corner)];
            EXPECT_EQ(pair.ends[k].at.c, corner.doubles());
        }
    }
    EXPECT_GT(*std::ranges::min_element(kinds), 10);
    EXPECT_GT(touching, 1000);
}

void expect_equal(const ShiftedPair& pair, const ShiftedPair& other) {
    ASSERT_EQ(pair.kind, other.kind);
    EXPECT_EQ(pair.touches, other.touches);
    EXPECT_EQ(pair.is_above, other.is_above);
    EXPECT_EQ(pair.same_side, other.same_side);
    for (std::size_t k = 0; pair.kind == ShiftedPair::Kind::Crossing && k < 2; ++k) {
        EXPECT_EQ(pair.ends[k].of_second, other.ends[k].of_second);
        EXPECT_EQ(pair.ends[k].edge, other.ends[k].edge);
        EXPECT_EQ(pair.ends[k].corner, other.ends[k].corner);
        const double error = pair.ends[k].at.error + other.ends[k].at.error;
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(pair.ends[k].at.c[i], other.ends[k].at.c[i], error);
    }
}

// Corners on a small grid, or each of them a little beside it, one unit or all digits.
TEST(ShiftedPairs, DoublesAgreeWithIntegersWhereTheyDecide) {
    int decided = 0;
    int open = 0;
    std::mt19937 beside(1);
    for (std::uint32_t seed = 0; seed < 20000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Triangles random(seed + 40000);
        const auto place = [&](const Triangle& t) {
            std::array<LatticePoint, 3> out = points_of(t);
            if (seed % 3 == 0) return out;
            for (LatticePoint& p : out) {
                const auto moved = [&](trisect::Coordinate c) {
                    const double by = static_cast<double>(beside() % 3) - 1;
                    return trisect::Coordinate(c.to_double() * 0x1p40 +
                                               by * (seed % 3 == 1 ? 1.0 : 0x1p-12));
                };
                p = {moved(p.x), moved(p.y), moved(p.z)};
            }
            return out;
        };
        const std::int64_t size = 2 + seed % 4;
        const auto a = place(random.next(size));
        const auto b = place(random.next(size));
        const InfinitesimalShift shift = random.shift();
        const auto pair = relate_in_doubles(corners(a), corners(b), shift);
        ++(pair ? decided : open);
        const ShiftedPair expected = relate_exactly(corners(a), corners(b), shift);
        if (pair) expect_equal(*pair, expected);
        expect_equal(relate_shifted(corners(a), corners(b), shift), expected);
    }
    EXPECT_GT(decided, 10000);
    EXPECT_GT(open, 100);
}

// The upper edges of a prism's walls in a face of a plate, all digits used.
TEST(ShiftedPairs, DoublesDecideWallsThatEndInAFace) {
    std::mt19937 random(5);
    const auto digits = [&](double from, double to) {
        return trisect::Coordinate(from + (to - from) * (static_cast<double>(random()) * 0x1p-32));
    };
    const trisect::Coordinate top(0x1p40 / 3);
    for (int i = 0; i < 1000; ++i) {
        SCOPED_TRACE(i);
        const std::array<LatticePoint, 3> face{
            LatticePoint{digits(-0x1p41, -0x1p40), digits(-0x1p41, -0x1p40), top},
            LatticePoint{digits(0x1p40, 0x1p41), digits(-0x1p41, -0x1p40), top},
            LatticePoint{digits(-0x1p41, -0x1p40), digits(0x1p40, 0x1p41), top}};
        const LatticePoint p{digits(-0x1p39, 0), digits(-0x1p39, 0), top};
        const LatticePoint q{digits(-0x1p39, 0), digits(-0x1p39, 0), top};
        const std::array<LatticePoint, 3> wall{p, q, {q.x, q.y, digits(-0x1p40, 0)}};
        InfinitesimalShift shift;
        shift.growth = i % 2 == 0 ? 1 : -1;
        shift.centre = {digits(-0x1p39, 0), digits(-0x1p39, 0), digits(-0x1p40, 0)};
        const auto pair = relate_in_doubles(corners(face), corners(wall), shift);
        ASSERT_TRUE(pair.has_value());
        EXPECT_TRUE(pair->kind == ShiftedPair::Kind::Apart || i % 2 == 0);
        expect_equal(*pair, relate_exactly(corners(face), corners(wall), shift));
    }
}

// Edges of a facet that meet those of its mirror image, all digits of whole coordinates used, or of
// fractions.
TEST(ShiftedPairs, DoublesDecideEdgesThatMeetEdges) {
    std::mt19937_64 random(7);
    int touching = 0;
    int crossing = 0;
    for (int i = 0; i < 3000; ++i) {
        SCOPED_TRACE(i);
        const int bits = i % 3 == 0 ? 30 : 50;  // by 128 bits, and by more
        const auto digits = [&] {
            return static_cast<std::int64_t>(random() >> (63 - bits)) - (std::int64_t{1} << bits);
        };
        std::array<LatticePoint, 3> a;
        const double unit = i % 2 == 0 ? 1 : 0x1p-60;
        const auto at = [&] { return trisect::Coordinate(static_cast<double>(digits()) * unit); };
        for (LatticePoint& p : a) p = {at(), at(), at()};
        std::array<LatticePoint, 3> b = a;
        const auto axis = static_cast<int>(random() % 3);
        for (LatticePoint& p : b) {
            std::array<trisect::Coordinate, 3> c{p.x, p.y, p.z};
            c[static_cast<std::size_t>(axis)] = -c[static_cast<std::size_t>(axis)];
            p = {c[0], c[1], c[2]};
        }
        std::swap(b[1], b[2]);
        InfinitesimalShift shift;
        std::swap(shift.axes[0], shift.axes[random() % 3]);
        for (std::int8_t& sign : shift.signs) sign = random() % 2 == 0 ? 1 : -1;
        const auto pair = relate_in_doubles(corners(a), corners(b), shift);
        ASSERT_TRUE(pair.has_value());
        expect_equal(*pair, relate_exactly(corners(a), corners(b), shift));
        touching += pair->touches ? 1 : 0;
        crossing += pair->kind == ShiftedPair::Kind::Crossing ? 1 : 0;
    }
    EXPECT_GT(touching, 1000);
    EXPECT_GT(crossing, 500);
}

// Where an edge goes through two facets that have a point of it in common.
TEST(ShiftedPairs, EdgesGoThroughFacetsInTheOrderOfThoseThatAreMoved) {
    int equal = 0;
    int compared = 0;
    for (std::uint32_t seed = 0; seed < 200000 && compared < 2000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Triangles random(seed);
        const Triangle f = random.next(3);
        const std::array<Triangle, 2> others{random.next(3), random.next(3)};
        const InfinitesimalShift shift = random.shift();
        const bool is_second = seed % 2 == 0;
        const auto own = points_of(f);
        const std::array cutters{points_of(others[0]), points_of(others[1])};
        // Both cross the facet with an end on its first edge.
        bool both = true;
        for (const auto& c : cutters) {
            const ShiftedPair pair = is_second ? relate_shifted(corners(c), corners(own), shift)
                                               : relate_shifted(corners(own), corners(c), shift);
            const auto is_on_first = [&](const auto& end) {
                return end.of_second == is_second && end.edge == 0;
            };
            both = both && pair.kind == ShiftedPair::Kind::Crossing &&
                   std::ranges::any_of(pair.ends, is_on_first);
        }
        if (!both) continue;
        ++compared;
        const int order = order_along_shifted(own[0], own[1], is_second, corners(cutters[0]),
                                              corners(cutters[1]), shift);
        const std::array wide_cutters{stretched(cutters[0]), stretched(cutters[1])};
        const auto wide = stretched(own);
        EXPECT_EQ(order, order_along_shifted(wide[0], wide[1], is_second, corners(wide_cutters[0]),
                                             corners(wide_cutters[1]), stretched(shift)));
        const auto fine_own = points_of(fine(f, is_second ? &shift : nullptr));
        const std::array fine_cutters{points_of(fine(others[0], is_second ? nullptr : &shift)),
                                      points_of(fine(others[1], is_second ? nullptr : &shift))};
        EXPECT_EQ(order,
                  order_along_shifted(fine_own[0], fine_own[1], is_second, corners(fine_cutters[0]),
                                      corners(fine_cutters[1]), InfinitesimalShift{}));
        equal += order == 0 ? 1 : 0;
    }
    EXPECT_GT(compared, 500);
    EXPECT_GT(equal, 0);  // facets of one plane
}

TEST(ShiftedPairs, CoplanarFacetsOverlapOrHaveOnlyOutlinesInCommon) {
    const auto square = points_of({{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}});
    const auto beside = points_of({{{2, 0, 0}, {2, 2, 0}, {0, 2, 0}}});
    const auto over = points_of({{{1, 0, 0}, {2, 2, 0}, {0, 2, 0}}});
    const auto within = points_of({{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}}});
    const auto apart = points_of({{{3, 0, 0}, {3, 2, 0}, {2, 2, 0}}});
    const auto overlap = [](const auto& a, const auto& b) {
        EXPECT_EQ(coplanar_overlap(corners(a), corners(b)),
                  coplanar_overlap(corners(b), corners(a)));
        return coplanar_overlap(corners(a), corners(b));
    };
    EXPECT_EQ(overlap(square, apart), Overlap::None);
    EXPECT_EQ(overlap(square, beside), Overlap::Outlines);
    EXPECT_EQ(overlap(square, over), Overlap::Insides);
    EXPECT_EQ(overlap(square, within), Overlap::Insides);
}

}  // namespace
