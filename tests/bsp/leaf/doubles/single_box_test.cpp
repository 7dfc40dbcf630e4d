// SPDX-License-Identifier: Apache-2.0
//
// Boxes in single precision (single_box.h) against those in doubles.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <trisect/bsp/leaf/doubles/single_box.h>

namespace trisect::detail {
namespace {

struct PlacedBox {
    Vector3 lo{};
    Vector3 hi{};
    [[nodiscard]] bool meets(const PlacedBox& b, double gap = 0) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (lo[k] > b.hi[k] + gap || b.lo[k] > hi[k] + gap) return false;
        return true;
    }
};

// On a grid in half of the cases, so that they touch.
std::vector<PlacedBox> boxes_about(std::mt19937_64& random, const Vector3& at, double extent) {
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<PlacedBox> out(200);
    for (std::size_t i = 0; i < out.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            double lo = unit(random);
            double side = unit(random) * unit(random);
            if (i % 2 == 0) {
                lo = std::floor(8 * lo) / 8;
                side = std::ceil(8 * side) / 8;
            }
            out[i].lo[k] = at[k] + extent * (2 * lo - 1);
            out[i].hi[k] = at[k] + extent * (2 * lo - 1 + side);
        }
    return out;
}

TEST(SingleBox, MeetsWhatItMeetsInThePlace) {
    std::mt19937_64 random(1);
    const std::vector<Vector3> middles{{0, 0, 0}, {1e9, -3, 0x1p52}, {1e-9, 2, -7}};
    for (const Vector3& at : middles) {
        const double extent = 3;
        PlacedBox place;
        for (std::size_t k = 0; k < 3; ++k) {
            place.lo[k] = at[k] - extent / 2;
            place.hi[k] = at[k] + extent / 4;
        }
        const SinglePlace singles(place.lo, place.hi);
        const std::vector<PlacedBox> boxes = boxes_about(random, at, extent);
        for (const PlacedBox& a : boxes) {
            if (!a.meets(place)) continue;
            const SingleBox taken = singles.box(a.lo, a.hi);
            for (std::size_t k = 0; k < 3; ++k) {
                // Drawn in to no nearer than the place, and rounded in doubles.
                const double rounding = 0x1p-51 * std::fabs(at[k]);
                EXPECT_LE(singles.lower(taken, k), std::max(a.lo[k], place.lo[k]) + rounding);
                EXPECT_GE(singles.upper(taken, k), std::min(a.hi[k], place.hi[k]) - rounding);
            }
            for (const PlacedBox& b : boxes) {
                PlacedBox both;  // in the place
                for (std::size_t k = 0; k < 3; ++k) {
                    both.lo[k] = std::max({a.lo[k], b.lo[k], place.lo[k]});
                    both.hi[k] = std::min({a.hi[k], b.hi[k], place.hi[k]});
                }
                const bool meet = both.lo[0] <= both.hi[0] && both.lo[1] <= both.hi[1] &&
                                  both.lo[2] <= both.hi[2];
                const SingleBox other = singles.box(b.lo, b.hi);
                if (meet) {
                    EXPECT_TRUE(taken.meets(other));
                }
                if (!a.meets(b, 0x1p-18 * extent) && b.meets(place)) {
                    EXPECT_FALSE(taken.meets(other));
                }
            }
        }
    }
}

TEST(SingleBox, GrowsIsCutAndContains) {
    SingleBox all = SingleBox::none();
    const SingleBox a{{0, 1, 2, 5}, {-3, -4, -5, 7}};
    const SingleBox b{{1, 0, 2, 0}, {-2, -6, -5, 0}};
    EXPECT_FALSE(all.contains(a));
    all.add(a);
    EXPECT_TRUE(all.contains(a));
    EXPECT_FALSE(all.contains(b));
    all.add(b);
    EXPECT_TRUE(all.contains(b));
    EXPECT_EQ(all.lo[1], 0);
    EXPECT_EQ(all.hi(1), 6);
    EXPECT_TRUE(SingleBox::everywhere().contains(all));
    all.cut(a);
    EXPECT_EQ(all.lo[1], 1);
    EXPECT_EQ(all.hi(1), 4);
    // The fourth numbers are not looked at.
    EXPECT_TRUE(a.meets({{3, 4, 5, 9}, {-3, -4, -5, 9}}));
    EXPECT_FALSE(a.meets({{3.5, 4, 5, 0}, {-4, -4, -5, 0}}));
}

TEST(SingleBox, OfAPlaceThatIsAPointIsNotEmpty) {
    const SinglePlace singles({1, 2, 3}, {1, 2, 3});
    EXPECT_TRUE(singles.box({0, 0, 0}, {1, 2, 3}).meets(singles.box({1, 2, 3}, {9, 9, 9})));
}

// Whoever counts there begins with nothing.
TEST(SingleBox, OfAPlaceHasNothingAsTheFourthNumber) {
    const SinglePlace singles({0, 0, 0}, {0x1p24, 1, 1});
    const SingleBox box = singles.box({1, 0, 0}, {2, 1, 1});
    EXPECT_EQ(box.lo[3], 0);
    EXPECT_EQ(box.down[3], 0);
}

}  // namespace
}  // namespace trisect::detail
