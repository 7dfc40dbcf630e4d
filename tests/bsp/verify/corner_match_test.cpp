// SPDX-License-Identifier: Apache-2.0
//
// Meshes whose corners are matched with vertices, edges and faces of an exact boundary, compared
// with memberships counted in rationals near their corners.
#include <gtest/gtest.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/winding_number.h>
#include <trisect/bsp/verify.h>
#include <trisect/bsp/verify/corner_match.h>
#include <trisect/bsp/verify/difference_radius.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "boolean_membership.h"
#include "engines/engines.h"
#include "reference/random_solids.h"

namespace {

using namespace trisect;

/// Its lattice is that of whole numbers.
LatticeMesh lattice_mesh_of(const PolygonMesh& mesh) {
    LatticeMesh out;
    for (const Point3d& p : mesh.points)
        out.points.push_back({Coordinate(p[0]), Coordinate(p[1]), Coordinate(p[2])});
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto c = mesh.face(f);
        for (std::size_t i = 1; i + 1 < c.size(); ++i)
            out.triangles.push_back({c[0], c[i], c[i + 1]});
    }
    return out;
}

detail::CornerBound match(const Solid& exact, const PolygonMesh& result, double reach) {
    const Brep brep = exact.to_brep();
    return detail::matched_corners(brep, detail::boundary_triangles(brep), lattice_mesh_of(result),
                                   reach);
}

Solid box_of_three() {
    return Solid::from_lattice_mesh(lattice_mesh_of(make_box({0, 0, 0}, {3, 3, 3})));
}

TEST(CornerMatch, AllCornersMoved) {
    const auto bound = match(box_of_three(), make_box({0.25, 0, 0}, {3, 3.125, 2.75}), 0.5);
    EXPECT_TRUE(bound.boxes.empty());
    EXPECT_NEAR(bound.move, 0.25, 1e-9);
    EXPECT_GE(bound.move, 0.25);
}

TEST(CornerMatch, CornersWithinEdgesAndFaces) {
    // The roof has a corner in its middle, which is low, and one in the middle of an edge.
    PolygonMesh result = make_box({0, 0, 0}, {3, 3, 3});
    PolygonMesh divided;
    divided.points = result.points;
    const auto middle = static_cast<std::uint32_t>(divided.points.size());
    divided.points.push_back({1.5, 1.375, 2.875});
    divided.points.push_back({1.25, 0.0625, 3});
    const auto is_up = [&](std::uint32_t c) { return result.points[c][2] == 3; };
    const auto is_front = [&](std::uint32_t c) { return result.points[c][1] == 0; };
    for (std::size_t f = 0; f < result.face_count(); ++f) {
        std::vector<std::uint32_t> loop;
        const auto c = result.face(f);
        for (std::size_t i = 0; i < c.size(); ++i) {
            const std::uint32_t next = c[(i + 1) % c.size()];
            loop.push_back(c[i]);
            if (is_up(c[i]) && is_up(next) && is_front(c[i]) && is_front(next))
                loop.push_back(middle + 1);
        }
        const bool is_roof = std::all_of(
            loop.begin(), loop.end(), [&](std::uint32_t v) { return divided.points[v][2] == 3; });
        if (!is_roof) {
            // From the corner in the edge, where there is one: other triangles would be flat.
            const auto first = std::find(loop.begin(), loop.end(), middle + 1);
            if (first != loop.end()) std::rotate(loop.begin(), first, loop.end());
            for (std::size_t i = 1; i + 1 < loop.size(); ++i)
                divided.add_triangle(loop[0], loop[i], loop[i + 1]);
            continue;
        }
        for (std::size_t i = 0; i < loop.size(); ++i)
            divided.add_triangle(middle, loop[i], loop[(i + 1) % loop.size()]);
    }
    const auto bound = match(box_of_three(), divided, 0.25);
    EXPECT_TRUE(bound.boxes.empty());
    EXPECT_NEAR(bound.move, 0.125, 1e-9);
}

