// SPDX-License-Identifier: Apache-2.0
//
// Patches for tests, and their points in exact rationals.
#pragma once

#include <array>
#include <cstddef>
#include <random>
#include <vector>

#include <trisect/brep/curved/bezier_patch.h>
#include <trisect/brep/exact_rational.h>

namespace trisect::test {

using ExactPoint3 = std::array<ExactRational, 3>;

inline BezierPatch random_patch(std::mt19937_64& random, bool rational) {
    std::uniform_int_distribution<std::size_t> degree(1, 4);
    std::uniform_real_distribution<double> coordinate(-10, 10);
    std::uniform_real_distribution<double> weight(0.25, 4);
    const std::size_t p = degree(random);
    const std::size_t q = degree(random);
    std::vector<Point3d> points;
    std::vector<double> weights;
    for (std::size_t i = 0; i < (p + 1) * (q + 1); ++i) {
        points.push_back({coordinate(random), coordinate(random), coordinate(random)});
        weights.push_back(rational ? weight(random) : 1);
    }
    return {p, q, std::move(points), std::move(weights)};
}

// By the definition: Σ w B B P / Σ w B B.
inline ExactPoint3 exact_point(const BezierPatch& patch, const ExactRational& u,
                               const ExactRational& v) {
    const auto bernstein = [](std::size_t degree, const ExactRational& t) {
        std::vector<ExactRational> b{ExactRational(1)};
        for (std::size_t d = 1; d <= degree; ++d) {
            std::vector<ExactRational> next(d + 1);
            for (std::size_t k = 0; k < d; ++k) {
                next[k] += b[k] * (ExactRational(1) - t);
                next[k + 1] += b[k] * t;
            }
            b = std::move(next);
        }
        return b;
    };
    const auto bu = bernstein(patch.degree_u(), u);
    const auto bv = bernstein(patch.degree_v(), v);
    ExactPoint3 sum;
    ExactRational total;
    for (std::size_t i = 0; i <= patch.degree_u(); ++i)
        for (std::size_t j = 0; j <= patch.degree_v(); ++j) {
            const ExactRational b = bu[i] * bv[j] * ExactRational::from_double(patch.weight(i, j));
            total += b;
            for (std::size_t k = 0; k < 3; ++k)
                sum[k] += b * ExactRational::from_double(patch.point(i, j)[k]);
        }
    for (ExactRational& s : sum) s /= total;
    return sum;
}

// |p - q| <= distance, exactly.
inline bool is_within(const ExactPoint3& p, const Point3d& q, double distance) {
    ExactRational square;
    for (std::size_t k = 0; k < 3; ++k) {
        const ExactRational d = p[k] - ExactRational::from_double(q[k]);
        square += d * d;
    }
    const ExactRational r = ExactRational::from_double(distance);
    return square <= r * r;
}

}  // namespace trisect::test
