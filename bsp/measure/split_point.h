// SPDX-License-Identifier: Apache-2.0
//
// SplitPoint: coordinates as integers of 61 bits and rests.
//
// Lattice coordinates are doubles of up to 53 bits before the point and 73 behind it. In units in
// which the largest one has 60 bits nearly all of them are whole, and sums over triangles go by
// integers; what is left of the others is less than a unit and needs few digits.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/refined_point.h>

namespace trisect::detail {

using SplitWhole = std::array<std::int64_t, 3>;

struct SplitPoint {
    SplitWhole whole{};
    std::array<double, 3> rest{};  ///< less than 1 in magnitude

    [[nodiscard]] bool is_whole() const { return rest[0] == 0 && rest[1] == 0 && rest[2] == 0; }
};

/// The units of a box about the origin.
class SplitUnits {
public:
    /// \pre 0 < reach <= coordinate_limit; no coordinate is larger in magnitude. `centre`: of what
    /// is measured, in lattice units.
    SplitUnits(double reach, const std::array<double, 3>& centre)
        : shift_(bits - std::ilogb(reach) - 1), scale_(std::ldexp(1.0, shift_)) {
        for (std::size_t k = 0; k < 3; ++k)
            centre_[k] = static_cast<std::int64_t>(centre[k] * scale_);
    }
    /// Sums may count from there.
    [[nodiscard]] const SplitWhole& centre() const { return centre_; }
    /// A lattice unit has 2^shift() of these.
    [[nodiscard]] int shift() const { return shift_; }
    [[nodiscard]] double scale() const { return scale_; }
    /// Whether coordinates with so many bits behind the point have no rest.
    [[nodiscard]] bool holds(int fraction_bits) const { return fraction_bits <= shift_; }

    /// \pre the units hold its coordinates
    [[nodiscard]] SplitWhole whole(const LatticePoint& p) const {
        return {static_cast<std::int64_t>(p.x.to_double() * scale_),
                static_cast<std::int64_t>(p.y.to_double() * scale_),
                static_cast<std::int64_t>(p.z.to_double() * scale_)};
    }
    /// Exact.
    [[nodiscard]] SplitPoint split(const LatticePoint& p) const {
        const std::array<double, 3> c = p.doubles();
        SplitPoint out;
        for (std::size_t k = 0; k < 3; ++k) split(c[k] * scale_, out, k);
        return out;
    }
    /// As far off as the point is.
    [[nodiscard]] SplitPoint split(const RefinedPoint& p) const {
        SplitPoint out;
        for (std::size_t k = 0; k < 3; ++k) {
            split(p.high[k] * scale_, out, k);
            const double rest = out.rest[k] + p.low[k] * scale_;
            const auto more = static_cast<std::int64_t>(rest);
            out.whole[k] += more;
            out.rest[k] = rest - static_cast<double>(more);
        }
        return out;
    }

private:
    static constexpr int bits = 60;

    static void split(double coordinate, SplitPoint& out, std::size_t k) {
        out.whole[k] = static_cast<std::int64_t>(coordinate);
        out.rest[k] = coordinate - static_cast<double>(out.whole[k]);
    }

    int shift_;
    double scale_;
    SplitWhole centre_{};
};

}  // namespace trisect::detail
