// SPDX-License-Identifier: Apache-2.0
//
// B-reps of results that are known by outlines only: the faces, with their names, that the tree of
// cells gives.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace {

using trisect::AssembleOptions;
using trisect::Brep;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Solid;

// A face by its name and the corners of its loops; loops begin anywhere.
using FaceKey = std::tuple<std::uint32_t, std::uint32_t, std::multiset<std::multiset<Point3d>>>;

// Where caps of several operands coincide, which of them names a face depends on the way that it
// was found (docs/booleans.md).
enum class Caps { Named, Unnamed };

std::multiset<FaceKey> faces_of(const Brep& brep, Caps caps) {
    std::multiset<FaceKey> faces;
    for (const auto face : brep.faces()) {
        std::multiset<std::multiset<Point3d>> loops;
        for (const auto loop : brep.loops(face)) {
            std::multiset<Point3d> corners;
            for (const auto h : brep.halfedges(loop))
                corners.insert(brep.point(brep.origin(h)).nearest());
            loops.insert(std::move(corners));
        }
        const auto& corners = *loops.begin();
        const bool is_cap = std::ranges::all_of(
            corners, [&](const Point3d& p) { return p[2] == (*corners.begin())[2]; });
        const trisect::FaceSource name =
            is_cap && caps == Caps::Unnamed ? trisect::FaceSource{} : brep.source(face);
        faces.emplace(name.operand, name.face, std::move(loops));
    }
    return faces;
}

void expect_what_the_tree_gives(const Solid& solid, Caps caps = Caps::Named) {
    ASSERT_NE(trisect::detail::state_of(solid)->lazy_tree(), nullptr);
    constexpr std::array kinds{AssembleOptions{true}, AssembleOptions{false}};
    // Before there is a tree.
    const std::array breps{solid.to_brep(kinds[0]), solid.to_brep(kinds[1])};
    const auto tree = trisect::detail::state_of(solid)->lazy_tree()->cut();
    for (std::size_t i = 0; i < 2; ++i) {
        const Brep& brep = breps[i];
        const Brep expected = trisect::detail::assemble_brep(*tree, kinds[i]);
        EXPECT_EQ(brep.vertices().size(), expected.vertices().size());
        EXPECT_EQ(brep.edges().size(), expected.edges().size());
        EXPECT_EQ(faces_of(brep, caps), faces_of(expected, caps));
        EXPECT_EQ(exact_volume(brep), exact_volume(expected));
    }
}

// Returns how many results are known by their outlines.
int expect_for_all_operations(const Solid& a, const Solid& b, const EvaluateOptions& options) {
    int outlined = 0;
    for (const Expression& e : {Expression(a) | b, Expression(a) & b, Expression(a) - b}) {
        const Solid solid = evaluate(e, options);
        if (trisect::detail::state_of(solid)->lazy_tree() == nullptr) continue;
        ++outlined;
        expect_what_the_tree_gives(solid);
    }
    return outlined;
}

// Over a polygon in the plane x, y; slanted against the axes by its corners alone.
void add_prism(PolygonMesh& mesh, const std::vector<std::array<double, 2>>& outline, double low,
               double high) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    const auto n = static_cast<std::uint32_t>(outline.size());
    for (const double z : {low, high})
        for (const auto& p : outline) mesh.points.push_back({p[0], p[1], z});
    std::vector<std::uint32_t> bottom;
    std::vector<std::uint32_t> top;
    for (std::uint32_t i = 0; i < n; ++i) {
        bottom.push_back(first + n - 1 - i);
        top.push_back(first + n + i);
        const std::uint32_t j = i + 1 == n ? 0 : i + 1;
        mesh.add_face(std::vector{first + i, first + j, first + n + j, first + n + i});
    }
    mesh.add_face(bottom);
    mesh.add_face(top);
}

std::vector<std::array<double, 2>> star(int corners, double inner, Point3d at, double outer) {
    std::vector<std::array<double, 2>> outline;
    for (int i = 0; i < corners; ++i) {
        const double angle = 0.1 + 6.283185307179586 * i / corners;
        const double r = i % 2 == 0 ? outer : inner;
        outline.push_back({std::round(1024 * (at[0] + r * std::cos(angle))) / 1024,
                           std::round(1024 * (at[1] + r * std::sin(angle))) / 1024});
    }
    return outline;
}

Solid prism(const std::vector<std::array<double, 2>>& outline, double low, double high) {
    PolygonMesh mesh;
    add_prism(mesh, outline, low, high);
    return Solid::from_mesh(mesh);
}

// However few they are.
EvaluateOptions outlined() {
    EvaluateOptions options;
    options.leaf_polygons = 0;
    return options;
}

TEST(BrepOfOutlines, TwoLargeMeshes) {
    const PolygonMesh ball = trisect::make_icosphere(1, 4);
    PolygonMesh moved = ball;
    for (auto& p : moved.points) p = {0.9 * p[0] + 0.31, p[1] + 0.2 * p[0], p[2] - 0.17};
    EXPECT_EQ(expect_for_all_operations(Solid::from_mesh(ball), Solid::from_mesh(moved), {}), 3);
}

