// SPDX-License-Identifier: Apache-2.0
#include "scene_solids.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include "engines/engines.h"

namespace scene_test {

using reference::Random;
using trisect::Pose;

trisect::InterferenceModel random_model(Random& random) {
    const auto any = [&random]() -> reference::Operand {
        if (random.chance(1, 4)) return reference::box({0, 0, 0}, {15, 15, 15});
        if (random.chance(1, 4)) return reference::box({5, 5, 5}, {9, 9, 9});
        return reference::random_embedded_solid(random);
    };
    return trisect::InterferenceModel(engines::solid(any(), trisect::Embedding::Assume));
}

Pose random_pose(Random& random) {
    static constexpr std::array<std::array<std::int64_t, 4>, 7> turns{{{1, 0, 0, 0},
                                                                       {1, 0, 0, 0},
                                                                       {1, 0, 0, 1},
                                                                       {1, 1, 1, 1},
                                                                       {0, 1, 0, 0},
                                                                       {2, 0, 0, 1},
                                                                       {1, 2, -2, 4}}};
    // Mostly a few places, so that bodies meet and coincide.
    std::array<double, 3> by{};
    if (random.chance(2, 3))
        for (double& c : by) c = static_cast<double>(random.between(-2, 2)) * 4;
    const Pose turn = Pose::from_translation({7 + by[0], 7 + by[1], 7 + by[2]}) *
                      Pose::from_quaternion(turns[random.below(turns.size())]) *
                      Pose::from_translation({-7, -7, -7});
    if (!random.chance(1, 8)) return turn;
    return turn * Pose::from_doubles({-1, 0, 0, 14, 0, 1, 0, 0, 0, 0, 1, 0});
}

}  // namespace scene_test
