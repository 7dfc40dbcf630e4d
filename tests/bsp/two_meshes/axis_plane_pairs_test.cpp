// SPDX-License-Identifier: Apache-2.0
//
// Facets in one plane across an axis, by comparisons of coordinates, against integers.

#include <trisect/bsp/two_meshes/axis_plane_pairs.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <trisect/bsp/cells/shift/corner_moves.h>

namespace axis_plane_pairs_test {
namespace {

using trisect::LatticePoint;
using trisect::detail::CornerMoves;
using trisect::detail::FacetCorners;
using trisect::detail::InfinitesimalShift;
using trisect::detail::relate_across_axis;
using trisect::detail::relate_exactly;
using trisect::detail::ShiftedPair;

using Corners = std::array<LatticePoint, 3>;

FacetCorners corners(const Corners& c) { return {&c[0], &c[1], &c[2]}; }

// Of one plane across an axis, some of them a unit beside it.
class Facets {
public:
    explicit Facets(std::uint32_t seed) : random_(seed) {}
    [[nodiscard]] Corners next(std::size_t axis) {
        while (true) {
            std::array<std::array<std::int64_t, 3>, 3> p{};
            for (auto& c : p)
                for (std::size_t k = 0; k < 3; ++k)
                    c[k] = k == axis ? 2 : static_cast<std::int64_t>(random_() % 4);
            if (random_() % 16 == 0) p[0][axis] = 3;
            const std::size_t u = (axis + 1) % 3;
            const std::size_t v = (axis + 2) % 3;
            if ((p[1][u] - p[0][u]) * (p[2][v] - p[0][v]) ==
                (p[1][v] - p[0][v]) * (p[2][u] - p[0][u]))
                continue;
            Corners out;
            for (std::size_t i = 0; i < 3; ++i) out[i] = {p[i][0], p[i][1], p[i][2]};
            return out;
        }
    }
    [[nodiscard]] InfinitesimalShift shift() {
        InfinitesimalShift s;
        std::swap(s.axes[random_() % 3], s.axes[random_() % 3]);
        for (std::int8_t& sign : s.signs) sign = random_() % 2 == 0 ? 1 : -1;
        s.growth = static_cast<std::int8_t>(static_cast<int>(random_() % 3) - 1);
        if (s.growth != 0)
            s.next_growth = static_cast<std::int8_t>(static_cast<int>(random_() % 3) - 1);
        const auto at = [&] { return static_cast<std::int64_t>(random_() % 4); };
        s.centre = {at(), at(), at()};
        s.next_centre = {at(), at(), at()};
        return s;
    }
    [[nodiscard]] CornerMoves moves(const Corners& of) {
        CornerMoves out;
        out.points = of.data();
        for (std::size_t i = 0; i < 3; ++i) {
            const auto at = [&] { return static_cast<std::int32_t>(random_() % 3) - 1; };
            out.vectors.push_back({at(), at(), at()});
        }
        return out;
    }

private:
    std::mt19937 random_;
};

struct Found {
    int decided = 0;
    int open = 0;
};

void compare(const Corners& a, const Corners& b, const InfinitesimalShift& shift, Found& found) {
    const ShiftedPair exact = relate_exactly(corners(a), corners(b), shift);
    if (exact.kind == ShiftedPair::Kind::Equal) return;
    const auto pair = relate_across_axis(corners(a), corners(b), shift);
    ++(pair ? found.decided : found.open);
    if (!pair) return;
    EXPECT_EQ(pair->kind, exact.kind);
    EXPECT_EQ(pair->touches, exact.touches);
    EXPECT_EQ(pair->is_above, exact.is_above);
    EXPECT_EQ(pair->same_side, exact.same_side);
    EXPECT_EQ(pair->is_torn, exact.is_torn);
}

TEST(AxisPlanePairs, OfAMeshThatIsMovedOrGrows) {
    Found found;
    for (std::uint32_t seed = 0; seed < 10000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Facets facets(seed);
        const Corners a = facets.next(seed % 3);
        const Corners b = facets.next(seed % 3);
        compare(a, b, facets.shift(), found);
    }
    EXPECT_GT(found.decided, 8000);
    EXPECT_GT(found.open, 500);
}

TEST(AxisPlanePairs, OfAMeshWhoseCornersMove) {
    Found found;
    for (std::uint32_t seed = 0; seed < 10000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Facets facets(seed);
        const Corners a = facets.next(seed % 3);
        const Corners b = facets.next(seed % 3);
        InfinitesimalShift shift = facets.shift();
        shift.growth = shift.next_growth = 0;
        const CornerMoves moves = facets.moves(b);
        shift.moves = &moves;
        compare(a, b, shift, found);
    }
    EXPECT_GT(found.decided, 2000);
    EXPECT_GT(found.open, 2000);
}

TEST(AxisPlanePairs, FacetsOfTwoPlanesAreLeftOpen) {
    const Corners a{LatticePoint{0, 0, 1}, {4, 0, 1}, {0, 4, 1}};
    const Corners above{LatticePoint{0, 0, 2}, {4, 0, 2}, {0, 4, 2}};
    const Corners across{LatticePoint{0, 0, 1}, {4, 0, 1}, {0, 0, 5}};
    EXPECT_FALSE(relate_across_axis(corners(a), corners(above), {}).has_value());
    EXPECT_FALSE(relate_across_axis(corners(a), corners(across), {}).has_value());
}

}  // namespace
}  // namespace axis_plane_pairs_test
