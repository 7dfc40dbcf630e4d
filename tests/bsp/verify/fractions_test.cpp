// SPDX-License-Identifier: Apache-2.0
//
// Rounding and comparison of sets whose coordinates have bits behind the point.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/certified_rounding.h>
#include <trisect/bsp/verify.h>
#include <trisect/bsp/verify/difference_witness.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/fractions.h"

namespace {

using namespace trisect;
using trisect::test::with_fractions;

constexpr std::array<int, 4> shifts{8, 24, 56, 70};

void expect_the_same_rounding(const Brep& brep, Precision precision) {
    RoundingOptions options;
    options.precision = precision;
    const CertifiedRounding whole = certified_rounding(brep, options);
    for (const int bits : shifts) {
        const CertifiedRounding same = certified_rounding(with_fractions(brep, bits), options);
        EXPECT_EQ(same.outcome, whole.outcome);
        EXPECT_EQ(same.mesh.points, whole.mesh.points);
        EXPECT_EQ(same.mesh.corners, whole.mesh.corners);
        EXPECT_EQ(same.radius, whole.radius);
        EXPECT_EQ(same.unit, whole.unit);
        EXPECT_EQ(same.certificate.holds(), whole.certificate.holds());
        EXPECT_EQ(same.certificate.max_move, whole.certificate.max_move);
        EXPECT_EQ(same.certificate.rounded_vertices, whole.certificate.rounded_vertices);
    }
}

TEST(RoundingFractions, KeepRoundingsOfResults) {
    reference::Random random(29);
    int results = 0;
    for (int round = 0; round < 12; ++round) {
        const Solid a = engines::solid(reference::random_embedded_solid(random));
        const Solid b = engines::solid(reference::random_embedded_solid(random));
        const Brep brep = evaluate(Expression(a) - Expression(b)).to_brep();
        if (brep.is_empty()) continue;
        ++results;
        expect_the_same_rounding(brep, Precision::Double);
        expect_the_same_rounding(brep, Precision::Float);
    }
    EXPECT_GT(results, 5);
}

// Doubles of every size, of which no 53 bits hold all.
PolygonMesh uneven_ball(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uneven(0.9, 1);
    PolygonMesh sphere = make_icosphere(1, 1);
    for (Point3d& p : sphere.points)
        for (double& c : p) c *= uneven(random);
    return sphere;
}

TEST(VerifyFractions, DoublesAsTheyCome) {
    const PolygonMesh ball = uneven_ball(3);
    const std::vector<PolygonMesh> operands{ball, make_box({-2, -2, -2}, {2, 2, 2})};
    VerifyReport report = verify(BooleanOperation::Intersection, operands, ball);
    EXPECT_EQ(report.verdict, Verdict::Equal);
    PolygonMesh moved = ball;
    moved.points[5][1] += 0x1p-20;
    report = verify(BooleanOperation::Intersection, operands, moved);
    EXPECT_EQ(report.verdict, Verdict::Different);
    EXPECT_LE(report.lower, 0x1p-20);
    EXPECT_GE(report.upper, 0x1p-21);
    VerifyOptions options;
    options.within = 0x1p-19;
    report = verify(BooleanOperation::Intersection, operands, moved, options);
    EXPECT_EQ(report.verdict, Verdict::Within);
}

// A box over the unit square from `low` to 1.
LatticeMesh box_from(double low) {
    LatticeMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.points.push_back(
            {(i & 1) != 0 ? 1 : 0, (i & 2) != 0 ? 1 : 0, Coordinate((i & 4) != 0 ? 1.0 : low)});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

detail::GridTriangles grid_of(const LatticeMesh& mesh) {
    std::vector<detail::GridTriangle> out;
    for (const auto& t : mesh.triangles)
        out.emplace_back(detail::to_grid(mesh.points[t[0]]), detail::to_grid(mesh.points[t[1]]),
                         detail::to_grid(mesh.points[t[2]]));
    return detail::GridTriangles(std::move(out));
}

// The difference is thinner than the grid on which distances are certified.
TEST(VerifyFractions, AWitnessInASlabBelowTheGrid) {
    constexpr double thick = 0x1p-60;
    const LatticeMesh exact = box_from(thick);
    const LatticeMesh result = box_from(0);
    LatticeMesh slab = result;
    for (LatticePoint& p : slab.points)
        if (p.z == 1) p.z = Coordinate(thick);
    const std::array meshes{ImportedMesh{exact, ImportReport()},
                            ImportedMesh{result, ImportReport()}};
    const std::array solids{Solid::from_lattice_mesh(exact), Solid::from_lattice_mesh(result)};
    const std::array moved{0.0, 0.0};
    const detail::GridTriangles exact_grid = grid_of(exact);
    const detail::GridTriangles result_grid = grid_of(result);
    detail::DifferenceRadius radius;
    radius.piece = std::make_shared<Brep>(brep_from_lattice_mesh(slab));
    radius.vertex = VertexId(0);
    VerifyOptions options;
    for (const bool is_asked_for_0 : {false, true}) {
        if (is_asked_for_0) options.within = 0;
        const auto witness = detail::find_witness(
            {BooleanOperation::Union, options, {}, meshes, solids, exact_grid, result_grid, moved},
            radius);
        ASSERT_TRUE(witness);
        EXPECT_FALSE(witness->in_exact);
        EXPECT_TRUE(witness->in_result);
        EXPECT_GT(witness->point[2].sign(), 0);
        EXPECT_LT(witness->point[2], ExactRational::from_double(thick));
        EXPECT_TRUE(witness->holds_as_given);
    }
    options.within = 0x1p-50;
    EXPECT_FALSE(detail::find_witness(
        {BooleanOperation::Union, options, {}, meshes, solids, exact_grid, result_grid, moved},
        radius));
}

}  // namespace
