// SPDX-License-Identifier: Apache-2.0
//
// The relative pose, A^-1 B, in doubles with an error bound.
//
// Let e = 2^-50 bound the relative errors of the numbers of both poses (Pose::approximate) and u =
// 2^-53. With c_ij the cofactors of A's matrix and c'_ij the same with magnitudes added:
//   a cofactor, two products of two numbers, is off by (2 e + 3 u)(1 + small) c' < 2.5 e c';
//   the determinant, three products of a number and a cofactor, by < 4 e D with D = Σ |a_0j| c'_0j;
//   an entry of the inverse, c / det, by (2.5 e c' + |c / det| 4 e D) / (|det| - 4 e D) + u |c /
//   det|.
// An entry of the product, three terms: Σ (err |b| + |inverse| (e + 3 u) |b|); the translation
// likewise with b = t_B - t_A, known within e (|t_A| + |t_B|) + u |b|. All bounds are enlarged
// by 1.01 for products of errors and the roundings of the bounds. Changes of unit are powers of
// two.

#include <trisect/bsp/detail/approximate_map.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trisect::detail {

namespace {

constexpr double e = 0x1p-50;
constexpr double u = 0x1p-53;
// Of an error bound computed in doubles.
constexpr double more = 1.01;

struct Inverse {
    std::array<std::array<double, 3>, 3> m;
    std::array<std::array<double, 3>, 3> error;
    bool certain = false;  // that there is one
};

// The larger of two bounds; what is not a number is no bound.
double worse(double a, double b) {
    return b < std::numeric_limits<double>::infinity() ? std::max(a, b)
                                                       : std::numeric_limits<double>::infinity();
}

Inverse inverse_of(const std::array<double, 12>& a) {
    const auto at = [&a](std::size_t i, std::size_t j) { return a[4 * (i % 3) + j % 3]; };
    std::array<std::array<double, 3>, 3> c{};
    std::array<std::array<double, 3>, 3> size{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const double one = at(i + 1, j + 1) * at(i + 2, j + 2);
            const double other = at(i + 1, j + 2) * at(i + 2, j + 1);
            c[i][j] = one - other;
            size[i][j] = std::abs(one) + std::abs(other);
        }
    double det = 0;
    double det_size = 0;
    for (std::size_t j = 0; j < 3; ++j) {
        det += at(0, j) * c[0][j];
        det_size += std::abs(at(0, j)) * size[0][j];
    }
    const double det_error = more * 4 * e * det_size;
    const double least = std::abs(det) - det_error;
    Inverse r{};
    r.certain = least > 0.5 * std::abs(det);
    if (!r.certain) return r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const double v = c[j][i] / det;
            r.m[i][j] = v;
            r.error[i][j] =
                more * ((2.5 * e * size[j][i] + std::abs(v) * det_error) / least + u * std::abs(v));
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
    const Inverse inverse = inverse_of(a);
    const double m_unit = std::ldexp(1.0, from_lattice.exponent - to_lattice.exponent);
    const double t_unit = std::ldexp(1.0, -to_lattice.exponent);
    ApproximateMap r;
    if (!inverse.certain) {
        r.m_error = r.t_error = std::numeric_limits<double>::infinity();
        return r;
    }
    std::array<double, 3> way{};
    std::array<double, 3> way_error{};
    for (std::size_t k = 0; k < 3; ++k) {
        way[k] = b[4 * k + 3] - a[4 * k + 3];
        way_error[k] = e * (std::abs(b[4 * k + 3]) + std::abs(a[4 * k + 3])) + u * std::abs(way[k]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            double sum = 0;
            double error = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const double v = b[4 * k + j];
                sum += inverse.m[i][k] * v;
                error +=
                    (inverse.error[i][k] + std::abs(inverse.m[i][k]) * (e + 3 * u)) * std::abs(v);
            }
            r.m[i][j] = sum * m_unit;
            r.m_error = worse(r.m_error, more * error * m_unit);
        }
        double sum = 0;
        double error = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            sum += inverse.m[i][k] * way[k];
            error += (inverse.error[i][k] + std::abs(inverse.m[i][k]) * 3 * u) *
                         (std::abs(way[k]) + way_error[k]) +
                     std::abs(inverse.m[i][k]) * way_error[k];
        }
        r.t[i] = sum * t_unit;
        r.t_error = worse(r.t_error, more * error * t_unit);
    }
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
