// SPDX-License-Identifier: Apache-2.0
//
// Splits of random solids on the small grid and out of it, by each other and by planes: what two
// evaluations give.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engines.h"
#include "split_check.h"

namespace split_engines_test {
namespace {

trisect::Solid mesh_of_four(const reference::Operand& operand, int bits = 0) {
    return engines::solid(engines::divided(operand), trisect::Embedding::Assume, bits);
}

TEST(SplitOfRandomSolids, InGeneralPosition) {
    std::uint64_t shared = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 710000);
        const auto a = engines::mapped(reference::random_embedded_solid(random), random);
        const auto b = engines::mapped(reference::random_embedded_solid(random), random);
        EXPECT_EQ(engines::split_difference(mesh_of_four(a), mesh_of_four(b), {}, shared), "");
        EXPECT_EQ(engines::all_difference(mesh_of_four(a), mesh_of_four(b), {}, shared), "");
    }
    EXPECT_GT(shared, 100U);
}

TEST(SplitOfRandomSolids, ThatTouchOnTheSmallGrid) {
    std::uint64_t shared = 0;
    for (std::uint64_t seed = 1; seed <= 80; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 720000);
        const auto pair = reference::random_family(random, 2, true);
        const int bits = seed % 4 == 0 ? 24 : 0;
        EXPECT_EQ(engines::split_difference(mesh_of_four(pair[0], bits), mesh_of_four(pair[1]), {},
                                            shared),
                  "");
    }
    EXPECT_GT(shared, 10U);
}

TEST(SplitOfRandomSolids, ByPlanesThroughTheGrid) {
    std::uint64_t shared = 0;
    for (std::uint64_t seed = 1; seed <= 80; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 730000);
        const trisect::Solid solid = mesh_of_four(reference::random_embedded_solid(random));
        std::vector<std::array<double, 4>> planes;
        const double step = seed % 2 == 0 ? 1 : 2.71;
        for (int i = 0; i < 3; ++i) planes.push_back({1, 0, 2, -step * (3 * i + 5)});
        if (seed % 3 == 0) planes.push_back({0, 1, 0, -9.5});
        EXPECT_EQ(engines::planes_difference(solid, planes, {}, shared), "");
    }
    EXPECT_GT(shared, 40U);
}

}  // namespace
}  // namespace split_engines_test
