// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums of regions beside the union of the sums of all pairs of sides, and of either set
// moved to a corner of each outline of the other one.
#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/minkowski.h>
#include <trisect/bsp/modelling/plane_hull.h>
#include <trisect/bsp/solid_measure.h>

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace trisect {
namespace {

Point2d sum(const Point2d& p, const Point2d& q) { return {p[0] + q[0], p[1] + q[1]}; }

Solid prism(const std::vector<Outline>& outlines) {
    return flat_prism(outlines, OutlineRule::Odd, 0, 1);
}

Solid moved(const std::vector<Outline>& outlines, const Point2d& by) {
    std::vector<Outline> out = outlines;
    for (Outline& outline : out)
        for (Point2d& p : outline) p = sum(p, by);
    return prism(out);
}

Solid sum_of_pieces(const std::vector<Outline>& a, const std::vector<Outline>& b) {
    std::vector<Expression> terms;
    for (const Outline& p : a) terms.emplace_back(moved(b, p[0]));
    for (const Outline& q : b) terms.emplace_back(moved(a, q[0]));
    for (const Outline& p : a)
        for (std::size_t i = 0; i < p.size(); ++i)
            for (const Outline& q : b)
                for (std::size_t j = 0; j < q.size(); ++j) {
                    std::vector<Point2d> corners;
                    for (const Point2d& x : {p[i], p[(i + 1) % p.size()]})
                        for (const Point2d& y : {q[j], q[(j + 1) % q.size()]})
                            corners.push_back(sum(x, y));
                    const Outline hull = hull_of_points(corners);
                    if (hull.size() > 2) terms.emplace_back(prism({hull}));
                }
    return evaluate(Expression::any_of(terms));
}

std::vector<Outline> outlines_of(std::mt19937& random, int corners, int grid) {
    std::uniform_int_distribution<int> at(0, grid);
    for (;;) {
        std::vector<Outline> outlines(1 + random() % 2);
        for (Outline& outline : outlines)
            for (int i = 0; i < corners; ++i)
                outline.push_back(
                    {static_cast<double>(at(random)), static_cast<double>(at(random))});
        const auto flat = flat_outlines(evaluate(prism(outlines)));
        if (flat && flat->is_exact) return flat->outlines();
    }
}

TEST(FlatSums, RandomRegions) {
    std::mt19937 random(7);
    for (int i = 0; i < 300; ++i) {
        const auto a = outlines_of(random, 3 + i % 4, 4);
        const auto b = outlines_of(random, 3 + i % 3, 3);
        const Solid found = minkowski_sum_of_regions(prism(a), prism(b));
        const Solid wanted = sum_of_pieces(a, b);
        EXPECT_TRUE(evaluate(found ^ wanted).is_empty()) << i;
        EXPECT_EQ(exact_volume(found), exact_volume(wanted)) << i;
    }
}

TEST(FlatSums, HullsAreConvexAndHaveAllPoints) {
    EXPECT_EQ(hull_of_points({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 1}}).size(), 4);
    EXPECT_EQ(hull_of_points({{0, 0}, {1, 1}, {2, 2}}).size(), 2);
    EXPECT_EQ(hull_of_points({{0, 0}, {0.1, 0.1}, {0.3, 0.3}, {1, 0}}).size(), 3);
}

}  // namespace
}  // namespace trisect
