// SPDX-License-Identifier: Apache-2.0
//
// Facets of a mesh each corner of which moves by less than any number (corner_moves.h), against the
// same facets on a grid that is so fine that corners can be moved by a little.

#include <trisect/bsp/cells/shift/shifted_pairs.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <trisect/bsp/cells/shift/corner_moves.h>

namespace moved_corners_test {

namespace {

using trisect::LatticePoint;
using trisect::detail::CornerMoves;
using trisect::detail::FacetCorners;
using trisect::detail::InfinitesimalShift;
using trisect::detail::order_along_shifted;
using trisect::detail::passage_shifted;
using trisect::detail::relate_exactly;
using trisect::detail::relate_in_doubles;
using trisect::detail::relate_shifted;
using trisect::detail::ShiftedPair;
using trisect::detail::side_of_shifted;

using Vector = std::array<std::int32_t, 3>;
using Corners = std::array<Vector, 3>;
using Points = std::array<LatticePoint, 3>;

// Products of two determinants of the small grid and of moves are below 2^22.
constexpr std::int64_t scale = std::int64_t{1} << 48;
constexpr std::int64_t step = std::int64_t{1} << 24;

FacetCorners corners(const Points& points) { return {&points[0], &points[1], &points[2]}; }

Points points_of(const Corners& t) {
    Points out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = {t[i][0], t[i][1], t[i][2]};
    return out;
}

Points fine(const Corners& t, const Corners& moves) {
    Points out;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto at = [&](std::size_t k) { return scale * t[i][k] + step * moves[i][k]; };
        out[i] = {at(0), at(1), at(2)};
    }
    return out;
}

// Along the axes by different powers of two, and moves likewise.
Points stretched(const Points& points) {
    Points out;
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = {trisect::Coordinate(points[i].x.to_double() * 0x1p-73),
                  trisect::Coordinate(points[i].y.to_double() * 0x1p-45),
                  trisect::Coordinate(points[i].z.to_double() * 0x1p-70)};
    return out;
}

Corners stretched(Corners moves) {
    for (Vector& v : moves) {
        v[1] *= 1 << 28;
        v[2] *= 8;
    }
    return moves;
}

// Of the points of an array.
struct Moves {
    CornerMoves moves;
    InfinitesimalShift shift;

    Moves(const Points& points, const Corners& by, InfinitesimalShift along)
        : moves{points.data(), {by.begin(), by.end()}}, shift(along) {
        shift.moves = &moves;
    }
    Moves(const Moves&) = delete;
    Moves& operator=(const Moves&) = delete;
};

bool has_area(const Corners& t) {
    const auto side = [&](std::size_t i, std::size_t k) { return t[i][k] - t[0][k]; };
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        if (side(1, u) * side(2, v) != side(1, v) * side(2, u)) return true;
    }
    return false;
}

class Triangles {
public:
    explicit Triangles(std::uint32_t seed) : random_(seed) {}
    Corners vectors(std::int32_t low, std::int32_t high) {
        Corners t;
        const auto size = static_cast<std::uint32_t>(high - low);
        for (Vector& c : t)
            for (std::int32_t& x : c) x = low + static_cast<std::int32_t>(random_() % size);
        return t;
    }
    Corners next(std::int32_t size) {
        Corners t;
        do {
            t = vectors(0, size);
        } while (!has_area(t));
        return t;
    }
    // Often none at all, or the same for all corners.
    Corners moves() {
        const std::uint32_t kind = random_() % 8;
        Corners out = vectors(-3, 4);
        if (kind == 0) out = {};
        if (kind == 1) out[1] = out[2] = out[0];
        return out;
    }
    InfinitesimalShift shift() {
        InfinitesimalShift s;
        std::shuffle(s.axes.begin(), s.axes.end(), random_);
        for (std::int8_t& sign : s.signs) sign = random_() % 2 == 0 ? 1 : -1;
        return s;
    }

private:
    std::mt19937 random_;
};

void expect_near(const ShiftedPair& pair, const ShiftedPair& moved) {
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(pair.ends[k].of_second, moved.ends[k].of_second);
        EXPECT_EQ(pair.ends[k].edge, moved.ends[k].edge);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(pair.ends[k].at.c[i] * static_cast<double>(scale), moved.ends[k].at.c[i],
                        0x1p45 + pair.ends[k].at.error * static_cast<double>(scale));
    }
}

