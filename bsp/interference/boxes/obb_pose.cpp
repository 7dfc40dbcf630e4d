// SPDX-License-Identifier: Apache-2.0
//
// Why a box test in floats is a proof.
//
// Coordinates y = U_A (x - c_A), U_A the float axes of box A as they are: there the slabs of A are
// |y_i| <= a_i exactly, and the image of box B is t + Σ s_j b_j r_j, |s_j| <= b_j, with r_j = U_A M
// u_j and t = U_A (M c_B + T - c_A). For any vector L, however it came about,
//
//     |L·t| > Σ a_i |L_i| + Σ b_k |L·r_k|
//
// proves the two sets, hence all that the boxes contain, disjoint. So axes need not be right, only
// the two sides of this inequality must be bounded. Let u = 2^-24, s the scale of M (M^T M = s² I
// up to 2^-24, checked), M' = M / s, b' = s b, r' = r / s, and
//
//     Λ = |T| + reach_A + s reach_B
//
// in units of A. All vectors above are at most Λ long, |r'| <= 1 + 2^-20, |u_j| <= 1 + 2^-23.
//
// (1) Errors of r'. An entry of M' carries u of itself; a product of three terms 3 u of the
//     product of lengths (Cauchy-Schwarz). U_A M': 4 u. Times u_j: (4 √3 + 3) u < 10 u. In the
//     order M' u_j first the same.
// (2) Errors of t. With U_A M' first: the product with c_B has (4 √3 + 3) u s|c_B|, times the
//     float s two u more; the other part U_A (T - c_A): (2 + 3) u (|T| + reach_A) and one rounding
//     of T; the sum: u Λ. With M c_B + T first: each component of the image minus c_A is off by at
//     most (6 s reach_B + 3 |T| + reach_A) u, √3 times that after U_A, and 3 u Λ. Both are below 16
//     u Λ. The doubles T and M' have errors of their own, e_T and e_M; these add at most 2 e_T + 6
//     e_M reach_B.
// (3) L = e_i: left side as (2); right side Σ b'_j |r'_ij|: 10 u Σ b'.
// (4) L = r'_j as computed: left √3·16 u Λ + 3 √3 u Λ < 33 u Λ, plus twice the doubles' errors.
//     Right: Σ a_i |L_i| exact; r'_k·L differs from δ_kj by the deviation of U_A^T U_A, U_B^T U_B
//     and M'^T M' from I (3·2^-22 in all) and by 10 √3 u: at most 2^-18.5. So Σ b'_k |r'_k·L| <=
//     b'_j + 2^-18.5 Σ b'.
// (5) L = e_i × r'_j: left √2·16 u Λ + 3 √2 u Λ < 33 u Λ; right: L·r'_j <= 18 u, and for k ≠ j
//     |L·r'_k| = |e_i·(r'_j × r'_k)|, where r'_j × r'_k = ± r'_l up to the same deviations,
//     2^-18.5. A mirror image changes the sign only.
//
// So `margin_` = 2^-18 Λ + 4 e_T + 12 e_M reach_B and 2^-18 Σ b' serve all fifteen axes. Rounding
// of the right sides, at most seven relative u, is paid for by the halves, which were made larger
// by 2^-21 (obb_tree.cpp). Underflow adds less than 2^-140 Λ.
//
// A sweep adds its length times |L|, which is at most 1 + 2^-19, to the left side.
//
// Gaps. Along a vector L, whatever its length up to 1 + 2^-20, the left side minus the right side
// bounds the distance from below times that length. L = t as computed: t·t differs from |t|² by
// √3·16 u |t| Λ, products r'_k·t by 10 √3 u |t|; divided by |t| both are paid for by the same
// margin. Of any other vector L the left side has 19 √3 u |L| Λ and the right one 21 u |L| Σ b'.
// The factor 1 - 2^-18 takes the lengths and the last roundings. So along a vector shorter
// than 1, as products are, it says less than the distance, which is right, too.
//
// Planes that were found under another pose (separating_planes.h). The distance of the two sets
// along L, in the frame of box A, is that along U_A^T L in A, whatever U_A is. That direction n, of
// length at most 1 + 2^-20, is computed up to 7 u, which changes distances by 7 u Λ. B's second set
// is within Σ s_j b_j u_j of its centre, so that under another map, M + D, its least place along n
// is at least
//
//     n·(M c_B + T) - Σ b_j |n·M u_j| - |D| |b| (1 + 2^-20),
//
// and the first two terms are known as the gap under M, A's reach and n·(M c_B + T) under M. A
// place n·T + M'^T n · c_B s is computed up to 6 u |T| + 11 u s reach_B + u Λ < 18 u Λ; the sum
// that is kept has three roundings, of terms below Λ each (|b| <= reach_B, |D| <= 2 s), the other
// one six. So each of the two is off by less than 32 u Λ, and the margins, 64 u Λ, are taken from
// both.
//
// Displacements. |ΔM x + Δt| <= |ΔM| |x| + |Δt|. Similarities are M = s Q + E, |E| < 2^-23 s, and
// the difference of two rotations has singular values 0, σ, σ, so its norm is its Frobenius norm
// over √2. With |s - s'|, √3 times that and the E in the Frobenius norm, and the scales as floats:
// |ΔM| < |ΔM|_F / √2 + 2.5 |s - s'| + 2^-21 (s + s').
//
// A map that is not a similarity: scale is a bound on the length of any image of a unit vector, so
// that again |r'| <= 1; (3) holds as it is, in (4) the products r'_k·L are computed (error below
// 30 u), and no products of edges are tried.

