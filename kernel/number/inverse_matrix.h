// SPDX-License-Identifier: Apache-2.0
//
// Inverses of three by three matrices in doubles, with their residuals.
#pragma once

#include <array>
#include <cstddef>

namespace trisect::detail {

/// By cofactors; not finite when there is none.
[[nodiscard]] inline std::array<std::array<double, 3>, 3> inverse_of(
    const std::array<std::array<double, 3>, 3>& v) {
    std::array<std::array<double, 3>, 3> x{};
    double determinant = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t i1 = (i + 1) % 3;
            const std::size_t i2 = (i + 2) % 3;
            const std::size_t j1 = (j + 1) % 3;
            const std::size_t j2 = (j + 2) % 3;
            x[j][i] = v[i1][j1] * v[i2][j2] - v[i1][j2] * v[i2][j1];
            if (i == 0) determinant += v[0][j] * x[j][0];
        }
    for (auto& row : x)
        for (double& c : row) c /= determinant;
    return x;
}

/// The sum of the squares of the entries of X V - 1.
[[nodiscard]] inline double square_off_identity(const std::array<std::array<double, 3>, 3>& x,
                                                const std::array<std::array<double, 3>, 3>& v) {
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const double e =
                (i == j ? 1 : 0) - (x[i][0] * v[0][j] + x[i][1] * v[1][j] + x[i][2] * v[2][j]);
            square += e * e;
        }
    return square;
}

}  // namespace trisect::detail
