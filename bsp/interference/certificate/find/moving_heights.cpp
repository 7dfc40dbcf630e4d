// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/certificate/find/moving_heights.h>

#include <array>
#include <vector>

#include <trisect/brep/number/gmp_conversion.h>

namespace trisect::detail {

namespace {

// Integers in place of fractions: a point times a weight.
struct Scaled {
    std::array<mpz_class, 3> x;
    mpz_class weight;

    explicit Scaled(const GmpVector& v) {
        const std::vector<mpz_class> n =
            common_numerators(std::vector<mpq_class>(v.begin(), v.end()), weight);
        x = {n[0], n[1], n[2]};
    }
};

}  // namespace

MovingPoint::MovingPoint(const MotionPiece& map, const GmpVector& p) {
    const Scaled s(p);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) x[i].add_multiple(map.matrix[i][j], s.x[j]);
        x[i].add_multiple(map.shift[i], s.weight);
    }
    w = map.weight * s.weight;
}

IntegerPolynomial height(const GmpVector& n, const mpq_class& c, const MovingPoint& p) {
    mpz_class denominator;
    const std::vector<mpz_class> k =
        common_numerators(std::vector<mpq_class>{n[0], n[1], n[2], c}, denominator);
    IntegerPolynomial r = p.w * k[3];
    for (std::size_t i = 0; i < 3; ++i) r.add_multiple(p.x[i], k[i]);
    return r;
}

PolynomialVector way_from(const GmpVector& q, const MovingPoint& p) {
    const Scaled s(q);
    PolynomialVector r;
    for (std::size_t i = 0; i < 3; ++i) {
        r[i] = p.x[i] * s.weight;
        r[i].add_multiple(p.w, mpz_class(-s.x[i]));
    }
    return r;
}

PolynomialVector moving_direction(const MotionPiece& map, const GmpVector& v) {
    const Scaled s(v);
    PolynomialVector r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) r[i].add_multiple(map.matrix[i][j], s.x[j]);
    return r;
}

PolynomialVector constant(const GmpVector& v) {
    const Scaled s(v);
    return {IntegerPolynomial(s.x[0]), IntegerPolynomial(s.x[1]), IntegerPolynomial(s.x[2])};
}

}  // namespace trisect::detail