TEST(CornerMatch, AFeatureThatIsMissingIsInABox) {
    // A notch, and beside it a box that matches.
    const Solid notch = Solid::from_lattice_mesh(lattice_mesh_of(make_box({2, 2, 2}, {4, 4, 4})));
    const PolygonMesh beside = make_box({9, 0, 0}, {12, 3, 3});
    const Solid exact =
        evaluate((box_of_three() - notch) | Solid::from_lattice_mesh(lattice_mesh_of(beside)));
    PolygonMesh result = make_box({0, 0, 0}, {3, 3, 3});
    const auto first = static_cast<std::uint32_t>(result.points.size());
    result.points.insert(result.points.end(), beside.points.begin(), beside.points.end());
    for (std::size_t f = 0; f < beside.face_count(); ++f) {
        std::vector<std::uint32_t> loop(beside.face(f).begin(), beside.face(f).end());
        for (std::uint32_t& c : loop) c += first;
        result.add_face(loop);
    }
    const auto bound = match(exact, result, 0.25);
    ASSERT_EQ(bound.boxes.size(), 1U);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_LE(bound.boxes[0].low[k], detail::to_grid(LatticePoint{2, 2, 2})[k]);
        EXPECT_GE(bound.boxes[0].high[k], detail::to_grid(LatticePoint{3, 3, 3})[k]);
        EXPECT_LE(bound.boxes[0].high[k], detail::to_grid(LatticePoint{4, 4, 4})[k]);
    }
}

TEST(CornerMatch, ASheetTooMuchOrTurnedOverIsNoMatch) {
    const PolygonMesh box = make_box({0, 0, 0}, {3, 3, 3});
    PolygonMesh twice = box;
    PolygonMesh inside_out;
    inside_out.points = box.points;
    for (std::size_t f = 0; f < box.face_count(); ++f) {
        std::vector<std::uint32_t> loop(box.face(f).begin(), box.face(f).end());
        twice.add_face(loop);
        std::reverse(loop.begin(), loop.end());
        inside_out.add_face(loop);
    }
    EXPECT_FALSE(match(box_of_three(), twice, 0.25).boxes.empty());
    EXPECT_FALSE(match(box_of_three(), inside_out, 0.25).boxes.empty());
}

TEST(CornerMatch, FeaturesSmallerThanTheReachFallTogether) {
    // A step of half a unit, lost with a reach of one: all of it moves by half a unit.
    const PolygonMesh step = make_box({0, 0, 0}, {3, 3, 0.5});
    const Expression exact =
        box_of_three() | Solid::from_lattice_mesh(lattice_mesh_of(make_box({3, 0, 0}, {4, 3, 3})));
    const auto bound = match(evaluate(exact), make_box({0, 0, 0}, {3.5, 3, 3}), 0.75);
    EXPECT_TRUE(bound.boxes.empty());
    EXPECT_NEAR(bound.move, 0.5, 1e-9);
    EXPECT_FALSE(match(box_of_three(), step, 0.75).boxes.empty());
}

// Random solids on a small grid, results with some corners moved, some of them far.
class CornerMatchSamples : public testing::Test {
protected:
    /// Of the surface and the mesh alike, as far as one of them is from the point.
    static double distance(const detail::GridTriangles& surface, const ExactPoint& p) {
        return surface.nearest(detail::to_grid(p, Lattice{0})).lower;
    }
    static bool is_within(const detail::GridBox& box, const detail::GridPoint& p) {
        for (std::size_t k = 0; k < 3; ++k)
            if (p[k] < box.low[k] || p[k] > box.high[k]) return false;
        return true;
    }
    static detail::GridTriangles grid_triangles_of(const LatticeMesh& mesh) {
        std::vector<detail::GridTriangle> out;
        for (const auto& t : mesh.triangles)
            out.emplace_back(detail::to_grid(mesh.points[t[0]]), detail::to_grid(mesh.points[t[1]]),
                             detail::to_grid(mesh.points[t[2]]));
        return detail::GridTriangles(std::move(out));
    }
    /// Corners moved; the largest move.
    static double move_corners(PolygonMesh& mesh, reference::Random& random, double step) {
        double moved = 0;
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            if (!random.chance(1, 2)) continue;
            const double by = random.chance(1, 12) ? 1.5 : step;
            mesh.points[i][i % 3] += random.chance(1, 2) ? by : -by;
            moved = std::max(moved, by);
        }
        return moved;
    }
};

