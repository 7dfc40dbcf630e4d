// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/hierarchies/partitions/delaunay.h>

#include <gtest/gtest.h>

#include <gmpxx.h>

#include <vector>

#include "reference/random_solids.h"

namespace {

using reference::Random;
using trisect::hierarchies::DelaunayMesh;
using trisect::hierarchies::IntegerPoint;

mpz_class big(std::int64_t v) { return mpz_class(static_cast<long>(v)); }

int exact_orientation(const IntegerPoint& a, const IntegerPoint& b, const IntegerPoint& c,
                      const IntegerPoint& d) {
    const auto e = [&a](const IntegerPoint& p, std::size_t k) -> mpz_class {
        return big(p[k]) - big(a[k]);
    };
    const mpz_class det = e(b, 0) * (e(c, 1) * e(d, 2) - e(c, 2) * e(d, 1)) -
                          e(b, 1) * (e(c, 0) * e(d, 2) - e(c, 2) * e(d, 0)) +
                          e(b, 2) * (e(c, 0) * e(d, 1) - e(c, 1) * e(d, 0));
    return sgn(det);
}

/// By the centre: |p - centre|² against |a - centre|², times a determinant squared.
int exact_side_of_sphere(const std::array<IntegerPoint, 4>& t, const IntegerPoint& p) {
    std::array<std::array<mpq_class, 3>, 3> m;
    std::array<mpq_class, 3> r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            m[i][k] = 2 * (big(t[i + 1][k]) - big(t[0][k]));
            r[i] += big(t[i + 1][k]) * big(t[i + 1][k]) - big(t[0][k]) * big(t[0][k]);
        }
    const auto det = [](const std::array<std::array<mpq_class, 3>, 3>& x) {
        return mpq_class(x[0][0] * (x[1][1] * x[2][2] - x[1][2] * x[2][1]) -
                         x[0][1] * (x[1][0] * x[2][2] - x[1][2] * x[2][0]) +
                         x[0][2] * (x[1][0] * x[2][1] - x[1][1] * x[2][0]));
    };
    mpq_class to_p;
    mpq_class to_a;
    for (std::size_t k = 0; k < 3; ++k) {
        auto with = m;
        for (std::size_t i = 0; i < 3; ++i) with[i][k] = r[i];
        const mpq_class centre = det(with) / det(m);
        to_p += (big(p[k]) - centre) * (big(p[k]) - centre);
        to_a += (big(t[0][k]) - centre) * (big(t[0][k]) - centre);
    }
    return sgn(mpq_class(to_a - to_p));
}

IntegerPoint random_point(Random& random, std::int64_t size) {
    return {random.between(-size, size), random.between(-size, size), random.between(-size, size)};
}

TEST(SphereSigns, AgreeWithRationalsOnGridsOfAllSizes) {
    Random random(1);
    std::array<int, 3> spheres{};
    for (int i = 0; i < 4000; ++i) {
        const std::int64_t size = i % 2 == 0 ? 3 : (std::int64_t{1} << random.between(2, 52));
        std::array<IntegerPoint, 4> t;
        for (IntegerPoint& p : t) p = random_point(random, size);
        const int sign = exact_orientation(t[0], t[1], t[2], t[3]);
        ASSERT_EQ(trisect::hierarchies::orientation(t[0], t[1], t[2], t[3]), sign);
        if (sign == 0) continue;
        if (sign < 0) std::swap(t[0], t[1]);
        IntegerPoint p = random_point(random, size);
        // The point opposite a corner is on the sphere of three edges that are orthogonal.
        if (i % 5 == 0) {
            t = {IntegerPoint{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
            p = {size, size, i % 10 == 0 ? size : size - 1};
        }
        const int side = exact_side_of_sphere(t, p);
        ASSERT_EQ(trisect::hierarchies::side_of_sphere(t, p), side);
        ++spheres[static_cast<std::size_t>(side + 1)];
    }
    for (const int n : spheres) EXPECT_GT(n, 100);
}

TEST(DelaunayMesh, OfNoPointIsTheCubeItself) {
    const DelaunayMesh mesh{std::span<const IntegerPoint>{}};
    EXPECT_EQ(mesh.tetrahedra().size(), 6U);
    EXPECT_TRUE(mesh.is_valid(true));
}

TEST(DelaunayMesh, OfAGridOfPointsOnCommonSpheresAndPlanes) {
    std::vector<IntegerPoint> points;
    for (std::int64_t x = 0; x < 7; ++x)
        for (std::int64_t y = 0; y < 7; ++y)
            for (std::int64_t z = 0; z < 7; ++z) points.push_back({10 * x, 10 * y, 10 * z});
    points.insert(points.end(), points.begin(), points.begin() + 50);
    const DelaunayMesh mesh(points);
    EXPECT_EQ(mesh.point_count(), 8U + 343U);
    EXPECT_TRUE(mesh.is_valid(true));
}

TEST(DelaunayMesh, OfRandomPointsNearAndFar) {
    for (const std::int64_t size : {3L, 40L, 1L << 30, 1L << 52}) {
        Random random(static_cast<std::uint64_t>(size));
        std::vector<IntegerPoint> points;
        for (int i = 0; i < 300; ++i) points.push_back(random_point(random, size));
        const DelaunayMesh mesh(points);
        EXPECT_TRUE(mesh.is_valid(true)) << size;
    }
}

TEST(DelaunayMesh, EveryPointIsLocatedInATetrahedronThatContainsIt) {
    Random random(3);
    std::vector<IntegerPoint> points;
    for (int i = 0; i < 2000; ++i) points.push_back(random_point(random, 100));
    const DelaunayMesh mesh(points);
    ASSERT_TRUE(mesh.is_valid(false));
    std::uint64_t steps = 0;
    std::uint32_t at = 0;
    for (int i = 0; i < 500; ++i) {
        const IntegerPoint p = random_point(random, 110);
        at = mesh.locate(p, at, steps);
        const auto& t = mesh.tetrahedra()[at].corner;
        for (std::size_t k = 0; k < 4; ++k) {
            std::array<IntegerPoint, 4> c{mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2]),
                                          mesh.point(t[3])};
            c[k] = p;
            EXPECT_GE(exact_orientation(c[0], c[1], c[2], c[3]), 0);
        }
    }
    // From anywhere to anywhere: about the cube root of the number of tetrahedra.
    EXPECT_LT(steps, 500U * 60U);
}

// Two lines of points across each other have all pairs of edges in common.
TEST(DelaunayMesh, PointsThatWouldTakeTooManyTetrahedraAreLeftOut) {
    std::vector<IntegerPoint> points;
    for (std::int64_t i = 0; i < 400; ++i) {
        points.push_back({1000 * i, 0, 0});
        points.push_back({200000, 1000 * i - 200000, 300000});
    }
    const DelaunayMesh mesh(points);
    EXPECT_LT(mesh.point_count(), 8 + points.size());
    EXPECT_LE(mesh.tetrahedra().size(), (DelaunayMesh::most_per_point + 8) * mesh.point_count());
    EXPECT_TRUE(mesh.is_valid(false));
}

}  // namespace
