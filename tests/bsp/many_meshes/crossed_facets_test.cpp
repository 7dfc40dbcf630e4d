// SPDX-License-Identifier: Apache-2.0
//
// Pairs of facets that cross (crossed_facets.h), by what whole formulas compare.

#include <trisect/bsp/many_meshes/crossed_facets.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/diagnostics.h>

namespace {

using trisect::Diagnostics;
using trisect::EvaluateCounters;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Solid;

// Upright, of triangles that reach from cap to cap.
PolygonMesh prism(std::uint32_t sides, double radius, const Point3d& foot, double height) {
    PolygonMesh out;
    for (const double z : {foot[2], foot[2] + height})
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            const auto rounded = [](double v) { return std::round(v * 0x1p24) * 0x1p-24; };
            out.points.push_back({foot[0] + rounded(radius * std::cos(angle)),
                                  foot[1] + rounded(radius * std::sin(angle)), z});
        }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t j = (i + 1) % sides;
        if (i + 2 < sides) {
            out.add_triangle(0, i + 2, i + 1);
            out.add_triangle(sides, sides + i + 1, sides + i + 2);
        }
        out.add_triangle(i, j, sides + j);
        out.add_triangle(i, sides + j, sides + i);
    }
    return out;
}

EvaluateCounters counts_of(const Expression& formula) {
    EvaluateOptions options;
    options.threads = 1;
    const Diagnostics<EvaluateCounters> diagnostics;
    static_cast<void>(evaluate(formula, options));
    return diagnostics.counters();
}

// Counts in items began with the margin of their boxes: where that was a whole number a pair was
// found twice, and all went to the tree.
TEST(CrossedFacets, AreFoundOnceHoweverOftenTheyAreListed) {
    for (const double scale : {1.0, 0.25, 0x1p-6}) {
        std::vector<Expression> tools;
        for (std::size_t i = 0; i < 48; ++i)
            tools.emplace_back(Solid::from_mesh(
                prism(100, 0.5 * scale,
                      {0.0625 * scale * static_cast<double>(i), 0.03125 * scale, 0}, 0.5 * scale)));
        const Expression plate = Solid::from_mesh(
            trisect::make_box({-scale, -scale, -0.5 * scale}, {4 * scale, scale, 0.5 * scale}));
        const EvaluateCounters counts = counts_of(plate - Expression::any_of(tools));
        EXPECT_EQ(counts.exact_leaves, 0U) << scale;
        EXPECT_GT(counts.doubtful_pairs, 0U) << scale;
    }
}

// Cylinders about one centre, each turned: of a long facet both ends are left, and the boxes of
// whole parts would all meet.
TEST(CrossedFacets, OfLongFacetsAreFewOnceTheirMiddleIsGone) {
    const auto pairs_of = [](std::size_t count) {
        std::vector<Expression> all;
        for (std::size_t i = 0; i < count; ++i) {
            PolygonMesh mesh = prism(60, 0.5, {0, 0, -2}, 4);
            const auto x = static_cast<double>(i);
            const double a = 0.7 * x;
            const double b = 0.4 * x + 0.1;
            for (Point3d& p : mesh.points) {
                const Point3d q{p[0], std::cos(a) * p[1] - std::sin(a) * p[2],
                                std::sin(a) * p[1] + std::cos(a) * p[2]};
                p = {std::cos(b) * q[0] - std::sin(b) * q[1],
                     std::sin(b) * q[0] + std::cos(b) * q[1], q[2]};
            }
            all.emplace_back(Solid::from_mesh(mesh));
        }
        return counts_of(Expression::any_of(all)).pairs_cutting;
    };
    const auto of_eight = static_cast<double>(pairs_of(8));
    const auto of_many = static_cast<double>(pairs_of(32));
    EXPECT_GT(of_eight, 0);
    // Four times as many; with the boxes of whole parts 17 times as many pairs.
    EXPECT_LT(of_many, 11 * of_eight) << of_eight << ' ' << of_many;
}

}  // namespace
