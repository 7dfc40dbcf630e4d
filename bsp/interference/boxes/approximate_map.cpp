// SPDX-License-Identifier: Apache-2.0
//
// The relative pose, A^-1 B, in doubles with an error bound.
//
// Let e = 2^-50 bound the relative errors of the numbers of both poses (Pose::approximate) and u =
// 2^-53. One bound for all entries of a matrix is worse than one for each by a small factor, and
// takes a third of the time. With c_ij the cofactors of A's matrix, C the largest sum of the
// magnitudes of the two products in one, and v = 1 / det:
//   a cofactor, two products of two numbers, is off by (2 e + 3 u)(1 + small) C < 2.5 e C;
//   the determinant, three products of a number and a cofactor, by < 4 e D with D = Σ |a_0j| C;
//   an entry c v of the inverse, V the largest one, by (2.5 e C + V 4 e D) / (|det| - 4 e D) + 3 u
//   V.
// An entry of the product, three terms: (err + V (e + 3 u)) times the largest sum of magnitudes in
// a column of B; the translation likewise with b = t_B - t_A, known within e (|t_A| + |t_B|) + u
// |b|. All bounds are enlarged by 1.01 for products of errors and the roundings of the bounds.
// Changes of unit are powers of two.

#include <trisect/bsp/interference/boxes/approximate_map.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/power_of_two.h>

namespace trisect::detail {

namespace {

// Of the numbers of a pose, relative.
constexpr double pose_error = 0x1p-50;
// Of an error bound computed in doubles.
constexpr double more = 1.01;

// What is not a number is no bound.
double bound(double v) { return v >= 0 ? v : std::numeric_limits<double>::infinity(); }

// A call of ldexp takes longer than the rest of a map's row.
double unit_of(int exponent) {
    return is_normal_exponent(exponent) ? power_of_two(exponent) : std::ldexp(1.0, exponent);
}

struct Inverse {
    std::array<std::array<double, 3>, 3> m;
    double error = 0;
    double largest = 0;
    bool certain = false;  // that there is one
};

Inverse inverse_of(const std::array<double, 12>& a) {
    const auto at = [&a](std::size_t i, std::size_t j) { return a[4 * (i % 3) + j % 3]; };
    std::array<std::array<double, 3>, 3> c{};
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const double one = at(i + 1, j + 1) * at(i + 2, j + 2);
            const double other = at(i + 1, j + 2) * at(i + 2, j + 1);
            c[i][j] = one - other;
            size = std::max(size, std::abs(one) + std::abs(other));
        }
    double det = 0;
    double row = 0;
    for (std::size_t j = 0; j < 3; ++j) {
        det += at(0, j) * c[0][j];
        row += std::abs(at(0, j));
    }
    const double det_error = more * 4 * pose_error * row * size;
    const double least = std::abs(det) - det_error;
    Inverse r{};
    r.certain = least > 0.5 * std::abs(det);
    if (!r.certain) return r;
    const double per_det = 1 / det;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            r.m[i][j] = c[j][i] * per_det;
            r.largest = std::max(r.largest, std::abs(r.m[i][j]));
        }
    r.error = more * ((2.5 * pose_error * size + r.largest * det_error) / least +
                      3 * unit_roundoff * r.largest);
    return r;
}

// Without an exact comparison where the numbers in doubles say that there is no need of one.
bool only_moves(const Pose& pose) {
    const std::array<double, 12>& a = pose.approximate();
    return a[0] == 1 && a[5] == 1 && a[10] == 1 && pose.is_translation();
}

// Into a solid that was not turned: what B's pose says, and no error of an inverse. Most callers
// leave one of two solids where it is.
ApproximateMap map_to_moved(const std::array<double, 12>& a, const std::array<double, 12>& b,
                            double m_unit, double t_unit) {
    ApproximateMap r;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            r.m[i][j] = b[4 * i + j] * m_unit;
            r.m_error = std::max(r.m_error, bound(more * pose_error * std::abs(r.m[i][j])));
        }
        const double way = b[4 * i + 3] - a[4 * i + 3];
        const double error = pose_error * (std::abs(b[4 * i + 3]) + std::abs(a[4 * i + 3])) +
                             unit_roundoff * std::abs(way);
        r.t[i] = way * t_unit;
        r.t_error = std::max(r.t_error, bound(more * error * t_unit));
    }
    return r;
}

}  // namespace

bool ApproximateMap::is_usable() const {
    double largest = 0;
    bool finite = std::isfinite(m_error) && std::isfinite(t_error);
    for (std::size_t i = 0; i < 3; ++i) {
        finite = finite && std::isfinite(t[i]);
        for (const double v : m[i]) {
            finite = finite && std::isfinite(v);
            largest = std::max(largest, std::abs(v));
        }
    }
    // Beyond these, products of three might leave the range of doubles.
    return finite && largest > 0x1p-200 && largest < 0x1p200 && m_error < 0x1p-30 * largest;
}

ApproximateMap approximate_map(const Pose& to, Lattice to_lattice, const Pose& from,
                               Lattice from_lattice) {
    const std::array<double, 12> a = to.approximate();
    const std::array<double, 12> b = from.approximate();
    const double m_unit = unit_of(from_lattice.exponent - to_lattice.exponent);
    const double t_unit = unit_of(-to_lattice.exponent);
    if (only_moves(to)) return map_to_moved(a, b, m_unit, t_unit);
    const Inverse inverse = inverse_of(a);
    ApproximateMap r;
    if (!inverse.certain) {
        r.m_error = r.t_error = std::numeric_limits<double>::infinity();
        return r;
    }
    std::array<double, 3> way{};
    double way_sum = 0;
    double way_error = 0;
    double column_sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        way[k] = b[4 * k + 3] - a[4 * k + 3];
        way_sum += std::abs(way[k]);
        way_error += pose_error * (std::abs(b[4 * k + 3]) + std::abs(a[4 * k + 3])) +
                     unit_roundoff * std::abs(way[k]);
        column_sum = std::max(column_sum, std::abs(b[k]) + std::abs(b[4 + k]) + std::abs(b[8 + k]));
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& row = inverse.m[i];
        for (std::size_t j = 0; j < 3; ++j)
            r.m[i][j] = (row[0] * b[j] + row[1] * b[4 + j] + row[2] * b[8 + j]) * m_unit;
        r.t[i] = (row[0] * way[0] + row[1] * way[1] + row[2] * way[2]) * t_unit;
    }
    r.m_error = bound(more * (inverse.error + inverse.largest * (pose_error + 3 * unit_roundoff)) *
                      column_sum * m_unit);
    r.t_error =
        bound(more *
              ((inverse.error + inverse.largest * 3 * unit_roundoff) * (way_sum + way_error) +
               inverse.largest * way_error) *
              t_unit);
    return r;
}

ApproximateMap approximate_map(const RelativePose& p) {
    ApproximateMap r;
    r.m = p.approx_rows();
    r.t = p.approx_translation();
    for (std::size_t i = 0; i < 3; ++i) {
        for (const double v : r.m[i])
            r.m_error = std::max(r.m_error, more * RelativePose::relative_error * std::abs(v));
        r.t_error = std::max(r.t_error, more * RelativePose::relative_error * std::abs(r.t[i]));
    }
    return r;
}

}  // namespace trisect::detail
