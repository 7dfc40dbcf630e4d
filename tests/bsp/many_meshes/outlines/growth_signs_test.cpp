// SPDX-License-Identifier: Apache-2.0
//
// Which operands grow and which shrink (growth_signs.h), against all choices.

#include <trisect/bsp/many_meshes/outlines/growth_signs.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace {

using trisect::detail::GrowthSigns;
using Signs = std::vector<std::int8_t>;
using Wanted = std::vector<std::array<GrowthSigns::Effect, 2>>;

bool is_done(const Wanted& wanted, const Signs& signs) {
    for (const auto& [one, other] : wanted) {
        const int first = one.if_it_grows * signs[one.slot];
        const int second = other.if_it_grows * signs[other.slot];
        const bool nothing = one.if_it_grows == 0 && other.if_it_grows == 0;
        if (!nothing && first <= 0 && second <= 0) return false;
    }
    return true;
}

bool is_possible(const Wanted& wanted, std::size_t slots) {
    for (std::uint32_t choice = 0; choice < (1U << slots); ++choice) {
        Signs signs;
        for (std::size_t s = 0; s < slots; ++s)
            signs.push_back(static_cast<std::int8_t>((choice >> s & 1U) != 0 ? 1 : -1));
        if (is_done(wanted, signs)) return true;
    }
    return false;
}

TEST(GrowthSigns, AreFoundWhereThereAreSome) {
    constexpr std::size_t slots = 6;
    int possible = 0;
    for (unsigned seed = 1; seed <= 2000; ++seed) {
        std::mt19937 random(seed);
        const auto effect = [&] {
            return GrowthSigns::Effect{static_cast<std::uint32_t>(random() % slots),
                                       static_cast<int>(random() % 3) - 1};
        };
        GrowthSigns signs(slots);
        Wanted wanted;
        for (std::size_t n = 4 + seed % 12; n > 0; --n) {
            wanted.push_back({effect(), effect()});
            signs.want(wanted.back()[0], wanted.back()[1]);
        }
        const auto found = signs.near(Signs(slots, 1));
        EXPECT_EQ(found.has_value(), is_possible(wanted, slots)) << seed;
        if (!found) continue;
        ++possible;
        EXPECT_TRUE(is_done(wanted, *found)) << seed;
    }
    EXPECT_GT(possible, 500);
    EXPECT_LT(possible, 1500);
}

TEST(GrowthSigns, StayAsGivenWhereNothingIsWanted) {
    GrowthSigns signs(3);
    signs.want({0, -1}, {1, -1});
    EXPECT_EQ(signs.near({1, 1, -1}), (Signs{1, -1, -1}));
    EXPECT_EQ(signs.near({-1, 1, 1}), (Signs{-1, 1, 1}));
}

}  // namespace
