// SPDX-License-Identifier: Apache-2.0
//
// Hulls and sweeps of small polyhedra on a grid of a few units, where faces and edges are parallel
// to the way all the time, against the hull of both ends.
#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/convex_sweep.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

namespace trisect {
namespace {

using Vector = std::array<double, 3>;

// Of few points with small coordinates: many are coplanar and collinear.
std::vector<LatticePoint> random_points(std::mt19937& random, int count, int side) {
    std::vector<LatticePoint> out;
    for (int i = 0; i < count; ++i) {
        const auto c = [&] {
            return static_cast<std::int64_t>(random() % static_cast<unsigned>(side));
        };
        out.push_back({c(), c(), c()});
    }
    return out;
}

bool is_closed(const LatticeMesh& mesh) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const auto& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) edges.push_back({t[i], t[(i + 1) % 3]});
    std::sort(edges.begin(), edges.end());
    if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
    return std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
        return std::binary_search(edges.begin(), edges.end(), std::array{e[1], e[0]});
    });
}

// It holds all points and its corners are among them: it is their hull.
void expect_convex_solid(const LatticeMesh& mesh, std::span<const LatticePoint> points) {
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_TRUE(is_convex(mesh));
    EXPECT_TRUE(is_embedded(mesh));
    EXPECT_GT(volume(mesh), 0);
    for (const auto& t : mesh.triangles) {
        EXPECT_FALSE(are_collinear(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
        const Plane plane = Plane::through(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
        for (const LatticePoint& p : points) EXPECT_NE(side_of(p, plane), Side::Above);
    }
    for (const LatticePoint& p : mesh.points)
        EXPECT_NE(std::find(points.begin(), points.end(), p), points.end());
}

LatticeMesh cube() { return import_mesh(make_box({0, 0, 0}, {2, 2, 2})).mesh; }

TEST(ConvexSweep, HullOfPointsOfAGridIsClosedConvexAndHoldsThem) {
    std::mt19937 random(7);
    for (int i = 0; i < 200; ++i) {
        const auto points = random_points(random, 4 + i % 40, 3 + i % 4);
        try {
            expect_convex_solid(hull_mesh(points, {}), points);
        } catch (const UsageError&) {
            EXPECT_LT(i % 40, 6);  // all in one plane
        }
    }
}

TEST(ConvexSweep, HullOfOnePlaneIsRefused) {
    const std::vector<LatticePoint> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 0}};
    EXPECT_THROW(static_cast<void>(hull_mesh(flat, {})), UsageError);
    EXPECT_THROW(static_cast<void>(hull_mesh({}, {})), UsageError);
}

TEST(ConvexSweep, FacesOfAHullAreMaximal) {
    const LatticeMesh hull = hull_mesh(cube().points, {});
    EXPECT_EQ(hull.triangles.size(), 12U);
    EXPECT_EQ(*std::max_element(hull.face_of_triangle.begin(), hull.face_of_triangle.end()), 5U);
}

TEST(ConvexSweep, EqualsTheHullOfBothEnds) {
    std::mt19937 random(11);
    for (int i = 0; i < 400; ++i) {
        const auto points = random_points(random, 8 + i % 30, 4);
        const LatticeMesh body = hull_mesh(points, {});
        const auto step = [&] { return static_cast<double>(random() % 7) - 3; };
        const Vector by{step(), i % 3 == 0 ? 0.0 : step(), i % 5 == 0 ? 0.0 : step()};
        const LatticeMesh sweep = swept(body, by);
        std::vector<LatticePoint> both = body.points;
        for (const LatticePoint& p : moved(body, by).points) both.push_back(p);
        expect_convex_solid(sweep, both);
        EXPECT_EQ(exact_volume(sweep), exact_volume(hull_mesh(both, {})));
    }
}

TEST(ConvexSweep, BoxAlongItsSidesIsALongerBox) {
    const LatticeMesh sweep = swept(cube(), {5, 0, 0});
    EXPECT_EQ(volume(sweep), 7 * 2 * 2);
    EXPECT_EQ(area(sweep).exact, ExactRational::from_double(2 * 2 * 2 + 4 * 7 * 2));
    EXPECT_EQ(volume(swept(cube(), {0, 0, -3})), 2 * 2 * 5);
    EXPECT_EQ(volume(swept(cube(), {3, 4, 0})), 8 + 2 * (3 * 2 + 4 * 2));
}

TEST(ConvexSweep, OppositeWaysAreCopiesOfEachOther) {
    const LatticeMesh ball = import_mesh(make_icosphere(1, 2)).mesh;
    const Vector by{0x1p20, 0x1p21, -0x1p19};
    const LatticeMesh there = swept(ball, by);
    const LatticeMesh back = swept(moved(ball, by), {-by[0], -by[1], -by[2]});
    EXPECT_EQ(exact_volume(there), exact_volume(back));
    EXPECT_EQ(area(there).value, area(back).value);
}

TEST(ConvexSweep, NoWayIsTheBodyItself) {
    EXPECT_EQ(swept(cube(), {}).triangles, cube().triangles);
}

TEST(ConvexSweep, FacesKeepTheirNumbers) {
    const LatticeMesh body = cube();
    const LatticeMesh sweep = swept(body, {1, 2, 3});
    for (std::uint32_t t = 0; t < body.triangles.size(); ++t)
        EXPECT_EQ(sweep.face_of(t), body.face_of(t));
    const auto most =
        *std::max_element(sweep.face_of_triangle.begin(), sweep.face_of_triangle.end());
    EXPECT_EQ(most, 5U + 6U);  // six edges of a cube are its outline
}

TEST(ConvexSweep, LeadingPartMeetsAllThatIsBeyondTheBody) {
    std::mt19937 random(13);
    for (int i = 0; i < 200; ++i) {
        const LatticeMesh body = hull_mesh(random_points(random, 8 + i % 30, 4), {});
        const auto step = [&] { return static_cast<double>(random() % 7) - 3; };
        const Vector by{step(), i % 3 == 0 ? 0.0 : step(), i % 5 == 0 ? 1.0 : 1 + step()};
        if (by == Vector{}) continue;
        const LatticeMesh leading = leading_part(body, by);
        EXPECT_TRUE(is_convex(leading));
        // Body and swept part together are the swept body.
        const Solid whole = Solid::from_lattice_mesh(swept(body, by));
        const Solid beyond = Solid::from_lattice_mesh(swept(leading, by));
        EXPECT_TRUE(evaluate(whole ^ (Solid::from_lattice_mesh(body) | beyond)).is_empty());
    }
}

TEST(ConvexSweep, CoordinatesThatDoNotFitAreRefused) {
    EXPECT_THROW(static_cast<void>(swept(cube(), {0x1p53, 0, 0})), LimitError);
    EXPECT_THROW(static_cast<void>(moved(cube(), {0x1p-70, 0, 0})), LimitError);
}

}  // namespace
}  // namespace trisect
