// SPDX-License-Identifier: Apache-2.0
//
// Results that are right, nearly right and wrong in ways that volumes and surface distances miss.
// The property tests compare with memberships counted in rationals on small grids.
#include <gtest/gtest.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/verify.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "boolean_membership.h"
#include "engines/engines.h"
#include "reference/random_solids.h"

namespace {

using namespace trisect;

constexpr double small = 0x1p-30;

PolygonMesh joined(PolygonMesh a, const PolygonMesh& b) {
    const auto first = static_cast<std::uint32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        std::vector<std::uint32_t> loop(b.face(f).begin(), b.face(f).end());
        for (auto& c : loop) c += first;
        a.add_face(loop);
    }
    return a;
}

PolygonMesh turned_over(const PolygonMesh& mesh) {
    PolygonMesh out;
    out.points = mesh.points;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::vector<std::uint32_t> loop(mesh.face(f).begin(), mesh.face(f).end());
        std::reverse(loop.begin(), loop.end());
        out.add_face(loop);
    }
    return out;
}

/// The boxes (0..4)^3 and (2..6)^3; their intersection is (2..4)^3.
class VerifyBoxes : public testing::Test {
protected:
    [[nodiscard]] VerifyReport intersection(const PolygonMesh& result,
                                            std::optional<double> within = {}) const {
        VerifyOptions options;
        options.within = within;
        return verify(BooleanOperation::Intersection, operands_, result, options);
    }
    std::vector<PolygonMesh> operands_{make_box({0, 0, 0}, {4, 4, 4}),
                                       make_box({2, 2, 2}, {6, 6, 6})};
    PolygonMesh common_ = make_box({2, 2, 2}, {4, 4, 4});
};

TEST_F(VerifyBoxes, TheCommonBox) {
    const VerifyReport report = intersection(common_);
    EXPECT_EQ(report.verdict, Verdict::Equal);
    EXPECT_EQ(report.upper, 0);
    EXPECT_FALSE(report.witness);
}

TEST_F(VerifyBoxes, OtherTrianglesOfTheSameSet) {
    const PolygonMesh halves =
        joined(make_box({2, 2, 2}, {3, 4, 4}), make_box({3, 2, 2}, {4, 4, 4}));
    EXPECT_EQ(intersection(halves).verdict, Verdict::Equal);
    EXPECT_EQ(intersection(joined(common_, common_)).verdict, Verdict::Equal);
    const PolygonMesh inner = joined(common_, make_box({2, 2, 3}, {3, 3, 4}));
    EXPECT_EQ(intersection(inner).verdict, Verdict::Equal);
}

TEST_F(VerifyBoxes, EachCornerMovedALittle) {
    PolygonMesh moved = common_;
    for (std::size_t i = 0; i < moved.points.size(); ++i)
        moved.points[i][i % 3] += (i % 2 == 0 ? small : -small);
    const VerifyReport report = intersection(moved);
    EXPECT_EQ(report.verdict, Verdict::Different);
    EXPECT_GT(report.lower, 0.99 * small);
    EXPECT_LT(report.upper, 1.6 * small);
    EXPECT_EQ(intersection(moved, 1.2 * small).verdict, Verdict::Within);
    const VerifyReport refuted = intersection(moved, 0.5 * small);
    EXPECT_EQ(refuted.verdict, Verdict::Different);
    ASSERT_TRUE(refuted.witness);
    EXPECT_GT(std::max(refuted.witness->distance_to_exact, refuted.witness->distance_to_result),
              0.5 * small);
}

TEST_F(VerifyBoxes, ThinSheetsOverTheWholeSurface) {
    // The difference is one piece that turns around every edge and corner of the box.
    const PolygonMesh larger =
        make_box({2 - small, 2 - small, 2 - small}, {4 + small, 4 + small, 4 + small});
    const VerifyReport report = intersection(larger);
    EXPECT_EQ(report.verdict, Verdict::Different);
    EXPECT_GT(report.lower, 0.99 * small);
    EXPECT_LT(report.upper, 1.6 * small);
    EXPECT_EQ(report.components, 1U);
    EXPECT_EQ(intersection(larger, small * 1.0001).verdict, Verdict::Within);
}

