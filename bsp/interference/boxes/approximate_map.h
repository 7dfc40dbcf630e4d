// SPDX-License-Identifier: Apache-2.0
//
// ApproximateMap: an affine map in doubles with certified errors.
// It serves filters and boxes.
#pragma once

#include <array>
#include <cstddef>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/pose.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect::detail {

/// x' = m x + t from lattice units of one solid to those of another: every exact entry of m is
/// within m_error, every exact component of t within t_error of what stands here.
struct ApproximateMap {
    std::array<std::array<double, 3>, 3> m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::array<double, 3> t{};
    double m_error = 0;
    double t_error = 0;

    /// The image in doubles; off by at most `error_below(max |x_i|)`.
    [[nodiscard]] std::array<double, 3> operator()(const std::array<double, 3>& x) const {
        std::array<double, 3> y{};
        for (std::size_t i = 0; i < 3; ++i)
            y[i] = ((m[i][0] * x[0] + m[i][1] * x[1]) + m[i][2] * x[2]) + t[i];
        return y;
    }
    /// Bound on the error of a component of the image of a point whose coordinates are at most
    /// `largest` in magnitude and known within `point_error`.
    ///
    /// Three products and three sums, each rounded: at most 4·2^-53 of the sum of magnitudes; the
    /// entries' own errors; the point's error times the row.
    [[nodiscard]] double error_below(double largest, double point_error) const {
        double worst = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto mag = [](double v) { return v < 0 ? -v : v; };
            const double row = mag(m[i][0]) + mag(m[i][1]) + mag(m[i][2]);
            const double e =
                0x1p-50 * (row * largest + mag(t[i])) + (row + 3 * m_error) * point_error;
            worst = e > worst ? e : worst;
        }
        return bound_slack * (worst + 3 * m_error * largest + t_error);
    }
    /// Whether all numbers are finite and the errors small enough for filters to be of use.
    [[nodiscard]] bool is_usable() const;
};

/// From the lattice of a solid posed by `from` into that of a solid posed by `to`, without exact
/// arithmetic: a tenth of the cost of a RelativePose. Not usable when doubles cannot prove that the
/// matrix of `to` is regular, or overflow.
[[nodiscard]] ApproximateMap approximate_map(const Pose& to, Lattice to_lattice, const Pose& from,
                                             Lattice from_lattice);
/// The same from the exact one. \pre r.has_doubles()
[[nodiscard]] ApproximateMap approximate_map(const RelativePose& r);

}  // namespace trisect::detail
