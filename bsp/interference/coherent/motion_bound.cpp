// SPDX-License-Identifier: Apache-2.0
//
// With A and B the poses before, A' and B' now, a point x of B was at z = A^-1 B x in A, and
//
//     A'^-1 B' x - z  =  A'^-1 ((B' x - B x) - (A' z - A z)),
//
// so it has moved by at most |M_A'^-1| (|ΔB x| + |ΔA z|), where |Δ x| <= |Δ c| + |ΔM| r for all x
// in a ball around c. The norm of ΔM is at most the fourth root of the sum of the squares of ΔM^T
// ΔM, and |M_A'^-1| <= n / (1 - n |ΔM_A|) with n = |M_A^-1|. The largest displacement of an affine
// map that goes linearly from one to the other is at its end, so nothing in between moves farther.
//
// Numbers of poses are known up to 2^-50 of themselves. That and the roundings of the differences
// are less than 2^-46 of the largest size here, and are taken from the reserve; the rest is
// relative and paid for by a factor.

#include <trisect/bsp/interference/coherent/motion_bound.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

double length_of(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

// A bound on the norm of the matrix, up to rounding.
double norm(const std::array<double, 12>& m) {
    double squares = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i; j < 3; ++j) {
            double g = 0;
            for (std::size_t k = 0; k < 3; ++k) g += m[4 * k + i] * m[4 * k + j];
            squares += (i == j ? 1 : 2) * g * g;
        }
    return std::sqrt(std::sqrt(squares));
}

// A bound on the norm of the inverse of the matrix: exact up to 1 + 2^-20 for similarities.
double stretch_of_inverse(const std::array<double, 12>& m) {
    const auto at = [&m](std::size_t i, std::size_t j) { return m[4 * (i % 3) + j % 3]; };
    std::array<double, 9> gram{};
    double off = 0;
    double squares = 0;
    double det = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 3; ++k) gram[3 * i + j] += at(k, i) * at(k, j);
            const double cofactor =
                at(i + 1, j + 1) * at(i + 2, j + 2) - at(i + 1, j + 2) * at(i + 2, j + 1);
            squares += cofactor * cofactor;
            if (i == 0) det += at(0, j) * cofactor;
        }
    const double square = (gram[0] + gram[4] + gram[8]) / 3;
    for (std::size_t i = 0; i < 9; ++i)
        off = std::max(off, std::abs(gram[i] - (i % 4 == 0 ? square : 0)));
    if (square > 0 && off <= 0x1p-25 * square) return (1 + 0x1p-20) / std::sqrt(square);
    // Doubles decide nothing about a determinant much smaller than its terms.
    if (!(std::abs(det) > 0x1p-20 * square * std::sqrt(square))) return HUGE_VAL;
    return (1 + 0x1p-20) * std::sqrt(squares) / std::abs(det);
}

}  // namespace

struct MotionBound::Difference {
    Rows rows{};
    double norm = 0;
    // Of points in a ball.
    [[nodiscard]] double at(const Body& body) const {
        const auto& c = body.center;
        const auto row = [&](std::size_t i) {
            return (rows[4 * i] * c[0] + rows[4 * i + 1] * c[1]) + rows[4 * i + 2] * c[2] +
                   rows[4 * i + 3];
        };
        return length_of(row(0), row(1), row(2)) + norm * body.radius;
    }
};

MotionBound::Difference MotionBound::difference(const Rows& now, const Rows& before) {
    Difference d;
    for (std::size_t i = 0; i < 12; ++i) d.rows[i] = now[i] - before[i];
    d.norm = trisect::detail::norm(d.rows);
    return d;
}

MotionBound::Body MotionBound::body_of(const Boundary& boundary) {
    Body r;
    const int exponent = boundary.lattice.exponent;
    for (std::size_t k = 0; k < 3; ++k)
        r.center[k] = std::ldexp(boundary.boxes.origin[k], exponent);
    r.radius = std::ldexp(boundary.boxes.radius * boundary.boxes.unit, exponent);
    return r;
}

MotionBound::MotionBound(const Boundary& a, const Boundary& b)
    : a_(&a), b_boundary_(&b), b_(body_of(b)) {}

void MotionBound::set(const Pose& a, const Pose& b, const ApproximateMap& b_to_a, double reserve) {
    const double unit = std::ldexp(1.0, a_->lattice.exponent);
    if (stretch_ == 0 || rows_a_ != a.approximate()) {
        rows_a_ = a.approximate();
        stretch_ = stretch_of_inverse(rows_a_);
    }
    rows_b_ = b.approximate();
    // The map goes from lattice to lattice.
    const std::array<double, 3> center = b_to_a(b_boundary_->boxes.origin);
    std::array<double, 12> matrix{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) matrix[4 * i + k] = b_to_a.m[i][k];
    b_in_a_.radius = unit * norm(matrix) * b_boundary_->boxes.radius * b_boundary_->boxes.unit;
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        b_in_a_.center[i] = unit * center[i];
        for (const auto& [rows, body] : {std::pair(&rows_a_, &b_in_a_), std::pair(&rows_b_, &b_)})
            for (std::size_t k = 0; k < 4; ++k)
                size += std::abs((*rows)[4 * i + k]) *
                        (k == 3 ? 1 : std::abs(body->center[k]) + body->radius);
    }
    // Squares of squares of much smaller numbers are 0, those of larger ones infinite.
    const auto is_moderate = [](double v) { return v > 0x1p-200 && v < 0x1p200; };
    if (!is_moderate(stretch_) || !is_moderate(size)) return clear();
    // In the world.
    reserve_ = 0.9999 * unit * reserve / stretch_ - 0x1p-46 * size;
}

bool MotionBound::covers(const Pose& a, const Pose& b) const {
    if (!(reserve_ > 0)) return false;
    double moved = difference(b.approximate(), rows_b_).at(b_);
    if (a.approximate() == rows_a_) return moved < reserve_;
    const Difference d = difference(a.approximate(), rows_a_);
    const double shrink = stretch_ * d.norm * bound_slack;
    moved += d.at(b_in_a_);
    return shrink < 0.5 && moved < reserve_ * (1 - shrink);
}

}  // namespace trisect::detail