TEST_F(VerifyBoxes, ALidTooLow) {
    const VerifyReport report = intersection(make_box({2, 2, 2}, {4, 4, 3}), 0.25);
    ASSERT_EQ(report.verdict, Verdict::Different);
    ASSERT_TRUE(report.witness);
    const Witness& w = *report.witness;
    EXPECT_TRUE(w.in_exact);
    EXPECT_FALSE(w.in_result);
    EXPECT_EQ(w.winding, (std::vector<int>{1, 1, 0}));
    EXPECT_TRUE(w.holds_as_given);
    EXPECT_FALSE(w.faces.empty());
    // The low lid of the result and the lid of the first operand are to blame.
    const auto is_blamed = [&](std::uint32_t mesh) {
        return std::any_of(w.faces.begin(), w.faces.end(),
                           [&](const BlamedFace& f) { return f.mesh == mesh; });
    };
    EXPECT_TRUE(is_blamed(0));
    EXPECT_TRUE(is_blamed(2));
}

TEST_F(VerifyBoxes, MissingInsideUnderADoubleSkin) {
    // Every point of either surface is near the other one; the inside is not there.
    const double s = small;
    const PolygonMesh skin =
        joined(common_, turned_over(make_box({2 + s, 2 + s, 2 + s}, {4 - s, 4 - s, 4 - s})));
    const VerifyReport report = intersection(skin, 0.5);
    ASSERT_EQ(report.verdict, Verdict::Different);
    ASSERT_TRUE(report.witness);
    EXPECT_GT(report.witness->distance_to_exact, 0.5);
    EXPECT_TRUE(report.witness->in_exact);
}

TEST_F(VerifyBoxes, AFinAsThinAsRounding) {
    // Each of its points is near the result's own surface, and far from the exact one.
    const PolygonMesh fin = joined(common_, make_box({3, 3, 4}, {3 + small, 4, 100}));
    const VerifyReport report = intersection(fin, 1);
    ASSERT_EQ(report.verdict, Verdict::Different);
    ASSERT_TRUE(report.witness);
    EXPECT_GT(report.witness->distance_to_exact, 1);
    EXPECT_LT(report.witness->distance_to_result, small);
    EXPECT_TRUE(report.witness->in_result);
    EXPECT_NEAR(intersection(fin).lower, 96, 1e-6);
}

TEST_F(VerifyBoxes, ACavityThatShouldNotBe) {
    const PolygonMesh hollow = joined(common_, turned_over(make_box({3, 3, 3}, {3.5, 3.5, 3.5})));
    const VerifyReport report = intersection(hollow, 0.5);
    ASSERT_EQ(report.verdict, Verdict::Different);
    ASSERT_TRUE(report.witness);
    EXPECT_TRUE(report.witness->in_exact);
}

TEST_F(VerifyBoxes, AFarAwayBitThatShouldNotBe) {
    const PolygonMesh more = joined(common_, make_box({50, 50, 50}, {50.5, 50.5, 50.5}));
    const VerifyReport report = intersection(more);
    ASSERT_EQ(report.verdict, Verdict::Different);
    EXPECT_GT(report.witness->distance_to_exact, 30);
    EXPECT_EQ(report.witness->winding, (std::vector<int>{0, 0, 1}));
}

TEST_F(VerifyBoxes, InsideOut) {
    const VerifyReport report = intersection(turned_over(common_));
    EXPECT_TRUE(report.result_inside_out);
    ASSERT_EQ(report.verdict, Verdict::Different);
    EXPECT_EQ(report.witness->winding.back(), -1);
}

TEST_F(VerifyBoxes, WithoutALid) {
    PolygonMesh open;
    open.points = common_.points;
    for (std::size_t f = 0; f + 1 < common_.face_count(); ++f) open.add_face(common_.face(f));
    const VerifyReport report = intersection(open);
    EXPECT_EQ(report.verdict, Verdict::NotClosed);
    EXPECT_EQ(report.result_defects.count(DefectKind::OpenEdge), 4U);
    EXPECT_TRUE(std::isnan(report.upper));
}

TEST_F(VerifyBoxes, NothingWhereThereIsSomething) {
    const VerifyReport report = intersection(PolygonMesh{});
    ASSERT_EQ(report.verdict, Verdict::Different);
    EXPECT_TRUE(std::isinf(report.lower));
    ASSERT_TRUE(report.witness);
    EXPECT_TRUE(std::isinf(report.witness->distance_to_result));
}

