// SPDX-License-Identifier: Apache-2.0
//
// IndexPoint: a query point of an index, in any of its input types.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/cells/cell.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

/// A point in lattice units: doubles with an error bound, and the exact coordinates on demand, as
/// integers of a fixed width where they fit and as rationals otherwise (doubles may have bits a
/// thousand places behind the point). For one thread: exact forms are kept once made.
class IndexPoint {
public:
    using Vector = std::array<double, 3>;
    using Rational = std::array<ExactRational, 3>;

    /// Doubles in lattice units, exact as given. \pre finite; 0 or at least 2^-500.
    explicit IndexPoint(const Vector& p) : c_(p) {
        for (const double x : p)
            if (!(x < 0x1p600 && x > -0x1p600)) set_huge();
    }
    explicit IndexPoint(const LatticePoint& p) : c_(p.doubles()) {}
    explicit IndexPoint(const Point& p);
    explicit IndexPoint(const FinePoint& p);
    explicit IndexPoint(Rational p);
    /// Doubles in the user's units. \throw UsageError when they are not finite.
    [[nodiscard]] static IndexPoint from_user(const Vector& p, Lattice lattice) {
        Vector c{};
        return to_lattice(p, lattice, c) ? IndexPoint(c) : from_user_slowly(p, lattice);
    }
    /// Doubles in lattice units where these are exact and neither huge nor tiny; else false.
    [[nodiscard]] static bool to_lattice(const Vector& p, Lattice lattice, Vector& c) {
        // Multiplying by a power of two is exact within the range of normal doubles. Values at
        // planes, and of normals of corners with bits behind the point, must be in that range, too.
        if (lattice.exponent <= -900 || lattice.exponent >= 900) return false;
        const double scale =
            std::bit_cast<double>(static_cast<std::uint64_t>(1023 - lattice.exponent) << 52U);
        bool exact = true;
        for (std::size_t k = 0; k < 3; ++k) {
            c[k] = p[k] * scale;
            const double m = c[k] < 0 ? -c[k] : c[k];
            exact = exact && (m < 0x1p600) && (m > 0x1p-500 || p[k] == 0);
        }
        return exact;
    }

    [[nodiscard]] double operator[](std::size_t k) const { return c_[k]; }
    [[nodiscard]] const Vector& approximate() const { return c_; }
    /// Every exact coordinate is within this of its approximation; often 0. Where a coordinate is
    /// nearer to 0 than 2^-500 it is at least that, so that bounds pay for what underflows.
    [[nodiscard]] double error() const { return error_; }
    [[nodiscard]] bool is_doubles() const { return error_ == 0; }
    [[nodiscard]] Approximation approximation() const { return {c_, error_}; }

    /// The coordinates times 2^bits as 64-bit integers below 2^62, when they are such for some bits
    /// from 0 to 62.
    struct Small {
        std::array<std::int64_t, 3> c{};
        int bits = 0;
    };
    [[nodiscard]] const std::optional<Small>& small() const {
        if (!small_known_) find_small();
        return small_;
    }
    /// Null when the coordinates do not fit.
    [[nodiscard]] const HomogeneousPoint* homogeneous() const;
    [[nodiscard]] const Rational& rational() const;

    /// -1, 0 or 1: below, on or above.
    [[nodiscard]] int side_of(const Plane& plane) const;
    /// The sign of coordinate k minus position / scale, scale a power of two: exact.
    [[nodiscard]] int compare(std::size_t k, double position) const {
        if (error_ != 0) return compare_slowly(k, position);
        return c_[k] > position ? 1 : (c_[k] < position ? -1 : 0);
    }
    [[nodiscard]] int compare_fine(std::size_t k, std::int64_t position) const;

private:
    [[nodiscard]] static IndexPoint from_user_slowly(const Vector& p, Lattice lattice);
    [[nodiscard]] int compare_slowly(std::size_t k, double position) const;
    void set_huge();
    [[nodiscard]] bool is_tiny() const;
    void find_small() const;

    Vector c_{};
    double error_ = 0;
    bool fits_ = true;  // homogeneous form possible, as far as is known
    mutable bool small_known_ = false;
    mutable std::optional<Small> small_;
    mutable std::optional<HomogeneousPoint> homogeneous_;
    mutable std::optional<Rational> rational_;
};

/// The exact value of a plane's equation.
[[nodiscard]] ExactRational value_at(const IndexPoint::Rational& p, const Plane& plane);

/// Rational coordinates rounded to doubles, and the largest error of that.
[[nodiscard]] Approximation approximate(const IndexPoint::Rational& p);

}  // namespace trisect::detail
