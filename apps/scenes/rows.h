// SPDX-License-Identifier: Apache-2.0
//
// Poses of scenes from rotations and translations.
#pragma once

#include <cmath>
#include <numbers>

#include "scenes.h"
#include "shapes.h"

namespace scenes {

[[nodiscard]] inline Rows rows_of(const shapes::Matrix& m, const trisect::Point3d& by) {
    Rows r{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) r[4 * i + j] = m[i][j];
        r[4 * i + 3] = by[i];
    }
    return r;
}

[[nodiscard]] inline shapes::Matrix product(const shapes::Matrix& a, const shapes::Matrix& b) {
    shapes::Matrix r{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) r[i][j] += a[i][k] * b[k][j];
    return r;
}

[[nodiscard]] inline double dot(const trisect::Point3d& a, const trisect::Point3d& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[nodiscard]] inline trisect::Point3d times(const shapes::Matrix& m, const trisect::Point3d& p) {
    return {dot(m[0], p), dot(m[1], p), dot(m[2], p)};
}

/// Uniform among all directions.
[[nodiscard]] inline trisect::Point3d random_direction(shapes::Random& random) {
    const double z = 2 * random.uniform() - 1;
    const double angle = 2 * std::numbers::pi * random.uniform();
    const double s = std::sqrt(1 - z * z);
    return {s * std::cos(angle), s * std::sin(angle), z};
}

inline constexpr shapes::Matrix identity{trisect::Point3d{1, 0, 0}, trisect::Point3d{0, 1, 0},
                                         trisect::Point3d{0, 0, 1}};

}  // namespace scenes