TEST_F(VerifyBoxes, SomethingWhereThereIsNothing) {
    operands_[1] = make_box({20, 20, 20}, {21, 21, 21});
    EXPECT_EQ(intersection(PolygonMesh{}).verdict, Verdict::Equal);
    const VerifyReport report = intersection(common_);
    ASSERT_EQ(report.verdict, Verdict::Different);
    EXPECT_TRUE(report.witness->in_result);
}

TEST_F(VerifyBoxes, BoxesThatOnlyTouchHaveNoCommonPart) {
    operands_[1] = make_box({4, 0, 0}, {8, 4, 4});
    EXPECT_EQ(intersection(PolygonMesh{}).verdict, Verdict::Equal);
    EXPECT_EQ(verify(BooleanOperation::Union, operands_, make_box({0, 0, 0}, {8, 4, 4})).verdict,
              Verdict::Equal);
}

TEST_F(VerifyBoxes, AnOpenOperandIsRefused) {
    PolygonMesh open;
    open.points = common_.points;
    open.add_face(common_.face(0));
    operands_[1] = open;
    EXPECT_THROW(static_cast<void>(intersection(common_)), InvalidSolid);
    EXPECT_THROW(static_cast<void>(intersection(common_, -1.0)), UsageError);
}

TEST_F(VerifyBoxes, NothingButOnePieceAllowed) {
    // A second skin: corners match, but nothing is covered once.
    VerifyOptions options;
    options.piece_limit = 1;
    options.within = 1.01 * small;
    const PolygonMesh larger =
        make_box({2 - small, 2 - small, 2 - small}, {4 + small, 4 + small, 4 + small});
    const VerifyReport report =
        verify(BooleanOperation::Intersection, operands_, joined(larger, larger), options);
    EXPECT_EQ(report.verdict, Verdict::Undecided);
    EXPECT_GE(report.upper, small);
}

TEST(Verify, CoordinatesThatFitNoCommonLattice) {
    // 1e-60 and 1 are 200 bits apart: the result is placed, and says how far it moved.
    const std::vector<PolygonMesh> operands{make_box({0, 0, 0}, {1, 1, 1}),
                                            make_box({0.5, 0, 0}, {2, 1, 1})};
    const PolygonMesh result = make_box({0.5, 1e-60, 0}, {1, 1, 1});
    const VerifyReport report = verify(BooleanOperation::Intersection, operands, result);
    EXPECT_EQ(report.verdict, Verdict::Equal);
    EXPECT_EQ(report.moved[0], 0);
    EXPECT_EQ(report.moved[2], 1e-60);
}

// Nearly all results of users: no piece is to be looked at.
TEST(Verify, ARoundedResultIsBoundedByItsCorners) {
    const PolygonMesh ball = make_uv_sphere(1, 24, 12);
    PolygonMesh other = ball;
    for (Point3d& p : other.points) p = {p[0] + 0.3, p[1] + 0.2, p[2] - 0.4};
    const std::vector<PolygonMesh> operands{ball, other};
    const std::vector<Solid> solids{Solid::from_mesh(ball), Solid::from_mesh(other)};
    for (const auto operation :
         {BooleanOperation::Union, BooleanOperation::Intersection, BooleanOperation::Difference}) {
        const PolygonMesh result = evaluate(expression_of(operation, solids)).to_mesh();
        VerifyOptions options;
        options.within = 1e-14;
        const VerifyReport report = verify(operation, operands, result, options);
        EXPECT_EQ(report.verdict, Verdict::Within);
        EXPECT_EQ(report.pieces, 0U);
        EXPECT_GT(report.upper, 0);
        EXPECT_LT(report.upper, 2e-16);
    }
}

TEST(Verify, SomeCornersOfARoundedResultMoved) {
    // A large reach would match all but one box around everything.
    const PolygonMesh ball = make_uv_sphere(1, 48, 24);
    PolygonMesh other = ball;
    for (Point3d& p : other.points) p = {p[0] + 0.3, p[1] + 0.2, p[2] - 0.4};
    const std::vector<PolygonMesh> operands{ball, other};
    const std::vector<Solid> solids{Solid::from_mesh(ball), Solid::from_mesh(other)};
    PolygonMesh result = evaluate(expression_of(BooleanOperation::Difference, solids)).to_mesh();
    for (std::size_t i = 0; i < result.points.size(); i += 40) result.points[i][i % 3] += 1e-4;
    VerifyOptions options;
    options.within = 2e-4;
    const VerifyReport report = verify(BooleanOperation::Difference, operands, result, options);
    EXPECT_EQ(report.verdict, Verdict::Within);
    EXPECT_LT(report.pieces, 1000U);
}

