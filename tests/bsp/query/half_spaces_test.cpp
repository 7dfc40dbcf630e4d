// SPDX-License-Identifier: Apache-2.0
//
// Queries to what half-spaces leave of a ball, of which some results have no bounds: against the
// formula, point by point.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace {

using trisect::BrepIndex;
using trisect::Expression;
using trisect::Location;
using trisect::Point3d;
using trisect::Solid;

Solid round_ball(double size, std::uint32_t level) {
    trisect::PolygonMesh mesh = trisect::make_icosphere(size, level);
    for (Point3d& p : mesh.points)
        for (double& c : p) c = std::round(c * 256) / 256;
    trisect::SolidOptions options;
    options.embedding = trisect::Embedding::Assume;
    return Solid::from_mesh(mesh, options);
}

// 1 inside, -1 outside, 0 on the boundary.
int side(const BrepIndex& index, const Point3d& p) {
    const Location l = index.locate(p).location;
    return l == Location::Inside ? 1 : (l == Location::Outside ? -1 : 0);
}

int value(std::size_t formula, int a, int h, int b) {
    const bool in_a = a > 0;
    const bool in_h = h > 0;
    const bool in = formula == 0 ? in_a && !in_h : (formula == 1 ? in_a || in_h : in_h && !in_a);
    return in && b < 0 ? 1 : -1;
}

Solid result(std::size_t formula, const Solid& a, const Solid& h, const Solid& b) {
    const Expression x = formula == 0   ? Expression(a) - Expression(h)
                         : formula == 1 ? Expression(a) | Expression(h)
                                        : Expression(h) - Expression(a);
    return evaluate(Expression(evaluate(x)) - Expression(b));
}

TEST(QueriesOfHalfSpaces, FollowTheFormula) {
    std::mt19937_64 random(3);
    const auto uniform = [&](double lo, double hi) {
        return std::uniform_real_distribution<double>(lo, hi)(random);
    };
    std::size_t compared = 0;
    for (std::size_t seed = 0; seed < 12; ++seed) {
        const Solid a = round_ball(1, 4);
        if (seed % 2 == 1) a.refine();
        const Solid b = round_ball(0.5, 2);
        std::array<double, 4> plane{std::round(uniform(-8, 8)), std::round(uniform(-8, 8)), 1,
                                    std::round(uniform(-3, 3))};
        if (seed % 4 == 0) plane = {0, 0, 1, plane[3]};
        const Solid h = Solid::half_space(plane);
        const BrepIndex index_a(a);
        const BrepIndex index_b(b);
        for (std::size_t formula = 0; formula < 3; ++formula) {
            const BrepIndex index(result(formula, a, h, b));
            for (int i = 0; i < 300; ++i) {
                Point3d p{uniform(-1.5, 1.5), uniform(-1.5, 1.5), uniform(-1.5, 1.5)};
                if (i % 7 == 0)
                    for (double& c : p) c = std::round(c * 8) / 8;
                if (i % 50 == 0)
                    for (double& c : p) c *= 1e6;
                const double v = plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3];
                const int in_a = side(index_a, p);
                const int in_b = side(index_b, p);
                if (std::fabs(v) < 1e-9 || in_a == 0 || in_b == 0) continue;
                ASSERT_EQ(side(index, p), value(formula, in_a, v < 0 ? 1 : -1, in_b))
                    << "seed " << seed << " formula " << formula << " point " << p[0] << " " << p[1]
                    << " " << p[2];
                ++compared;
                if (i % 10 != 0) continue;
                const auto nearest = index.nearest(p);
                const auto bounds = index.distance(p);
                ASSERT_EQ(nearest.has_value(), bounds.has_value());
                if (!nearest) continue;
                EXPECT_TRUE(index.locate(nearest->point).is_on_boundary());
                EXPECT_LE(bounds->lo, nearest->distance * (1 + 1e-9) + 1e-12);
                EXPECT_GE(bounds->hi, nearest->distance * (1 - 1e-9) - 1e-12);
            }
        }
    }
    EXPECT_GT(compared, 9000U);
}

}  // namespace
