// SPDX-License-Identifier: Apache-2.0
//
// Errors, with u = 2^-53. A position p is within e of its vertex, p - origin is rounded once, the
// unit is a power of two: z is off by at most e / unit + u |z| <= e / unit + 2 u.
//
// Of the map, t = (M o_B + T - o_A) / unit: five sums and three products, below 8 u of the sum of
// magnitudes; each entry's error times |o_B|, and T's. An image: three products and three sums,
// below 4 u (2 Σ |m_ij| + |t_i|), and 6 m_error + t_error. All bounds are taken larger.

#include <trisect/bsp/hierarchies/pairs/tree_frame.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/error_bounds.h>

namespace trisect::hierarchies {

TreeFrame::TreeFrame(const detail::InterferenceModelData& model) {
    double half = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        origin[k] = 0.5 * model.lo[k] + 0.5 * model.hi[k];
        half = std::max({half, model.hi[k] - origin[k], origin[k] - model.lo[k]});
    }
    int exponent = 0;
    std::frexp(half + 2 * model.position_error, &exponent);
    unit = std::ldexp(1.0, exponent);
    error = 1.01 * (model.position_error / unit) + 0x1p-51;
}

FrameMap::FrameMap(const TreeFrame& a, const TreeFrame& b, const detail::ApproximateMap& map) {
    const double factor = b.unit / a.unit;
    double rows = 0;
    double images = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double sum = map.t[i];
        double size = std::abs(map.t[i]) + std::abs(a.origin[i]);
        double error = map.t_error;
        double row = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            m[i][j] = map.m[i][j] * factor;
            sum += map.m[i][j] * b.origin[j];
            size += std::abs(map.m[i][j] * b.origin[j]);
            error += map.m_error * std::abs(b.origin[j]);
            row += std::abs(m[i][j]);
        }
        t[i] = (sum - a.origin[i]) / a.unit;
        t_error = std::max(t_error, 1.01 * (error + 0x1p-49 * size) / a.unit);
        rows = std::max(rows, row);
        images = std::max(images, 2 * row + std::abs(t[i]));
    }
    m_error = 1.01 * map.m_error * factor;
    error_ = 0x1p-50 * images + 1.01 * (6 * m_error + t_error);

    // |M|² is at most the largest row sum of M^T M (of magnitudes).
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double row = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            double g = 0;
            for (std::size_t k = 0; k < 3; ++k) g += m[k][i] * m[k][j];
            row += std::abs(g);
        }
        square = std::max(square, row);
    }
    stretch = detail::surely_more * std::sqrt(square) + 3 * m_error;
}

}  // namespace trisect::hierarchies