// Random solids on a small grid, results with a few corners moved: bounds against samples.
class VerifySamples : public testing::Test {
protected:
    static PolygonMesh mesh_of(const reference::Operand& operand) {
        const LatticeMesh mesh = engines::lattice_mesh(operand);
        PolygonMesh out;
        for (const LatticePoint& p : mesh.points) out.points.push_back(p.doubles());
        for (const auto& t : mesh.triangles) out.add_triangle(t[0], t[1], t[2]);
        return out;
    }
};

TEST_F(VerifySamples, MovedCornersOnASmallGrid) {
    int different = 0;
    for (std::uint64_t seed = 9; seed <= 22; ++seed) {
        reference::Random random(seed);
        const std::vector<PolygonMesh> operands{mesh_of(reference::random_embedded_solid(random)),
                                                mesh_of(reference::random_embedded_solid(random))};
        const auto operation = static_cast<BooleanOperation>(seed % 4);
        const std::vector<Solid> solids{Solid::from_mesh(operands[0]),
                                        Solid::from_mesh(operands[1])};
        PolygonMesh result = evaluate(expression_of(operation, solids)).to_mesh();
        if (result.points.empty()) continue;
        const double step = seed % 3 == 0 ? 1.0 : 0.125;
        double moved = 0x1p-44;
        for (std::size_t i = 0; i < result.points.size(); ++i) {
            if (!random.chance(1, 6)) continue;
            result.points[i][i % 3] += random.chance(1, 2) ? step : -step;
            moved = step + 0x1p-44;
        }
        const VerifyReport report = verify(operation, operands, result);
        ASSERT_NE(report.verdict, Verdict::Undecided);
        // Corners moved by that much sweep over no point that is farther from the surface.
        EXPECT_LE(report.lower, moved) << seed;
        EXPECT_LE(report.lower, report.upper);
        if (report.verdict == Verdict::Equal) continue;
        ++different;
        ASSERT_EQ(report.verdict, Verdict::Different) << seed;
        // Bounds this near to each other need all cuts.
        if (report.failed_cuts == 0 && report.pieces < VerifyOptions{}.piece_limit) {
            EXPECT_LE(report.upper, 1.6 * report.lower + 0x1p-30) << seed;
        }
        EXPECT_NE(report.witness->in_exact, report.witness->in_result);
        VerifyOptions within;
        within.within = report.upper;
        EXPECT_EQ(verify(operation, operands, result, within).verdict, Verdict::Within) << seed;
    }
    EXPECT_GE(different, 8);
}

TEST_F(VerifySamples, PointsOutsideTheRadiusAgree) {
    for (std::uint64_t seed = 100; seed < 108; ++seed) {
        reference::Random random(seed);
        const std::vector<PolygonMesh> operands{mesh_of(reference::random_embedded_solid(random)),
                                                mesh_of(reference::random_embedded_solid(random))};
        const auto operation = static_cast<BooleanOperation>(seed % 4);
        const std::vector<Solid> solids{Solid::from_mesh(operands[0]),
                                        Solid::from_mesh(operands[1])};
        const Solid exact = evaluate(expression_of(operation, solids));
        // What a kernel that confuses two operations would say.
        const auto other = static_cast<BooleanOperation>((seed + 1) % 4);
        const PolygonMesh result = evaluate(expression_of(other, solids)).to_mesh();
        const VerifyReport report = verify(operation, operands, result);
        const LatticeMesh a = import_mesh(operands[0]).mesh;
        const LatticeMesh b = import_mesh(operands[1]).mesh;
        const LatticeMesh r = import_mesh(result).mesh;
        bool differs = false;
        for (int i = 0; i < 400; ++i) {
            ExactPoint p;
            for (auto& c : p) c = ExactRational(random.between(-3, 65)) / ExactRational(3);
            const auto in_a = winding_number(a, p);
            const auto in_b = winding_number(b, p);
            const auto in_r = winding_number(r, p);
            if (!in_a || !in_b || !in_r) continue;
            differs =
                differs || verify_test::is_member(operation, *in_a > 0, *in_b > 0) != (*in_r > 0);
        }
        if (differs) {
            EXPECT_EQ(report.verdict, Verdict::Different) << seed;
        }
    }
}

}  // namespace
