// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/brep/transform.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/minkowski.h>
#include <trisect/bsp/modelling/pieces/convex_cover.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "support/solids.h"

namespace trisect {
namespace {

using detail::convex_cover;
using detail::CoverSide;
using solids::box;

LatticeMesh mesh_of(const Solid& solid) { return import_mesh(solid.to_mesh()).mesh; }

Point3d point_of(const LatticeMesh& mesh, std::uint32_t v) {
    const auto [x, y, z] = mesh.points[v].doubles();
    return {mesh.lattice.to_double(x), mesh.lattice.to_double(y), mesh.lattice.to_double(z)};
}

std::vector<std::vector<Point3d>> bodies_of(const LatticeMesh& mesh, CoverSide side) {
    std::vector<std::vector<Point3d>> out;
    for (const auto& body : convex_cover(mesh, side).bodies) {
        auto& points = out.emplace_back();
        for (const std::uint32_t v : body) points.push_back(point_of(mesh, v));
    }
    return out;
}

/// Nothing of flat points.
Solid hull_of(const std::vector<Point3d>& points) {
    try {
        return Solid::from_mesh(make_hull(points));
    } catch (const UsageError&) {
        return {};
    }
}

std::vector<Point3d> sums(const std::vector<Point3d>& a, const std::vector<Point3d>& b,
                          double sign) {
    std::vector<Point3d> out;
    for (const Point3d& p : a)
        for (const Point3d& q : b)
            out.push_back({p[0] + sign * q[0], p[1] + sign * q[1], p[2] + sign * q[2]});
    return out;
}

Solid frame() { return evaluate(box({-5, -5, 0}, {5, 5, 2}) - box({-4, -4, -1}, {4, 4, 3})); }

TEST(ConvexCover, FramesAndBracketsAreFilledByFewBodies) {
    const auto of_frame = convex_cover(mesh_of(frame()), CoverSide::Inside);
    EXPECT_EQ(of_frame.bodies.size(), 4U);
    EXPECT_TRUE(of_frame.fills);
    const Solid bracket = evaluate(box({0, 0, 0}, {4, 1, 1}) | box({0, 0, 0}, {1, 1, 4}));
    const auto of_bracket = convex_cover(mesh_of(bracket), CoverSide::Inside);
    EXPECT_EQ(of_bracket.bodies.size(), 2U);
    EXPECT_TRUE(of_bracket.fills);
    const auto of_box = convex_cover(mesh_of(box({0, 0, 0}, {1, 2, 3})), CoverSide::Inside);
    EXPECT_EQ(of_box.bodies.size(), 1U);
    EXPECT_TRUE(of_box.fills);
}

TEST(ConvexCover, AroundABoxThereAreItsFaces) {
    const auto cover = convex_cover(mesh_of(box({0, 0, 0}, {1, 2, 3})), CoverSide::Outside);
    ASSERT_EQ(cover.bodies.size(), 6U);
    for (const auto& body : cover.bodies) EXPECT_EQ(body.size(), 4U);
    EXPECT_FALSE(cover.fills);
}

TEST(ConvexCover, BodiesOfAHollowAreInItsWalls) {
    const Solid hollow = evaluate(box({0, 0, 0}, {6, 6, 6}) - box({1, 1, 1}, {5, 5, 5}));
    const auto bodies = bodies_of(mesh_of(hollow), CoverSide::Inside);
    EXPECT_LT(bodies.size(), 24U);
    for (const auto& body : bodies) EXPECT_TRUE(evaluate(hull_of(body) - hollow).is_empty());
    // Outside, all that is in the cavity is one body.
    bool is_cavity_one_body = false;
    for (const auto& body : bodies_of(mesh_of(hollow), CoverSide::Outside)) {
        EXPECT_TRUE(evaluate(hull_of(body) & hollow).is_empty());
        is_cavity_one_body = is_cavity_one_body || exact_volume(hull_of(body)).to_string() == "64";
    }
    EXPECT_TRUE(is_cavity_one_body);
}

/// What is in none of the bodies is no body's: of a solid that no cut through corners fills.
TEST(ConvexCover, ATwistedPrismIsNotFilled) {
    // Schoenhardt's: an antiprism over triangles whose diagonals go inwards.
    PolygonMesh mesh;
    mesh.points = {{8, 0, 0}, {-4, 7, 0}, {-4, -7, 0}, {7, 4, 8}, {-7, 4, 8}, {0, -8, 8}};
    mesh.add_triangle(0, 2, 1);
    mesh.add_triangle(3, 4, 5);
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t j = (i + 1) % 3;
        mesh.add_triangle(i, j, 3 + j);
        mesh.add_triangle(i, 3 + j, 3 + i);
    }
    const LatticeMesh twisted = import_mesh(mesh).mesh;
    ASSERT_TRUE(is_embedded(twisted));
    const auto bodies = bodies_of(twisted, CoverSide::Inside);
    const Solid solid = Solid::from_mesh(mesh);
    Solid all;
    for (const auto& body : bodies) {
        EXPECT_TRUE(evaluate(hull_of(body) - solid).is_empty());
        all = evaluate(all | hull_of(body));
    }
    EXPECT_EQ(convex_cover(twisted, CoverSide::Inside).fills, evaluate(solid - all).is_empty());
}

class RandomSolids {
public:
    explicit RandomSolids(unsigned seed) : random_(seed) {}