TEST(MovedCorners, PairsAreRelatedAsThoseThatAreMoved) {
    std::array<int, 4> kinds{};
    int torn = 0;
    int in_doubles = 0;
    for (std::uint32_t seed = 0; seed < 30000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Triangles random(seed);
        const auto size = static_cast<std::int32_t>(2 + seed % 4);
        const Corners a = random.next(size);
        const Corners b = random.next(size);
        const Corners moves = random.moves();
        const InfinitesimalShift along = random.shift();
        const Points at_a = points_of(a);
        const Points at_b = points_of(b);
        const Moves moving(at_b, moves, along);
        const ShiftedPair pair = relate_shifted(corners(at_a), corners(at_b), moving.shift);
        const auto near = relate_in_doubles(corners(at_a), corners(at_b), moving.shift);
        in_doubles += near ? 1 : 0;
        for (const ShiftedPair& other :
             {relate_exactly(corners(at_a), corners(at_b), moving.shift), near.value_or(pair)}) {
            EXPECT_EQ(pair.kind, other.kind);
            EXPECT_EQ(pair.touches, other.touches);
            EXPECT_EQ(pair.is_torn, other.is_torn);
            EXPECT_EQ(pair.is_above, other.is_above);
        }
        ++kinds[static_cast<std::size_t>(pair.kind)];
        torn += pair.is_torn ? 1 : 0;
        const Points wide_a = stretched(at_a);
        const Points wide_b = stretched(at_b);
        const Moves wide_moving(wide_b, stretched(moves), along);
        const ShiftedPair wide =
            relate_shifted(corners(wide_a), corners(wide_b), wide_moving.shift);
        EXPECT_EQ(wide.kind, pair.kind);
        EXPECT_EQ(wide.touches, pair.touches);
        EXPECT_EQ(wide.is_torn, pair.is_torn);
        EXPECT_EQ(wide.is_above, pair.is_above);
        const Points fine_a = fine(a, {});
        const Points fine_b = fine(b, moves);
        const ShiftedPair moved = relate_shifted(corners(fine_a), corners(fine_b), along);
        if (pair.kind == ShiftedPair::Kind::Equal) continue;
        if (pair.kind == ShiftedPair::Kind::Coplanar) {
            EXPECT_NE(moved.kind, ShiftedPair::Kind::Crossing);
            EXPECT_EQ(side_of_shifted(corners(at_a), corners(at_b), moving.shift),
                      pair.is_above ? 1 : -1);
            continue;
        }
        const bool crosses = pair.kind == ShiftedPair::Kind::Crossing;
        ASSERT_EQ(moved.kind == ShiftedPair::Kind::Crossing, crosses);
        if (crosses) expect_near(pair, moved);
    }
    EXPECT_GT(*std::ranges::min_element(kinds), 10);
    EXPECT_GT(torn, 100);
    EXPECT_GT(in_doubles, 15000);
}

// Where an edge goes through two facets that have a point of it in common, or lies in one of them.
TEST(MovedCorners, EdgesGoThroughFacetsInTheOrderOfThoseThatAreMoved) {
    int compared = 0;
    for (std::uint32_t seed = 0; seed < 400000 && compared < 2000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Triangles random(seed);
        const Corners f = random.next(3);
        const std::array<Corners, 2> others{random.next(3), random.next(3)};
        const InfinitesimalShift along = random.shift();
        const bool is_second = seed % 2 == 0;
        const std::array<Corners, 2> moves{random.moves(), random.moves()};
        const Points own = points_of(f);
        // In one array, as of one mesh.
        const std::array<Points, 2> cutters{points_of(others[0]), points_of(others[1])};
        CornerMoves moving{is_second ? own.data() : cutters[0].data(), {}};
        for (const Corners& m : moves)
            moving.vectors.insert(moving.vectors.end(), m.begin(), m.end());
        InfinitesimalShift shift = along;
        shift.moves = &moving;
        bool both = true;
        for (const Points& c : cutters) {
            const ShiftedPair pair = is_second ? relate_shifted(corners(c), corners(own), shift)
                                               : relate_shifted(corners(own), corners(c), shift);
            both = both && pair.kind == ShiftedPair::Kind::Crossing &&
                   std::ranges::any_of(pair.ends, [&](const auto& end) {
                       return end.of_second == is_second && end.edge == 0;
                   });
        }
        if (!both) continue;
        ++compared;
        const int order = order_along_shifted(own[0], own[1], is_second, corners(cutters[0]),
                                              corners(cutters[1]), shift);
        const Points fine_own = fine(f, is_second ? moves[0] : Corners{});
        const std::array<Points, 2> fine_cutters{fine(others[0], is_second ? Corners{} : moves[0]),
                                                 fine(others[1], is_second ? Corners{} : moves[1])};
        EXPECT_EQ(order,
                  order_along_shifted(fine_own[0], fine_own[1], is_second, corners(fine_cutters[0]),
                                      corners(fine_cutters[1]), along));
    }
    EXPECT_GT(compared, 500);
}

TEST(MovedCorners, LinesPassThroughFacetsAsThoseThatAreMoved) {
    std::array<int, 3> passages{};
    for (std::uint32_t seed = 0; seed < 20000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Triangles random(seed);
        const Corners f = random.next(3);
        const Corners line = random.next(4);
        const Corners moves = random.moves();
        const InfinitesimalShift along = random.shift();
        const bool is_second = seed % 2 == 0;
        const Points facet = points_of(f);
        const Points ends = points_of(line);
        const Moves moving(is_second ? ends : facet, moves, along);
        const auto passage =
            passage_shifted(ends[0], ends[1], is_second, corners(facet), moving.shift);
        const Points fine_facet = fine(f, is_second ? Corners{} : moves);
        const Points fine_ends =
            fine(line, is_second ? Corners{moves[0], moves[0], moves[0]} : Corners{});
        EXPECT_EQ(passage, passage_shifted(fine_ends[0], fine_ends[1], is_second,
                                           corners(fine_facet), along));
        if (passage) ++passages[static_cast<std::size_t>(*passage + 1)];
    }
    EXPECT_GT(*std::ranges::min_element(passages), 500);
}

}  // namespace

}  // namespace moved_corners_test
