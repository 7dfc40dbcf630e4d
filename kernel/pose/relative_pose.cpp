// SPDX-License-Identifier: Apache-2.0
//
// With a = 2^-eA MA^-1 (SA x - tA) and x = (MB 2^eB b + tB) / SB a point b of B's lattice is
//
//     a = (2^(eB - eA) SA C MB b + 2^-eA C (SA tB - SB tA)) / (D SB),   C = adj MA, D = det MA,
//
// in A's lattice. Where A is only translated, MA = SA, C / D is 1 / SA, and nothing need be
// inverted. With numbers below 2^w, C is below 2^(2 w + 1) and D below 2^(3 w + 3), so all three
// parts are below 2^(4 w + 4) before what they have in common is taken out. Powers of two are
// counted before anything is shifted: exponents of lattices may be hundreds.

#include <trisect/kernel/pose/relative_pose.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <trisect/kernel/error.h>
#include <trisect/kernel/pose/reduced_map.h>

namespace trisect::detail {

namespace {

IntVector column(const std::array<IntVector, 3>& rows, std::size_t k) {
    return {rows[0][k], rows[1][k], rows[2][k]};
}

IntVector apply(const std::array<IntVector, 3>& rows, const IntVector& v) {
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

}  // namespace

RelativePose::RelativePose() : s_(1) {
    for (std::size_t i = 0; i < 3; ++i) m_[i][i] = 1;
    make_doubles();
    make_short();
}

RelativePose::RelativePose(std::array<IntVector, 3> rows, IntVector translation,
                           BoundedInt denominator)
    : m_(rows), t_(translation), s_(denominator) {
    width_ = s_.bit_length();
    for (const IntVector& row : m_)
        for (const BoundedInt& v : row) width_ = std::max(width_, v.bit_length());
    for (const BoundedInt& v : t_) width_ = std::max(width_, v.bit_length());
    if (width_ > bits)
        throw LimitError("the pose of one solid relative to the other needs " +
                         std::to_string(width_) + " bits; the limit is " + std::to_string(bits));
    mirror_ = detail::determinant(m_[0], m_[1], m_[2]).sign() < 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            translation_only_ = translation_only_ && (i == j ? m_[i][j] == s_ : m_[i][j].is_zero());
    make_doubles();
    make_short();
}

void RelativePose::make_short() {
    Short r;
    bool fits = s_.bit_length() <= 31;
    for (std::size_t i = 0; i < 3; ++i) {
        fits = fits && t_[i].bit_length() <= 62;
        for (std::size_t j = 0; j < 3; ++j) fits = fits && m_[i][j].bit_length() <= 31;
    }
    if (!fits) return;
    const auto number = [](const BoundedInt& v) {
        return static_cast<std::int64_t>(v.to_int128());
    };
    r.s = number(s_);
    for (std::size_t i = 0; i < 3; ++i) {
        r.t[i] = number(t_[i]);
        r.bits = std::max(r.bits, t_[i].bit_length());
        for (std::size_t j = 0; j < 3; ++j) {
            r.m[i][j] = number(m_[i][j]);
            r.bits = std::max(r.bits, m_[i][j].bit_length());
        }
    }
    short_ = r;
}

void RelativePose::make_doubles() {
    // Two conversions (2^-52 each) and a division: below 2^-50.
    const BoundedInt::Scaled s = s_.scaled();
    const auto quotient = [&](const BoundedInt& v, int largest) {
        if (v.is_zero()) return 0.0;
        const BoundedInt::Scaled n = v.scaled();
        const int e = n.exponent - s.exponent;
        has_doubles_ = has_doubles_ && e >= -200 && e <= largest;
        return std::ldexp(n.mantissa / s.mantissa, e);
    };
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) fm_[i][j] = quotient(m_[i][j], 200);
        ft_[i] = quotient(t_[i], 250);
    }
}

RelativePose relative_pose(const Pose& to, Lattice to_lattice, const Pose& from,
                           Lattice from_lattice) {
    const MapNumbers a = numbers_of(to);
    const MapNumbers b = numbers_of(from);
    MapNumbers r;
    const bool inverted = !to.is_translation();
    if (inverted) {
        const std::array<IntVector, 3> adjoint = adjugate(a.m);
        const IntVector first = column(adjoint, 0);
        r.s = dot(a.m[0], first) * b.s;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = a.s * dot(adjoint[i], column(b.m, j));
            r.t[i] = a.s * b.t[i] - b.s * a.t[i];
        }
        r.t = detail::apply(adjoint, r.t);
        if (r.s.sign() < 0) r = negated(r);
    } else {
        r.s = a.s * b.s;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = a.s * b.m[i][j];
            r.t[i] = a.s * b.t[i] - b.s * a.t[i];
        }
    }
    remove_odd_factor(r);
    remove_twos(r, from_lattice.exponent - to_lattice.exponent, -to_lattice.exponent,
                RelativePose::bits);
    return RelativePose(r.m, r.t, r.s);
}

}  // namespace trisect::detail
