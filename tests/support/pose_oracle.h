// SPDX-License-Identifier: Apache-2.0
//
// Poses as affine maps of rationals, and random poses of every kind that predicates must bear.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cmath>
#include <cstdint>

#include <trisect/kernel/number/bounded_int.h>
#include <trisect/kernel/pose.h>
#include <trisect/kernel/pose/relative_pose.h>

#include "gmp_oracle.h"

namespace oracle {

inline mpz_class integer(const trisect::detail::BoundedInt& v) {
    mpz_class sum = 0;
    for (int i = v.size() - 1; i >= 0; --i) sum = (sum << 64) + mpz_class(v.limb(i));
    return v.sign() < 0 ? mpz_class(-sum) : sum;
}

inline mpq_class power_of_two(int exponent) {
    mpq_class q(1);
    if (exponent >= 0)
        q <<= static_cast<mp_bitcnt_t>(exponent);
    else
        q >>= static_cast<mp_bitcnt_t>(-exponent);
    return q;
}

inline mpq_class quotient(const mpz_class& n, const mpz_class& d) {
    mpq_class q(n, d);
    q.canonicalize();
    return q;
}

/// x -> m x + t
struct RationalMap {
    std::array<std::array<mpq_class, 3>, 3> m;
    std::array<mpq_class, 3> t;

    [[nodiscard]] RationalPoint operator()(const RationalPoint& p) const {
        RationalPoint r = t;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) r[i] += m[i][j] * p[j];
        return r;
    }
    friend bool operator==(const RationalMap&, const RationalMap&) = default;
};

inline RationalMap scaling(const mpq_class& by) {
    RationalMap r;
    for (std::size_t i = 0; i < 3; ++i) r.m[i][i] = by;
    return r;
}

/// First b, then a.
inline RationalMap composed(const RationalMap& a, const RationalMap& b) {
    RationalMap r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) r.m[i][j] += a.m[i][k] * b.m[k][j];
    r.t = a(b.t);
    return r;
}

inline mpq_class determinant(const RationalMap& a) {
    const auto& m = a.m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

inline RationalMap inverse(const RationalMap& a) {
    RationalMap r;
    const mpq_class d = determinant(a);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t u = (j + 1) % 3;
            const std::size_t v = (j + 2) % 3;
            const std::size_t k = (i + 1) % 3;
            const std::size_t l = (i + 2) % 3;
            r.m[i][j] = (a.m[u][k] * a.m[v][l] - a.m[u][l] * a.m[v][k]) / d;
        }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) r.t[i] -= r.m[i][j] * a.t[j];
    return r;
}

inline RationalMap map_of(const trisect::Pose& p) {
    RationalMap r;
    const mpz_class s = integer(p.denominator());
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = quotient(integer(p.matrix(i, j)), s);
        r.t[i] = quotient(integer(p.translation(i)), s);
    }
    return r;
}

inline RationalMap map_of(const trisect::detail::RelativePose& p) {
    RationalMap r;
    const mpz_class s = integer(p.denominator());
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = quotient(integer(p.row(i)[j]), s);
        r.t[i] = quotient(integer(p.translation()[i]), s);
    }
    return r;
}

/// From the lattice of a solid posed by `from` to that of one posed by `to`.
inline RationalMap relative(const trisect::Pose& to, int to_exponent, const trisect::Pose& from,
                            int from_exponent) {
    return composed(scaling(power_of_two(-to_exponent)),
                    composed(inverse(map_of(to)),
                             composed(map_of(from), scaling(power_of_two(from_exponent)))));
}

inline double real(Source& random, double size) {
    return size * (static_cast<double>(random.bits() >> 11U) * 0x1p-52 - 1);
}

enum class PoseKind {
    Identity,
    Translation,
    QuarterTurns,
    Quaternion,
    WideQuaternion,
    Rotation,
    Affine,
    Spread,
    Mirror
};
inline constexpr std::array<PoseKind, 9> pose_kinds{
    PoseKind::Identity,   PoseKind::Translation,    PoseKind::QuarterTurns,
    PoseKind::Quaternion, PoseKind::WideQuaternion, PoseKind::Rotation,
    PoseKind::Affine,     PoseKind::Spread,         PoseKind::Mirror};

/// `size` is about that of the solids that are to be placed.
inline trisect::Pose random_pose(Source& random, PoseKind kind, double size) {
    using trisect::Pose;
    const auto whole = [&] { return std::floor(real(random, size)); };
    const std::array<double, 3> integers{whole(), whole(), whole()};
    const std::array<double, 3> reals{real(random, size), real(random, size), real(random, size)};
    for (;;) {
        try {
            switch (kind) {
                case PoseKind::Identity:
                    return Pose();
                case PoseKind::Translation:
                    return Pose::from_translation(random.coin() ? integers : reals);
                case PoseKind::QuarterTurns:
                    return Pose::from_quaternion({random.between(0, 1), random.between(0, 1),
                                                  random.between(0, 1), random.between(0, 1)},
                                                 integers);
                case PoseKind::Quaternion:
                    return Pose::from_quaternion({random.between(-4, 4), random.between(-4, 4),
                                                  random.between(-4, 4), random.between(-4, 4)},
                                                 integers);
                case PoseKind::WideQuaternion:
                    return Pose::from_quaternion({random.coordinate(26), random.coordinate(26),
                                                  random.coordinate(26), random.coordinate(26)},
                                                 reals);
                case PoseKind::Rotation: {
                    const double c = std::cos(real(random, 3));
                    const double s = std::sqrt(1 - c * c);
                    return Pose::from_doubles(
                        {c, -s, 0, reals[0], s, c, 0, reals[1], 0, 0, 1, reals[2]});
                }
                case PoseKind::Affine:
                case PoseKind::Mirror: {
                    std::array<double, 12> rows{};
                    for (std::size_t i = 0; i < 12; ++i)
                        rows[i] = i % 4 == 3 ? reals[i / 4] : real(random, 1);
                    const Pose p = Pose::from_doubles(rows);
                    if (kind == PoseKind::Mirror && !p.is_mirror()) continue;
                    return p;
                }
                case PoseKind::Spread: {
                    std::array<double, 12> rows{};
                    for (double& v : rows)
                        v = random.below(4) == 0
                                ? 0
                                : std::ldexp(real(random, 1),
                                             static_cast<int>(random.below(40)) - 20);
                    return Pose::from_doubles(rows);
                }
            }
        } catch (const trisect::UsageError&) {  // singular, or the quaternion 0
        }
    }
}

}  // namespace oracle
