// SPDX-License-Identifier: Apache-2.0
//
// RelativePose: the map between the lattices of two posed solids, for predicates.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/number/bounded_int.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/pose.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

/// x -> (M x + t) / S from the lattice units of one solid (`from`) into those of another (`to`).
/// Integers, S > 0; and the same numbers as doubles with a certified error.
///
/// Every number is below 2^895, or making it throws LimitError. From poses with numbers below 2^w
/// on lattices of one unit it has at most 4 w + 4 bits (3 w + 4 when one of the two is a
/// translation by integers), so w <= 222 always works. Doubles of one magnitude have w = 53 to 60.
class RelativePose {
public:
    static constexpr int bits = 895;

    /// The identity.
    RelativePose();
    /// \throw LimitError
    RelativePose(std::array<IntVector, 3> rows, IntVector translation, BoundedInt denominator);

    [[nodiscard]] const IntVector& row(std::size_t i) const { return m_[i]; }
    [[nodiscard]] const IntVector& translation() const { return t_; }
    [[nodiscard]] const BoundedInt& denominator() const { return s_; }
    [[nodiscard]] bool is_mirror() const { return mirror_; }
    /// Whether M = S, so that planes keep their normals.
    [[nodiscard]] bool is_translation() const { return translation_only_; }
    /// Bits of the largest number.
    [[nodiscard]] int width() const { return width_; }
    /// The same numbers where they are small: under the identity, quarter turns, translations along
    /// the lattice, rotations by quaternions of a few digits. |m|, s < 2^31, |t| < 2^62.
    struct Short {
        std::array<std::array<std::int64_t, 3>, 3> m{};
        std::array<std::int64_t, 3> t{};
        std::int64_t s = 1;
        int bits = 0;  ///< all of m and t are below 2^bits
    };
    /// Null when they are not.
    [[nodiscard]] const Short* short_numbers() const { return short_ ? &*short_ : nullptr; }

    /// M_ij / S and t_i / S, relative error below `relative_error`. When `has_doubles` is false
    /// some leave the range in which products of three with coordinates neither overflow nor
    /// underflow, and filters give up.
    [[nodiscard]] const std::array<std::array<double, 3>, 3>& approx_rows() const { return fm_; }
    [[nodiscard]] const std::array<double, 3>& approx_translation() const { return ft_; }
    [[nodiscard]] bool has_doubles() const { return has_doubles_; }
    static constexpr double relative_error = 0x1p-50;

    /// Where a point goes, in doubles with a certified error. \pre has_doubles()
    [[nodiscard]] Approximation move(const Approximation& p) const;

private:
    void make_doubles();
    void make_short();

    std::array<IntVector, 3> m_;
    IntVector t_;
    BoundedInt s_;
    bool mirror_ = false;
    bool translation_only_ = true;
    int width_ = 1;
    bool has_doubles_ = true;
    std::optional<Short> short_;
    std::array<std::array<double, 3>, 3> fm_{};
    std::array<double, 3> ft_{};
};

/// From the lattice of a solid posed by `from` into that of a solid posed by `to`: the inverse of
/// `to` after `from`.
[[nodiscard]] RelativePose relative_pose(const Pose& to, Lattice to_lattice, const Pose& from,
                                         Lattice from_lattice);

/// Both ways between two posed solids.
struct PosedPair {
    RelativePose to_a;  ///< B's lattice into A's
    RelativePose to_b;  ///< A's lattice into B's

    PosedPair(const Pose& a, Lattice a_lattice, const Pose& b, Lattice b_lattice)
        : to_a(relative_pose(a, a_lattice, b, b_lattice)),
          to_b(relative_pose(b, b_lattice, a, a_lattice)) {}
};

inline Approximation RelativePose::move(const Approximation& p) const {
    // Coefficients have a relative error of 2^-50, products and three sums add 4 roundings of
    // 2^-53: below 1.5 · 2^-50 of the terms' magnitudes, 2^-49 with the rounding of the bound.
    // The point's own error passes through the row. What underflows is below the first term.
    Approximation r;
    r.error = 0x1p-900;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& row = fm_[i];
        const auto mag = [](double v) { return v < 0 ? -v : v; };
        const double x = row[0] * p.c[0];
        const double y = row[1] * p.c[1];
        const double z = row[2] * p.c[2];
        r.c[i] = ((x + y) + z) + ft_[i];
        const double terms = ((mag(x) + mag(y)) + mag(z)) + mag(ft_[i]);
        const double size = (mag(row[0]) + mag(row[1])) + mag(row[2]);
        const double e = 0x1p-49 * terms + error_slack * (p.error * size);
        if (e > r.error) r.error = e;
    }
    return r;
}

}  // namespace trisect::detail
