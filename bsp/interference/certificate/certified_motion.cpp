// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/certificate/certified_motion.h>

#include <algorithm>

#include <trisect/bsp/interference/motion/motion_piece.h>

namespace trisect::detail::certified {

namespace {

Polynomial converted(const IntegerPolynomial& p) {
    std::vector<ExactRational> c;
    for (const mpz_class& v : p.coefficients()) c.push_back(from_gmp(mpq_class(v)));
    return Polynomial(std::move(c));
}

}  // namespace

Piece piece_of(const Motion& motion, std::size_t i) {
    const MotionPiece& p = detail::piece_of(motion, std::min(i, motion.piece_count() - 1));
    Piece r;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < 3; ++j) r.m[k][j] = converted(p.matrix[k][j]);
        r.t[k] = converted(p.shift[k]);
    }
    r.w = converted(p.weight);
    return r;
}

Piece seen_from(const Piece& viewer, const Piece& other) {
    // Rows of the adjugate are products of columns.
    const auto column = [&viewer](std::size_t j) {
        return PolynomialVector{viewer.m[0][j], viewer.m[1][j], viewer.m[2][j]};
    };
    const Rows adjugate{cross(column(1), column(2)), cross(column(2), column(0)),
                        cross(column(0), column(1))};
    Piece r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            r.m[i][j] =
                viewer.w * (adjugate[i][0] * other.m[0][j] + adjugate[i][1] * other.m[1][j] +
                            adjugate[i][2] * other.m[2][j]);
    r.t = adjugate * (viewer.w * other.t - other.w * viewer.t);
    r.w = dot(adjugate[0], column(0)) * other.w;
    if (r.w.is_zero() || r.w.sign_at(0) >= 0) return r;
    for (PolynomialVector& row : r.m) row = PolynomialVector{} - row;
    r.t = PolynomialVector{} - r.t;
    r.w = -r.w;
    return r;
}

ControlMaps::ControlMaps(const Piece& piece, const ExactRational& from, const ExactRational& to) {
    std::size_t degree = 0;
    const auto look_at = [&degree](const Polynomial& p) {
        if (!p.is_zero()) degree = std::max(degree, p.degree());
    };
    look_at(piece.w);
    for (std::size_t i = 0; i < 3; ++i) {
        look_at(piece.t[i]);
        for (std::size_t j = 0; j < 3; ++j) look_at(piece.m[i][j]);
    }
    maps_.resize(degree + 1);
    const auto controls = [&](const Polynomial& p) {
        return bernstein_coefficients(p, degree, from, to);
    };
    const auto w = controls(piece.w);
    for (std::size_t k = 0; k <= degree; ++k) maps_[k].w = w[k];
    for (std::size_t i = 0; i < 3; ++i) {
        const auto t = controls(piece.t[i]);
        for (std::size_t k = 0; k <= degree; ++k) maps_[k].t[i] = t[k];
        for (std::size_t j = 0; j < 3; ++j) {
            const auto m = controls(piece.m[i][j]);
            for (std::size_t k = 0; k <= degree; ++k) maps_[k].m[i][j] = m[k];
        }
    }
}

std::vector<IntegerPlane> ControlMaps::planes(const SeparatingPlane& plane,
                                              const ExactPoint& resting) const {
    std::vector<IntegerPlane> r;
    for (const Map& map : maps_) {
        SeparatingPlane pulled;
        for (std::size_t j = 0; j < 3; ++j)
            pulled.normal[j] =
                dot(plane.normal, {map.m[0][j], map.m[1][j], map.m[2][j]}) + resting[j] * map.w;
        pulled.offset = dot(plane.normal, map.t) + plane.offset * map.w;
        r.emplace_back(pulled);
    }
    return r;
}

}  // namespace trisect::detail::certified
