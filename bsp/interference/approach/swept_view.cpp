// SPDX-License-Identifier: Apache-2.0
//
// If a point of A and a point of B coincide under the true motions, they are at most the sum of
// both deviations apart under the enclosures; seen from A, at most that times the stretch of the
// inverse of A's map. That is the margin. A distance in the world is added to the deviations.

#include <trisect/bsp/interference/approach/swept_view.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

std::vector<double> common_breaks(const EnclosedMotion& a, const EnclosedMotion& b) {
    std::vector<double> r;
    if (!a.is_still()) r.assign(a.breaks().begin(), a.breaks().end());
    if (!b.is_still() || a.is_still()) r.insert(r.end(), b.breaks().begin(), b.breaks().end());
    std::ranges::sort(r);
    r.erase(std::unique(r.begin(), r.end()), r.end());
    return r;
}

// The square of the stretch, if the matrix over the weight is a multiple of a rotation all the
// time, the same one; otherwise 0.
mpq_class square_of_similarity(const MotionPiece& piece) {
    const PolynomialMatrix gram = transposed(piece.matrix) * piece.matrix;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (i == j ? !(gram[i][j] == gram[0][0]) : !gram[i][j].is_zero()) return {};
    const IntegerPolynomial weight = piece.weight * piece.weight;
    if (gram[0][0].is_zero() || !(gram[0][0] * weight.leading() == weight * gram[0][0].leading()))
        return {};
    mpq_class square(gram[0][0].leading(), weight.leading());
    square.canonicalize();
    return square;
}

}  // namespace

double reach_of(const Boundary& data) {
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double v = std::max(std::abs(data.lo[i]), std::abs(data.hi[i]));
        square += v * v;
    }
    return std::ldexp(std::sqrt(square) * surely_more, data.lattice.exponent);
}

bool is_about_similar(const MotionPiece& piece) {
    for (const mpq_class& s : {mpq_class(0), mpq_class(1, 2), mpq_class(1)}) {
        std::array<std::array<double, 3>, 3> m{};
        const mpq_class weight = piece.weight.value_at(s);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                m[i][j] = mpq_class(piece.matrix[i][j].value_at(s) / weight).get_d();
        const auto gram = [&m](std::size_t i, std::size_t j) {
            return m[0][i] * m[0][j] + m[1][i] * m[1][j] + m[2][i] * m[2][j];
        };
        const double size = gram(0, 0);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                if (!(std::abs(gram(i, j) - (i == j ? size : 0)) <= 0x1p-40 * size)) return false;
    }
    return true;
}

double inverse_stretch_of(const MotionPiece& piece) {
    // Of the inverse, so that it is large where the motion makes things small.
    const mpq_class square = square_of_similarity(piece);
    const double d = sgn(square) > 0 ? mpq_class(1 / square).get_d() : 0;
    if (std::isnormal(d)) return std::sqrt(d) * surely_more;
    return inverse_stretch(BallMotion::of_points(piece));
}

SweptViews::SweptViews(const Boundary& a, const EnclosedMotion& motion_a, const Boundary& b,
                       const EnclosedMotion& motion_b)
    : a_(a),
      motion_a_(motion_a),
      b_(b),
      motion_b_(motion_b),
      breaks_(common_breaks(motion_a, motion_b)),
      reach_a_(reach_of(a)),
      reach_b_(reach_of(b)) {
    if (!motion_a.is_still() && !motion_b.is_still() && motion_a.duration() != motion_b.duration())
        throw UsageError("motions of different duration do not run together");
}

SweptView SweptViews::view_without_margin(const Enclosures& e) const {
    const MotionPiece points =
        relative_points(piece_of(e.a.motion, 0), a_.lattice, piece_of(e.b.motion, 0), b_.lattice);
    if (!BallMotion::fits(points) || !BallMotion::fits(piece_of(e.a.motion, 0)))
        throw UnsupportedError("the relative motion of two enclosures has a degree above " +
                               std::to_string(BallPolynomial::max_degree));
    SweptView r{BallMotion::of_points(points), {}, 0};
    r.swept = swept_map(r.motion, b_.lo, b_.hi);
    return r;
}

SweptView SweptViews::view(double from, double to) const {
    const Enclosures e = enclose(from, to);
    SweptView r = view_without_margin(e);
    if (const double off = deviation(e); off != 0) {
        const BallMotion of_a = BallMotion::of_points(piece_of(e.a.motion, 0));
        r.margin = std::ldexp(off * inverse_stretch(of_a), -a_.lattice.exponent) * surely_more;
    }
    // An infinity times 0, or an infinite sweep.
    if (!(r.margin + r.swept.sweep < HUGE_VAL)) r.margin = HUGE_VAL;
    return r;
}

SweptView SweptViews::view(double from, double to, double distance) const {
    const Enclosures e = enclose(from, to);
    SweptView r = view_without_margin(e);
    const double wanted = (deviation(e) + distance) * slightly_more;
    r.margin =
        std::ldexp(wanted * inverse_stretch_of(piece_of(e.a.motion, 0)), -a_.lattice.exponent) *
        surely_more;
    if (!(r.margin + r.swept.sweep < HUGE_VAL)) r.margin = HUGE_VAL;
    return r;
}

double SweptViews::deviation_at(double time) const {
    return deviation(enclose(time, time)) * slightly_more;
}

}  // namespace trisect::detail
