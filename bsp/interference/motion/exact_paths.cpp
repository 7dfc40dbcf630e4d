// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/motion/exact_paths.h>

#include <algorithm>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

void ExactPoints::add(const Point& p) {
    if (p.is_lattice() && p.lattice().is_whole()) {
        const auto x = to_integers(p.lattice());
        xyz.push_back({to_gmp(x[0]) * weight, to_gmp(x[1]) * weight, to_gmp(x[2]) * weight});
        return;
    }
    const HomogeneousPoint h = p.homogeneous();
    const mpz_class w = to_gmp(h.w);
    for (auto& v : xyz)
        for (mpz_class& c : v) c *= w;
    xyz.push_back(
        {to_gmp(h.xyz[0]) * weight, to_gmp(h.xyz[1]) * weight, to_gmp(h.xyz[2]) * weight});
    weight *= w;
}

MpzVector difference(const MpzVector& a, const MpzVector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

PolynomialVector constant(const MpzVector& v) {
    return {IntegerPolynomial(v[0]), IntegerPolynomial(v[1]), IntegerPolynomial(v[2])};
}

PolynomialVector times(const PolynomialMatrix& m, const MpzVector& v) {
    PolynomialVector r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) r[i].add_multiple(m[i][j], v[j]);
    return r;
}

PolynomialVector moving_path(const RelativeMotion& motion, const ExactPoints& points,
                             std::size_t i) {
    PolynomialVector r = times(motion.point.matrix, points.xyz[i]);
    for (std::size_t k = 0; k < 3; ++k) r[k].add_multiple(motion.point.shift[k], points.weight);
    return r;
}

PolynomialVector resting_path(const RelativeMotion& motion, const ExactPoints& points,
                              std::size_t i) {
    PolynomialVector r;
    for (std::size_t k = 0; k < 3; ++k) r[k].add_multiple(motion.point.weight, points.xyz[i][k]);
    return r;
}

bool cross_at(RealRoot& s, const RelativeMotion& motion, const ExactLine& a, const ExactLine& b) {
    const PolynomialVector normal =
        cross(constant(a.direction), times(motion.point.matrix, b.direction));
    const auto is_zero = [&s](const IntegerPolynomial& p) { return s.sign_of(p) == 0; };
    if (std::ranges::all_of(normal, is_zero)) return false;
    ExactPoints points;
    points.add(a.point);
    points.add(b.point);
    return !dot(normal, moving_path(motion, points, 1) - resting_path(motion, points, 0)).is_zero();
}

}  // namespace trisect::detail