    Solid of_boxes() { return evaluate((random_box() | random_box()) - random_box()); }

    /// The faces of a cube in eight triangles each, every corner moved away from the middle.
    Solid star() {
        PolygonMesh mesh;
        std::map<Point3d, std::uint32_t> numbers;
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const double side : {-1., 1.})
                for (const double u : {-1., 0.})
                    for (const double v : {-1., 0.}) {
                        const auto corner = [&](double du, double dv) {
                            Point3d p{};
                            p[axis] = side;
                            p[(axis + 1) % 3] = u + du;
                            p[(axis + 2) % 3] = v + dv;
                            return number(mesh, numbers, p);
                        };
                        const std::array c{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
                        const bool turned = side < 0;
                        mesh.add_triangle(c[0], c[turned ? 2 : 1], c[turned ? 1 : 2]);
                        mesh.add_triangle(c[0], c[turned ? 3 : 2], c[turned ? 2 : 3]);
                    }
        return Solid::from_mesh(mesh);
    }
    std::vector<Point3d> tool() {
        std::vector<Point3d> out;
        for (int i = 0; i < 5; ++i) out.push_back({at(0, 2), at(0, 2), at(0, 2)});
        return out;
    }

private:
    double at(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    Solid random_box() {
        const Point3d low{at(0, 4), at(0, 4), at(0, 4)};
        return box(low, {low[0] + at(1, 4), low[1] + at(1, 4), low[2] + at(1, 4)});
    }
    std::uint32_t number(PolygonMesh& mesh, std::map<Point3d, std::uint32_t>& numbers,
                         const Point3d& p) {
        const auto [found, is_new] =
            numbers.emplace(p, static_cast<std::uint32_t>(mesh.points.size()));
        if (is_new) {
            const double scale = at(1, 5);
            mesh.points.push_back({scale * p[0], scale * p[1], scale * p[2]});
        }
        return found->second;
    }
    std::mt19937 random_;
};

// Against sums of single triangles and the tool.
void compare(const Solid& a, const std::vector<Point3d>& tool) {
    const Solid b = hull_of(tool);
    if (a.is_empty() || b.is_empty()) return;
    const PolygonMesh mesh = a.to_mesh();
    std::vector<Solid> grown{transformed(a, AffineMap::translation(tool[0]))};
    std::vector<Solid> swept;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::vector<Point3d> triangle;
        for (const std::uint32_t v : mesh.face(f)) triangle.push_back(mesh.points[v]);
        grown.push_back(hull_of(sums(triangle, tool, 1)));
        swept.push_back(hull_of(sums(triangle, tool, -1)));
    }
    const Point3d back{-tool[0][0], -tool[0][1], -tool[0][2]};
    const Solid kept = transformed(a, AffineMap::translation(back));
    const Expression sum = minkowski_sum(a, b);
    const Expression difference = minkowski_difference(a, b);
    EXPECT_TRUE(evaluate(Expression::any_of(grown) ^ sum).is_empty());
    EXPECT_TRUE(evaluate((kept - Expression::any_of(swept)) ^ difference).is_empty());
}

TEST(ConvexCover, SumsAndDifferencesAreThoseOfTriangles) {
    RandomSolids random(11010);
    for (int i = 0; i < 8; ++i) compare(random.of_boxes(), random.tool());
    for (int i = 0; i < 2; ++i) compare(random.star(), random.tool());
}

TEST(ConvexCover, BodiesAreOnTheirSideOfStars) {
    RandomSolids random(11011);
    for (int i = 0; i < 20; ++i) {
        const Solid star = random.star();
        const LatticeMesh mesh = mesh_of(star);
        ASSERT_TRUE(is_embedded(mesh));
        for (const auto& body : bodies_of(mesh, CoverSide::Inside))
            EXPECT_TRUE(evaluate(hull_of(body) - star).is_empty());
        for (const auto& body : bodies_of(mesh, CoverSide::Outside))
            EXPECT_TRUE(evaluate(hull_of(body) & star).is_empty());
    }
}

}  // namespace
}  // namespace trisect
