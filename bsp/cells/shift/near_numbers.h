// SPDX-License-Identifier: Apache-2.0
//
// NearNumbers: doubles with proved errors, in place of the integers of shifted pairs.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <trisect/kernel/coordinate.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

/// Lengths are differences of coordinates, which are exact doubles, and carry one rounding. An
/// error of 0 means that nothing was rounded, so zeros of planes across an axis are certain.
/// Nothing underflows: lengths that are not 0 are from 2^-73 up.
class NearNumbers {
public:
    using Length = double;
    struct Bounded {
        double value = 0;
        double error = 0;
    };
    using Area = Bounded;
    using Value = Bounded;

    static Length length(Coordinate c) { return c.to_double(); }
    static Length length(std::int32_t v) { return v; }
    /// a b - c d
    static Area minor(double a, double b, double c, double d) {
        const double p = a * b;
        const double q = c * d;
        return {p - q, minor_rounding * (std::fabs(p) + std::fabs(q))};
    }
    static Bounded sum(const Bounded& a, const Bounded& b) {
        const double v = a.value + b.value;
        return {v, a.error + b.error + 0x1p-53 * std::fabs(v)};
    }
    static Bounded difference(const Bounded& a, const Bounded& b) {
        return sum(a, {-b.value, b.error});
    }
    static Bounded product(const Bounded& a, const Bounded& b) {
        const double v = a.value * b.value;
        return {v, std::fabs(a.value) * b.error + a.error * (std::fabs(b.value) + b.error) +
                       0x1p-53 * std::fabs(v)};
    }
    static Value dot(const std::array<Area, 3>& n, const std::array<double, 3>& v) {
        Value out;
        double size = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double term = n[k].value * v[k];
            out.value += term;
            size += std::fabs(term);
            out.error += n[k].error * std::fabs(v[k]);
        }
        // Each term has one rounding of its length, one of the product and two of the sum.
        out.error += 0x1p-50 * size;
        return out;
    }

    /// Where errors leave it open, is_open() is true from then on, unless the number is 0 by
    /// `is_zero`, or `exactly` gives one with its sign.
    template <class IsZero, class Exactly>
    [[nodiscard]] int sign(const Bounded& v, const IsZero& is_zero, const Exactly& exactly) const {
        const int s = certain_sign(v.value, bound_slack * v.error);
        if (s != 0 || v.error == 0 || is_zero()) return s;
        const std::optional<double> exact = exactly();
        is_open_ = is_open_ || !exact;
        return exact ? certain_sign(*exact, 0) : 0;
    }
    [[nodiscard]] int sign(const Bounded& v) const {
        return sign(
            v, [] { return false; }, [] { return std::optional<double>(); });
    }
    /// Components of a facet's normal across an edge along an axis are 0.
    static void set_zeros(const std::array<std::array<double, 3>, 3>& corners,
                          std::array<Area, 3>& normal) {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                if (are_along(corners[i], corners[(i + 1) % 3], k)) normal[k] = {};
    }
    /// Whether the points differ along that axis alone.
    [[nodiscard]] static bool are_along(const std::array<double, 3>& a,
                                        const std::array<double, 3>& b, std::size_t axis) {
        return a[(axis + 1) % 3] == b[(axis + 1) % 3] && a[(axis + 2) % 3] == b[(axis + 2) % 3];
    }
    /// Whether a point certainly is in the plane of a facet: next to a corner, along an axis that
    /// the plane is parallel to.
    [[nodiscard]] static bool is_in_plane(const std::array<double, 3>& p,
                                          const std::array<std::array<double, 3>, 3>& corners,
                                          const std::array<Area, 3>& normal) {
        for (const std::array<double, 3>& c : corners) {
            bool is_next = true;
            for (std::size_t k = 0; k < 3; ++k)
                is_next =
                    is_next && (p[k] == c[k] || (normal[k].value == 0 && normal[k].error == 0));
            if (is_next) return true;
        }
        return false;
    }
    /// Whether the lines of two segments certainly meet: an end of one is next to one of the other,
    /// along an axis that either is parallel to.
    [[nodiscard]] static bool do_meet(const std::array<double, 3>& a,
                                      const std::array<double, 3>& b,
                                      const std::array<double, 3>& c,
                                      const std::array<double, 3>& d) {
        if (a == c || a == d || b == c || b == d) return true;
        for (std::size_t k = 0; k < 3; ++k)
            if ((are_along(a, b, k) || are_along(c, d, k)) &&
                (are_along(a, c, k) || are_along(a, d, k) || are_along(b, c, k) ||
                 are_along(b, d, k)))
                return true;
        return false;
    }
    [[nodiscard]] bool is_open() const { return is_open_; }

    /// A bound on how far v is off.
    [[nodiscard]] static double error_of(const Bounded& v) { return bound_slack * v.error; }
    [[nodiscard]] static double to_double(const Bounded& v) { return v.value; }
    /// \pre what is off by so much would be found more exactly by integers
    void leave_open() const { is_open_ = true; }

private:
    mutable bool is_open_ = false;
};

}  // namespace trisect::detail
