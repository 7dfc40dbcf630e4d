// SPDX-License-Identifier: Apache-2.0
//
// TriangleInBoxes: conservative intersection tests of a triangle with many boxes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace trisect::detail {

/// By the triangle's plane and its edges seen along the axes (Akenine-Möller 2001), with margins
/// for coordinates below 2^54. Made once for a triangle, tested with many cubes; on the safe side.
class TriangleInBoxes {
public:
    explicit TriangleInBoxes(const std::array<std::array<double, 3>, 3>& c) {
        std::array<double, 3> u{};
        std::array<double, 3> v{};
        for (std::size_t k = 0; k < 3; ++k) {
            u[k] = c[1][k] - c[0][k];
            v[k] = c[2][k] - c[0][k];
        }
        axes_[0] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t j = (k + 1) % 3;
                const std::size_t l = (k + 2) % 3;
                auto& axis = axes_[1 + 3 * i + k];
                axis[k] = 0;
                axis[j] = -(c[(i + 1) % 3][l] - c[i][l]);
                axis[l] = c[(i + 1) % 3][j] - c[i][j];
            }
        for (std::size_t a = 0; a < axes_.size(); ++a) {
            lo_[a] = HUGE_VAL;
            hi_[a] = -HUGE_VAL;
            double terms = 0;
            for (const auto& p : c) {
                double at = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    at += axes_[a][k] * p[k];
                    terms += std::fabs(axes_[a][k] * p[k]);
                }
                lo_[a] = std::min(lo_[a], at);
                hi_[a] = std::max(hi_[a], at);
            }
            // Axes carry two roundings and a cancellation of products of edges; edges are sums of
            // coordinates. All of it is below 2^-40 of the terms plus what follows from 8 units.
            const double margin = 0x1p-40 * terms;
            lo_[a] -= margin;
            hi_[a] += margin;
        }
    }

    [[nodiscard]] bool may_meet(const std::array<double, 3>& middle, double half) const {
        for (std::size_t a = 0; a < axes_.size(); ++a) {
            const auto& x = axes_[a];
            const double reach = (std::fabs(x[0]) + std::fabs(x[1]) + std::fabs(x[2])) * half;
            const double at = x[0] * middle[0] + x[1] * middle[1] + x[2] * middle[2];
            const double margin =
                0x1p-40 * (std::fabs(x[0] * middle[0]) + std::fabs(x[1] * middle[1]) +
                           std::fabs(x[2] * middle[2]) + reach);
            if (at - reach - margin > hi_[a] || at + reach + margin < lo_[a]) return false;
        }
        return true;
    }

private:
    std::array<std::array<double, 3>, 10> axes_{};
    std::array<double, 10> lo_{};
    std::array<double, 10> hi_{};
};

}  // namespace trisect::detail
