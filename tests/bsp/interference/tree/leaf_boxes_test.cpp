// SPDX-License-Identifier: Apache-2.0
//
// The triangles of all leaves together are the boundary: they have its area, and their normals
// close.

#include <trisect/bsp/interference/tree/leaf_boxes.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/number/vector3.h>

#include "support/solids.h"

namespace {

using trisect::evaluate;
using trisect::Expression;
using trisect::Point3d;
using trisect::Solid;
using trisect::detail::IndexBase;
using trisect::detail::IndexPolygons;
using trisect::detail::LeafBoxes;
using trisect::detail::LeafInTree;
using trisect::detail::TriangleCorners;
using trisect::detail::Vector3;

struct Sums {
    double area = 0;
    Vector3 normal{};  // outward, as long as the area
    std::size_t leaves = 0;
    std::size_t triangles = 0;
    std::size_t fragments = 0;
    std::size_t reaching_out = 0;
    std::size_t late = 0;  // of these
};

// Of triangle t, counter-clockwise seen from above the support of its source.
Vector3 twice_area(const TriangleCorners& c) {
    return trisect::detail::cross(trisect::detail::minus(c[1], c[0]),
                                  trisect::detail::minus(c[2], c[0]));
}

Sums sums_of(const Solid& solid) {
    Sums sums;
    const IndexBase base(solid);
    std::vector<TriangleCorners> parts;
    const auto take = [&](const LeafInTree& at) {
        if (at.node.size() == 0) return;
        const LeafBoxes& boxes = boxed_leaf(at.node, at.cell).boxes();
        const IndexPolygons& polygons = boxes.polygons();
        ++sums.leaves;
        for (std::uint32_t t = 0; t < boxes.triangle_count(); ++t) {
            const auto id = boxes.polygon_of(t);
            parts.clear();
            boxes.add_parts(t, parts);
            for (const TriangleCorners& part : parts) {
                const Vector3 n = twice_area(part);
                sums.area += 0.5 * std::sqrt(trisect::detail::dot(n, n));
                const double sign = polygons.is_flipped(id) != at.turned ? -0.5 : 0.5;
                for (std::size_t k = 0; k < 3; ++k) sums.normal[k] += sign * n[k];
            }
            ++sums.triangles;
            sums.fragments += polygons.is_triangle(id) ? 0 : 1;
            sums.reaching_out += polygons.reaches_out(id) ? 1 : 0;
            sums.late += boxes.is_clipped_late(t) ? 1 : 0;
        }
    };
    for_tree_leaves(
        base, [](const auto&) { return true; }, take);
    const double unit = std::ldexp(1.0, base.lattice().exponent);
    sums.area *= unit * unit;
    for (double& c : sums.normal) c *= unit * unit;
    return sums;
}

Solid cut_ball(int cuts) {
    Solid stock = solids::ball(1, 4, {0, 0, 0});
    stock.refine();
    for (int i = 0; i < cuts; ++i) {
        const double at = 0.7 * i;
        const Point3d center{std::cos(at), std::sin(at), 0.1 * i - 0.3};
        stock = evaluate(Expression(stock) - Expression(solids::ball(0.3, 2, center)));
    }
    return stock;
}

TEST(LeafBoxes, TrianglesOfAllLeavesAreTheBoundary) {
    const Solid solid = cut_ball(9);
    const Sums sums = sums_of(solid);
    const double area = trisect::area(solid).value;
    EXPECT_NEAR(sums.area, area, 1e-12 * area);
    for (const double c : sums.normal) EXPECT_NEAR(c, 0, 1e-12 * area);
    // Of every kind there are some.
    EXPECT_GT(sums.leaves, 20U);
    EXPECT_GT(sums.fragments, 100U);
    EXPECT_GT(sums.late, 100U);
    EXPECT_GT(sums.reaching_out, sums.late + 100U);
    EXPECT_GT(sums.triangles, sums.fragments + sums.reaching_out);
}

TEST(LeafBoxes, TrianglesOfAComplementAreTheSameBoundary) {
    const Solid solid = cut_ball(3);
    EXPECT_NEAR(sums_of(solid).area, sums_of(evaluate(~Expression(solid))).area, 1e-12);
}

}  // namespace
