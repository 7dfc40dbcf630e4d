// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/curved/bspline_surface.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include <trisect/brep/curved/curved_boundary.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::BSplineSurface;
using trisect::Point3d;

// Cox and de Boor's recursion, by its definition.
double basis(const std::vector<double>& knots, std::size_t i, std::size_t degree, double t) {
    if (degree == 0) return knots[i] <= t && t < knots[i + 1] ? 1 : 0;
    const double left = knots[i + degree] - knots[i];
    const double right = knots[i + degree + 1] - knots[i + 1];
    double sum = 0;
    if (left > 0) sum += (t - knots[i]) / left * basis(knots, i, degree - 1, t);
    if (right > 0) sum += (knots[i + degree + 1] - t) / right * basis(knots, i + 1, degree - 1, t);
    return sum;
}

Point3d point(const BSplineSurface& s, double u, double v) {
    const std::size_t rows = s.knots_u.size() - s.degree_u - 1;
    const std::size_t columns = s.knots_v.size() - s.degree_v - 1;
    Point3d sum{};
    double total = 0;
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) {
            const double w = s.weights.empty() ? 1 : s.weights[i * columns + j];
            const double b =
                w * basis(s.knots_u, i, s.degree_u, u) * basis(s.knots_v, j, s.degree_v, v);
            total += b;
            for (std::size_t k = 0; k < 3; ++k) sum[k] += b * s.points[i * columns + j][k];
        }
    for (double& c : sum) c /= total;
    return sum;
}

BSplineSurface random_surface(std::mt19937_64& random) {
    BSplineSurface s;
    s.degree_u = 1 + random() % 3;
    s.degree_v = 1 + random() % 3;
    std::uniform_real_distribution<double> step(0, 1);
    const auto knots = [&](std::size_t degree, std::size_t count) {
        std::vector<double> t{0};
        while (t.size() < count + degree + 1)
            t.push_back(t.back() + (random() % 4 == 0 ? 0 : step(random)));
        // An end of full multiplicity now and then.
        if (random() % 2 == 0)
            for (std::size_t k = 0; k < degree; ++k) t[k] = t[degree];
        return t;
    };
    const std::size_t rows = s.degree_u + 1 + random() % 4;
    const std::size_t columns = s.degree_v + 1 + random() % 4;
    s.knots_u = knots(s.degree_u, rows);
    s.knots_v = knots(s.degree_v, columns);
    std::uniform_real_distribution<double> coordinate(-5, 5);
    for (std::size_t i = 0; i < rows * columns; ++i) {
        s.points.push_back({coordinate(random), coordinate(random), coordinate(random)});
        s.weights.push_back(0.5 + step(random));
    }
    return s;
}

TEST(BSplineSurface, PatchesAreTheSurface) {
    std::mt19937_64 random(5);
    int looked_at = 0;
    for (int k = 0; k < 60; ++k) {
        const BSplineSurface s = random_surface(random);
        trisect::BSplinePatches r;
        try {
            r = to_bezier(s);
        } catch (const trisect::UsageError&) {
            continue;  // no span is left
        }
        std::vector<double> u;
        std::vector<double> v;
        for (std::size_t i = s.degree_u; i + s.degree_u < s.knots_u.size(); ++i)
            if (u.empty() || s.knots_u[i] > u.back()) u.push_back(s.knots_u[i]);
        for (std::size_t i = s.degree_v; i + s.degree_v < s.knots_v.size(); ++i)
            if (v.empty() || s.knots_v[i] > v.back()) v.push_back(s.knots_v[i]);
        ASSERT_EQ(r.rows, u.size() - 1);
        ASSERT_EQ(r.columns, v.size() - 1);
        for (std::size_t i = 0; i < r.rows; ++i)
            for (std::size_t j = 0; j < r.columns; ++j) {
                const auto p = evaluate(r.patches[i * r.columns + j], 0.25, 0.625);
                const Point3d q =
                    point(s, u[i] + 0.25 * (u[i + 1] - u[i]), v[j] + 0.625 * (v[j + 1] - v[j]));
                for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(p.position[c], q[c], 1e-11);
                ++looked_at;
            }
    }
    EXPECT_GT(looked_at, 100);
}

TEST(BSplineSurface, NeighboursShareTheirSides) {
    std::mt19937_64 random(6);
    BSplineSurface s = random_surface(random);
    s.degree_u = s.degree_v = 3;
    s.knots_u = {0, 0.1, 0.3, 0.7, 1.1, 1.3, 1.9, 2.7, 3.1};
    s.knots_v = s.knots_u;
    s.points.clear();
    s.weights.clear();
    std::uniform_real_distribution<double> coordinate(-5, 5);
    for (int i = 0; i < 25; ++i) {
        s.points.push_back({coordinate(random), coordinate(random), coordinate(random)});
        s.weights.push_back(0.3 + 0.1 * i);
    }
    const auto r = to_bezier(s);
    ASSERT_EQ(r.patches.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(r.patches[0].point(k, 3), r.patches[1].point(k, 0));
        EXPECT_EQ(r.patches[0].weight(k, 3), r.patches[1].weight(k, 0));
        EXPECT_EQ(r.patches[0].point(3, k), r.patches[2].point(0, k));
    }
}

TEST(BSplineSurface, ClosedInBothDirectionsIsABoundary) {
    // Cubic in both directions, uniform knots, six control points around repeated three times.
    BSplineSurface s;
    const std::size_t n = 6;
    for (std::size_t k = 0; k < n + 7; ++k) s.knots_u.push_back(static_cast<double>(k));
    s.knots_v = s.knots_u;
    for (std::size_t i = 0; i < n + 3; ++i)
        for (std::size_t j = 0; j < n + 3; ++j) {
            const double a = 2 * M_PI * static_cast<double>(i % n) / n;
            const double b = 2 * M_PI * static_cast<double>(j % n) / n;
            s.points.push_back(
                {(4 + std::cos(b)) * std::cos(a), (4 + std::cos(b)) * std::sin(a), std::sin(b)});
        }
    const auto r = to_bezier(s);
    EXPECT_EQ(r.patches.size(), n * n);
    EXPECT_NO_THROW(trisect::CurvedBoundary{r.patches});
    auto open = r.patches;
    open.pop_back();
    EXPECT_THROW(trisect::CurvedBoundary{open}, trisect::UsageError);
    auto doubled = r.patches;
    doubled.push_back(r.patches[0]);
    EXPECT_THROW(trisect::CurvedBoundary{doubled}, trisect::UsageError);
}

TEST(BSplineSurface, RefusesWhatDoesNotFit) {
    BSplineSurface s;
    s.degree_u = s.degree_v = 1;
    s.knots_u = s.knots_v = {0, 0, 1, 1};
    s.points.assign(4, Point3d{});
    EXPECT_NO_THROW((void)to_bezier(s));
    s.knots_u = {0, 0, 1, 0.5};
    EXPECT_THROW((void)to_bezier(s), trisect::UsageError);
    s.knots_u = {0, 1, 1, 2};
    EXPECT_THROW((void)to_bezier(s), trisect::UsageError);
    s.knots_u = {0, 0, 1};
    EXPECT_THROW((void)to_bezier(s), trisect::UsageError);
    s.knots_u = {0, 0, 1, 1};
    s.points.pop_back();
    EXPECT_THROW((void)to_bezier(s), trisect::UsageError);
}

}  // namespace