#include <trisect/bsp/interference/boxes/obb_pose.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

ObbPose::ObbPose(const ObbTree& a, const ObbTree& b, const ApproximateMap& map, double sweep) {
    const double factor = b.unit / a.unit;
    std::array<Vector3, 3> m{};
    Vector3 t{};
    double matrix_error = map.m_error * factor;
    double way_error = 0;
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double sum = map.t[i];
        double size = std::abs(map.t[i]) + std::abs(a.origin[i]);
        for (std::size_t j = 0; j < 3; ++j) {
            m[i][j] = map.m[i][j] * factor;
            largest = std::max(largest, std::abs(m[i][j]));
            sum += map.m[i][j] * b.origin[j];
            size += std::abs(map.m[i][j] * b.origin[j]);
            way_error += map.m_error * std::abs(b.origin[j]);
        }
        t[i] = (sum - a.origin[i]) / a.unit;
        way_error += 0x1p-50 * size + map.t_error;
    }
    way_error = bound_slack * way_error / a.unit;
    matrix_error += 0x1p-50 * largest;

    matrix_ = m;
    way_ = t;
    radius_ = b.radius;
    matrix_error_ = matrix_error;
    inexact_ = 2 * way_error + 3 * matrix_error * b.reach;

    // The squares of lengths of images, and how far they are from one number.
    std::array<Vector3, 3> gram{};
    double rows = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double row = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 3; ++k) gram[i][j] += m[k][i] * m[k][j];
            row += std::abs(gram[i][j]);
        }
        rows = std::max(rows, row);
    }
    const double square = (gram[0][0] + gram[1][1] + gram[2][2]) / 3;
    double off = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            off = std::max(off, std::abs(gram[i][j] - (i == j ? square : 0)));
    rigid_ = off <= 0x1p-25 * square && matrix_error <= 0x1p-28 * std::sqrt(square);
    const double scale =
        rigid_ ? std::sqrt(square) : bound_slack * std::sqrt(rows) + 3 * matrix_error;

    mirrors_ = dot(m[0], cross(m[1], m[2])) < 0;

    const double length = std::sqrt(dot(t, t));
    const double way = bound_slack * sweep / a.unit;
    const double reach =
        1.001 * (a.reach + (scale + 3 * matrix_error) * b.reach) + 2 * way_error + way;
    apart_ = length > 1.001 * reach;
    clearance_ = 0.9999 * length - bound_slack * (a.radius + (scale + 3 * matrix_error) * b.radius +
                                                  way + 2 * way_error);
    const double lambda = length + reach;
    const double margin = 0x1p-18 * lambda + 4 * way_error + 12 * matrix_error * b.reach + way;
    scale_ = static_cast<float>(scale);
    const double per_scale = 1 / scale;
    for (std::size_t i = 0; i < 3; ++i) {
        t_[i] = static_cast<float>(t[i]);
        for (std::size_t j = 0; j < 3; ++j) m_[i][j] = static_cast<float>(m[i][j] * per_scale);
    }
    // Beyond the range of floats nothing is certain.
    const bool in_range = scale < 0x1p100 && lambda < 0x1p100;
    margin_ = in_range ? static_cast<float>(bound_slack * margin)
                       : std::numeric_limits<float>::infinity();
}

// Of the matrices as they are in doubles, and up to rounding.
double ObbPose::stretch_from(const ObbPose& other) const {
    double squares = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const double d = matrix_[i][j] - other.matrix_[i][j];
            squares += d * d;
        }
    const double stretch = std::sqrt(squares);
    if (!rigid_ || !other.rigid_ || mirrors_ != other.mirrors_) return stretch;
    const auto s = static_cast<double>(scale_);
    const auto t = static_cast<double>(other.scale_);
    return std::min(stretch, 0.70711 * stretch + 2.5 * std::abs(s - t) + 0x1p-21 * (s + t));
}

// The factors take the roundings.
double ObbPose::turn_from(const ObbPose& other) const {
    return bound_slack * stretch_from(other) + 3 * (matrix_error_ + other.matrix_error_);
}

double ObbPose::displacement_from(const ObbPose& other) const {
    double way = 0;
    for (std::size_t i = 0; i < 3; ++i)
        way += (way_[i] - other.way_[i]) * (way_[i] - other.way_[i]);
    return bound_slack * (stretch_from(other) * radius_ + std::sqrt(way)) + inexact_ +
           other.inexact_;
}

}  // namespace trisect::detail