TEST(BrepOfOutlines, PrismsOverStars) {
    const Solid a = prism(star(40, 2, {0, 0, 0}, 5), 0, 4);
    const Solid b = prism(star(24, 4, {0.5, 0.25, 0}, 4.5), 1, 6);
    EXPECT_EQ(expect_for_all_operations(a, b, outlined()), 3);
}

// Caps in one plane that are of several faces of one operand: their parts have different names.
TEST(BrepOfOutlines, SeveralCapsInOnePlane) {
    PolygonMesh mesh;
    add_prism(mesh, star(16, 2, {-6, 0, 0}, 5), 0, 4);
    add_prism(mesh, star(16, 2, {6, 0.5, 0}, 5), 0, 4);
    const Solid b = prism(star(24, 4, {0, 0.25, 0}, 6.5), 1, 6);
    EXPECT_EQ(expect_for_all_operations(Solid::from_mesh(mesh), b, outlined()), 3);
}

bool is_cut(const Solid& solid) { return trisect::detail::state_of(solid)->lazy_tree()->is_cut(); }

// A block of triangles: every one of them is a face of its own.
Solid block_of_triangles() {
    const PolygonMesh box = trisect::make_box({0, 0, 0}, {8, 8, 1});
    PolygonMesh mesh;
    mesh.points = box.points;
    for (std::size_t f = 0; f < box.face_count(); ++f) {
        const auto loop = box.face(f);
        for (std::size_t i = 2; i < loop.size(); ++i)
            mesh.add_triangle(loop[0], loop[i - 1], loop[i]);
    }
    return Solid::from_mesh(mesh);
}

// The sides of the plate are two faces each, and what is left of a side has the name of the first
// one: that is proved, and no tree is made for it.
TEST(BrepOfOutlines, BoresInAPlateOfTriangles) {
    PolygonMesh bores;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            add_prism(bores, star(12, 0.75, {2 * i + 1.0, 2 * j + 1.0, 0}, 0.5), -1, 2);
    const Solid plate = evaluate(block_of_triangles() - Solid::from_mesh(bores), outlined());
    ASSERT_NE(trisect::detail::state_of(plate)->lazy_tree(), nullptr);
    EXPECT_EQ(plate.to_brep().counts().faces, 6U + 16 * 12);
    EXPECT_FALSE(is_cut(plate));
    expect_what_the_tree_gives(plate);
}

// Of one triangle of either side little is left, or nothing, and then the other one gives the name.
// Names that are not proved are found by comparing the prisms.
TEST(BrepOfOutlines, TrianglesThatLittleIsLeftOf) {
    int cut = 0;
    for (const double reach : {0.0, 0.25, 0.4375, 0.5, 3.0})
        for (const bool turned : {false, true}) {
            std::vector<std::array<double, 2>> outline{
                {-1, -1 - reach}, {9 + reach, 9.5}, {8.5, 10}, {-2, 10.5}, {-2.5, -1.5 - reach}};
            if (turned) {
                for (auto& p : outline) p = {p[1], p[0]};
                std::reverse(outline.begin(), outline.end());
            }
            const Solid rest = evaluate(block_of_triangles() - prism(outline, -1, 2), outlined());
            ASSERT_NE(trisect::detail::state_of(rest)->lazy_tree(), nullptr);
            static_cast<void>(rest.to_brep());
            cut += is_cut(rest) ? 1 : 0;
            expect_what_the_tree_gives(rest);
        }
    EXPECT_EQ(cut, 0);
}

TEST(BrepOfOutlines, FlushCaps) {
    const Solid a = prism(star(20, 2, {0, 0, 0}, 5), 0, 4);
    int outlines = 0;
    for (const auto& [low, high] : {std::pair(0.0, 6.0), std::pair(4.0, 6.0), std::pair(-1.0, 4.0)})
        outlines += expect_for_all_operations(a, prism(star(12, 3, {1, 0.25, 0}, 4.5), low, high),
                                              outlined());
    EXPECT_GT(outlines, 0);
}

TEST(BrepOfOutlines, PocketsInOrderOrNot) {
    std::mt19937 random(3);
    const auto below = [&](unsigned n) { return static_cast<double>(random() % n); };
    for (int round = 0; round < 20; ++round) {
        std::vector<Solid> parts;
        for (int i = 0; i < 5; ++i) {
            const double low = below(4);
            parts.push_back(prism(star(6 + 2 * static_cast<int>(random() % 4), 1 + below(3),
                                       {below(9) + 0.25 * i, below(9) + 0.125 * i, 0}, 4),
                                  low, low + 1 + below(3)));
        }
        const Solid solid =
            evaluate((parts[0] | parts[1] | parts[2]) - parts[3] - parts[4], outlined());
        if (trisect::detail::state_of(solid)->lazy_tree() != nullptr)
            expect_what_the_tree_gives(solid, Caps::Unnamed);
    }
}

}  // namespace