TEST_F(CornerMatchSamples, WhatDiffersIsWithinTheMoveOrInABox) {
    std::size_t matched = 0;
    std::size_t with_boxes = 0;
    std::size_t differences = 0;
    std::size_t outside_boxes = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        reference::Random random(seed);
        const LatticeMesh a = engines::lattice_mesh(reference::random_embedded_solid(random));
        const LatticeMesh b = engines::lattice_mesh(reference::random_embedded_solid(random));
        const auto operation = static_cast<BooleanOperation>(seed % 4);
        const std::vector<Solid> solids{Solid::from_lattice_mesh(a), Solid::from_lattice_mesh(b)};
        const Solid exact = evaluate(expression_of(operation, solids));
        PolygonMesh result = exact.to_mesh();
        if (result.points.empty()) continue;
        const double step = seed % 3 == 0 ? 0.25 : 0x1p-8;
        (void)move_corners(result, random, step);
        const Brep brep = exact.to_brep();
        const detail::BoundaryTriangles surface = detail::boundary_triangles(brep);
        const LatticeMesh r = lattice_mesh_of(result);
        const auto bound = detail::matched_corners(brep, surface, r, step * 1.01);
        EXPECT_LE(bound.move, step * 1.02) << seed;
        ++(bound.boxes.empty() ? matched : with_boxes);
        const detail::GridTriangles faces = grid_triangles_of(r);
        for (int i = 0; i < 600; ++i) {
            const std::size_t near = random.between(0, static_cast<int>(result.points.size()) - 1);
            ExactPoint p;
            for (std::size_t k = 0; k < 3; ++k)
                p[k] =
                    ExactRational::from_double(result.points[near][k]) +
                    ExactRational(random.between(-40, 40)) * ExactRational::from_double(step / 16) +
                    ExactRational(1) / ExactRational(100003);
            const auto in_a = winding_number(a, p);
            const auto in_b = winding_number(b, p);
            const auto in_r = winding_number(r, p);
            if (!in_a || !in_b || !in_r) continue;
            if (verify_test::is_member(operation, *in_a > 0, *in_b > 0) == (*in_r > 0)) continue;
            ++differences;
            const detail::GridPoint at = detail::to_grid(p, Lattice{0});
            if (std::any_of(bound.boxes.begin(), bound.boxes.end(),
                            [&](const detail::GridBox& box) { return is_within(box, at); }))
                continue;
            ++outside_boxes;
            EXPECT_LE(distance(surface.triangles, p), bound.move) << seed;
            EXPECT_LE(distance(faces, p), bound.move) << seed;
        }
    }
    EXPECT_GT(matched, 5U);
    EXPECT_GT(with_boxes, 5U);
    EXPECT_GT(differences, 500U);
    EXPECT_GT(outside_boxes, 200U);
}

TEST_F(CornerMatchSamples, BoundsOfThePieceSearchAgree) {
    std::size_t compared = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        reference::Random random(seed);
        const std::vector<Solid> solids{Solid::from_lattice_mesh(engines::lattice_mesh(
                                            reference::random_embedded_solid(random))),
                                        Solid::from_lattice_mesh(engines::lattice_mesh(
                                            reference::random_embedded_solid(random)))};
        const Solid exact =
            evaluate(expression_of(static_cast<BooleanOperation>(seed % 4), solids));
        PolygonMesh result = exact.to_mesh();
        if (result.points.empty()) continue;
        (void)move_corners(result, random, 0.125);
        const LatticeMesh r = lattice_mesh_of(result);
        const Solid difference =
            evaluate(Expression(exact) ^ Solid::from_lattice_mesh(r, Embedding::Resolve));
        if (difference.is_empty()) continue;
        const Brep brep = exact.to_brep();
        const detail::BoundaryTriangles surface = detail::boundary_triangles(brep);
        const detail::GridTriangles faces = grid_triangles_of(r);
        detail::RadiusOptions options;
        options.piece_limit = 300;
        const auto searched =
            detail::difference_radius(difference, surface.triangles, faces, options);
        options.match_corners = [&](double reach) {
            return detail::matched_corners(brep, surface, r, reach);
        };
        const auto matched =
            detail::difference_radius(difference, surface.triangles, faces, options);
        EXPECT_LE(searched.lower, matched.upper) << seed;
        EXPECT_LE(matched.lower, searched.upper) << seed;
        EXPECT_LE(matched.pieces, searched.pieces) << seed;
        ++compared;
    }
    EXPECT_GT(compared, 6U);
}

}  // namespace
