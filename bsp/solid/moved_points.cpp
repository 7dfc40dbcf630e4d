// SPDX-License-Identifier: Apache-2.0
//
// A sum of pairs is off by less than 2^-94 of the magnitudes of its terms: numbers of the matrix
// and coordinates by 2^-98 of themselves, products and sums by 2^-100.

#include <trisect/bsp/solid/moved_points.h>

#include <cmath>
#include <cstddef>

#include <trisect/brep/measure/exact_values.h>

namespace trisect::detail {

namespace {

double nearest_double(const mpq_class& v) {
    return to_rational(v.get_num(), v.get_den()).to_double();
}

mpq_class in_users_units(mpq_class v, Lattice lattice) {
    if (lattice.exponent < 0) {
        v >>= static_cast<unsigned long>(-lattice.exponent);
    } else {
        v <<= static_cast<unsigned long>(lattice.exponent);
    }
    return v;
}

DoublePair to_double_pair(const mpq_class& v) {
    const double high = nearest_double(v);
    return {high, std::isfinite(high) ? nearest_double(v - mpq_class(high)) : 0};
}

// In lattice units. \pre not beyond doubles
std::array<DoublePair, 3> coordinates_of(const Point& point) {
    std::array<DoublePair, 3> out;
    if (point.is_lattice()) {
        const std::array<double, 3> c = point.lattice().doubles();
        for (std::size_t k = 0; k < 3; ++k) out[k].high = c[k];
        return out;
    }
    const HomogeneousPoint& h = point.plane_point()->exact;
    const ScaledPair w = to_scaled_pair(h.w);
    for (std::size_t k = 0; k < 3; ++k) {
        const ScaledPair x = to_scaled_pair(h.xyz[k]);
        const double factor = std::ldexp(1, 64 * (x.shift - w.shift));
        const DoublePair quotient = divide(x.value, w.value);
        out[k] = {quotient.high * factor, quotient.low * factor};
    }
    return out;
}

}  // namespace

Point3d to_doubles(const MovedPoints::Exact& p) {
    return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
}

MovedPoints::MovedPoints(const Pose& pose, Lattice lattice) : lattice_(lattice) {
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) m_[i][j] = to_integer(pose.matrix(i, j));
        t_[i] = to_integer(pose.translation(i));
    }
    s_ = to_integer(pose.denominator());
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            rows_[i][j] = to_double_pair(in_users_units(fraction(m_[i][j], s_), lattice));
        rows_[i][3] = to_double_pair(fraction(t_[i], s_));
    }
}

MovedPoints::Exact MovedPoints::exact(const Point& point) const {
    const Corner p = corner_at(point);
    Exact out;
    for (std::size_t i = 0; i < 3; ++i) {
        const mpz_class sum = m_[i][0] * p.x[0] + m_[i][1] * p.x[1] + m_[i][2] * p.x[2];
        out[i] = in_users_units(fraction(sum, p.w * s_), lattice_) + fraction(t_[i], s_);
    }
    return out;
}

Point3d MovedPoints::nearest(const Point& point) const {
    if (const auto known = from_pairs(point)) return *known;
    return to_doubles(exact(point));
}

// What overflows has no nearest double here, and small sums are left to fractions.
std::optional<Point3d> MovedPoints::from_pairs(const Point& point) const {
    const std::array<DoublePair, 3> p = coordinates_of(point);
    Point3d out{};
    for (std::size_t i = 0; i < 3; ++i) {
        DoublePair sum = rows_[i][3];
        double size = std::fabs(sum.high);
        for (std::size_t j = 0; j < 3; ++j) {
            const DoublePair term = multiply(rows_[i][j], p[j]);
            size += std::fabs(term.high);
            sum = add(sum, term);
        }
        if (!(size > 0x1p-500)) return std::nullopt;
        const double slack = 0x1p-94 * size + 0x1p-50 * std::fabs(sum.low);
        if (sum.high + (sum.low + slack) != sum.high || sum.high + (sum.low - slack) != sum.high)
            return std::nullopt;
        out[i] = sum.high;
    }
    return out;
}

}  // namespace trisect::detail
