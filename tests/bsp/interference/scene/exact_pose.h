// SPDX-License-Identifier: Apache-2.0
//
// Affine maps in fractions of any size, as the oracle of poses along a chain.
#pragma once

#include <trisect/brep/exact_rational.h>
#include <trisect/kernel/pose.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace scene_test {

using trisect::ExactRational;

struct ExactPose {
    std::array<std::array<ExactRational, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

    /// About the line through the point along k by the angle with tan(a / 2) = p/q |k|, by
    /// Rodrigues' formula: with c = cos a and s = sin a over |k|,
    /// R = c I + s [k] + (1 - c) k k^T / k^2.
    static ExactPose turn(const std::array<double, 3>& point, const std::array<std::int64_t, 3>& k,
                          std::int64_t p, std::int64_t q) {
        const ExactRational r = ExactRational(p) / q;
        ExactRational kk;
        for (const std::int64_t c : k) kk += ExactRational(c) * c;
        const ExactRational tt = r * r * kk;
        const ExactRational c = (ExactRational(1) - tt) / (ExactRational(1) + tt);
        const ExactRational s = ExactRational(2) * r / (ExactRational(1) + tt);
        ExactPose out;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                out.rows[i][j] = (ExactRational(1) - c) * k[i] * k[j] / kk;
                if (i == j) out.rows[i][j] += c;
            }
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t u = (i + 1) % 3;
            const std::size_t v = (i + 2) % 3;
            out.rows[u][v] -= s * k[i];
            out.rows[v][u] += s * k[i];
        }
        for (std::size_t i = 0; i < 3; ++i) {
            out.rows[i][3] = ExactRational::from_double(point[i]);
            for (std::size_t j = 0; j < 3; ++j)
                out.rows[i][3] -= out.rows[i][j] * ExactRational::from_double(point[j]);
        }
        return out;
    }

    /// First b, then a.
    friend ExactPose operator*(const ExactPose& a, const ExactPose& b) {
        ExactPose out;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                out.rows[i][j] = j == 3 ? a.rows[i][3] : ExactRational();
                for (std::size_t k = 0; k < 3; ++k) out.rows[i][j] += a.rows[i][k] * b.rows[k][j];
            }
        }
        return out;
    }
    friend bool operator==(const ExactPose&, const ExactPose&) = default;
};

[[nodiscard]] inline ExactPose exact(const trisect::Pose& pose) {
    const ExactRational s(pose.denominator());
    ExactPose out;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) out.rows[i][j] = ExactRational(pose.matrix(i, j)) / s;
        out.rows[i][3] = ExactRational(pose.translation(i)) / s;
    }
    return out;
}

}  // namespace scene_test
