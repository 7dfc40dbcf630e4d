// SPDX-License-Identifier: Apache-2.0
//
// Elsewhere planes are pulled back and no vertex is moved, because signs against planes stay short
// that way. Distances have no such way: they want both bodies in one Euclidean space, and under a
// pose that is no rotation not even the lattice of one of them is that. So both are put into a
// space that is the world without A's translation, times the common denominator of the poses:
// integers again, times a power of two where coordinates have fractions; nothing is rounded.
// Filters decide nearly everything, so that the length of these integers matters little.
//
// Doubles. Entries of a pose are known within 2^-50 of themselves (Pose::approximate). A
// coordinate of M x takes three products and two sums, 3.0 · 2^-53 of the sum of magnitudes, with
// the entries' error below 1.5 · 2^-50; of A's it is below 2^-49 row reach. B's has the translation
// t_b - t_a besides: errors 2^-50 (|t_a| + |t_b|) and two roundings, all below 2^-49 (row reach +
// |t_a| + |t_b|). Scaling by powers of two is exact but for underflow, for which 2^-1000 is added.

#include <trisect/bsp/hierarchies/convex/common_frame.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/hierarchies/convex/exact_frame.h>
#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect::hierarchies {

namespace {

using trisect::detail::to_gmp;

mpz_class to_mpz(const trisect::detail::BoundedInt& v) {
    return to_gmp(v.to_wide<trisect::detail::BoundedInt::capacity>());
}

mpz_class times_power(const mpz_class& v, int exponent) {
    mpz_class r;
    mpz_mul_2exp(r.get_mpz_t(), v.get_mpz_t(), static_cast<mp_bitcnt_t>(exponent));
    return r;
}

}  // namespace

CommonFrame::CommonFrame() = default;
CommonFrame::CommonFrame(CommonFrame&&) noexcept = default;
CommonFrame& CommonFrame::operator=(CommonFrame&&) noexcept = default;
CommonFrame::~CommonFrame() = default;

CommonFrame::CommonFrame(const Pose& pose_a, Lattice lattice_a, double reach_a, const Pose& pose_b,
                         Lattice lattice_b, double reach_b)
    : pose_a_(pose_a), pose_b_(pose_b), lattice_a_(lattice_a), lattice_b_(lattice_b) {
    const auto a = pose_a.approximate();
    const auto b = pose_b.approximate();
    double translations = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            a_.m[i][j] = std::ldexp(a[4 * i + j], lattice_a.exponent);
            b_.m[i][j] = std::ldexp(b[4 * i + j], lattice_b.exponent);
        }
        b_.t[i] = b[4 * i + 3] - a[4 * i + 3];
        translations = std::max(translations, std::abs(a[4 * i + 3]) + std::abs(b[4 * i + 3]));
    }
    a_.mirror = pose_a.is_mirror();
    b_.mirror = pose_b.is_mirror();
    normalise(reach_a, reach_b, 0x1p-49 * translations);
}

CommonFrame CommonFrame::in_lattice_of_a(const Pose& pose_a, Lattice lattice_a, double reach_a,
                                         const Pose& pose_b, Lattice lattice_b, double reach_b) {
    CommonFrame r;
    r.pose_a_ = pose_a;
    r.pose_b_ = pose_b;
    r.lattice_a_ = lattice_a;
    r.lattice_b_ = lattice_b;
    r.in_world_ = false;
    const auto map = trisect::detail::approximate_map(pose_a, lattice_a, pose_b, lattice_b);
    r.b_.mirror = pose_a.is_mirror() != pose_b.is_mirror();
    r.b_.m = map.m;
    r.b_.t = map.t;
    // The map's own errors, and roundings as above.
    r.normalise(reach_a, reach_b,
                map.is_usable() ? 1.001 * map.error_below(reach_b, 0)
                                : std::numeric_limits<double>::infinity());
    return r;
}

void CommonFrame::normalise(double reach_a, double reach_b, double extra) {
    double size_a = 0;
    double size_b = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto row = [&](const Map& m) {
            return std::abs(m.m[i][0]) + std::abs(m.m[i][1]) + std::abs(m.m[i][2]);
        };
        size_a = std::max(size_a, row(a_) * reach_a);
        size_b = std::max(size_b, row(b_) * reach_b + std::abs(b_.t[i]));
    }
    const double size = std::max(size_a, size_b);
    if (!std::isfinite(size) || !std::isfinite(extra) || size > 0x1p900) {
        // No filter will ever decide.
        a_.error = b_.error = std::numeric_limits<double>::infinity();
        return;
    }
    const int exponent = size > 0x1p-900 ? std::ilogb(size) + 1 : -900;
    unit_ = std::ldexp(1.0, exponent);
    for (Map* m : {&a_, &b_}) {
        for (auto& row : m->m)
            for (double& v : row) v = std::ldexp(v, -exponent);
        for (double& v : m->t) v = std::ldexp(v, -exponent);
    }
    // In A's lattice A's coordinates are exact; a bound that is too large does no harm.
    a_.error = std::ldexp(1.001 * 0x1p-49 * size_a, -exponent) + 0x1p-1000;
    b_.error = std::ldexp(1.001 * (0x1p-49 * size_b + extra), -exponent) + 0x1p-1000;
}

const CommonFrame::Exact& CommonFrame::exact(bool whole) const {
    std::unique_ptr<Exact>& known = exact_[whole ? 0 : 1];
    if (known) return *known;
    known = made_exact();
    if (!whole) {
        known->bits = fraction_limit;
        known->scale = known->scale * (mpz_class(1) << static_cast<mp_bitcnt_t>(fraction_limit));
    }
    return *known;
}

std::unique_ptr<CommonFrame::Exact> CommonFrame::made_exact() const {
    auto e = std::make_unique<Exact>();
    if (in_world_) {
        const mpz_class s_a = to_gmp(pose_a_.denominator());
        const mpz_class s_b = to_gmp(pose_b_.denominator());
        const mpz_class g = gcd(s_a, s_b);
        const mpz_class factor_a = s_b / g;
        const mpz_class factor_b = s_a / g;
        const int low = std::min({0, lattice_a_.exponent, lattice_b_.exponent});
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                e->a.m[i][j] =
                    times_power(factor_a * to_gmp(pose_a_.matrix(i, j)), lattice_a_.exponent - low);
                e->b.m[i][j] =
                    times_power(factor_b * to_gmp(pose_b_.matrix(i, j)), lattice_b_.exponent - low);
            }
            const mpz_class t = factor_b * to_gmp(pose_b_.translation(i)) -
                                factor_a * to_gmp(pose_a_.translation(i));
            e->b.t[i] = times_power(t, -low);
        }
        e->scale = times_power(factor_a * s_a, -low);
    } else {
        const auto r = trisect::detail::relative_pose(pose_a_, lattice_a_, pose_b_, lattice_b_);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) e->b.m[i][j] = to_mpz(r.row(i)[j]);
            e->a.m[i][i] = to_mpz(r.denominator());
            e->b.t[i] = to_mpz(r.translation()[i]);
        }
        e->scale = to_mpz(r.denominator());
    }
    return e;
}

}  // namespace trisect::hierarchies
