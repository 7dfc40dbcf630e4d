// SPDX-License-Identifier: Apache-2.0
//
// Solids under maps: exact ones against maps of their operands, rounded ones against what they
// report; names of faces; connected parts.

#include <trisect/bsp/solid_transform.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/embedding_findings.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"

namespace solid_transform_test {
namespace {

using reference::Random;
using trisect::evaluate;
using trisect::ExactRational;
using trisect::LatticeReport;
using trisect::Pose;
using trisect::Solid;

Solid box(const trisect::Point3d& low, const trisect::Point3d& high) {
    return Solid::from_mesh(trisect::make_box(low, high));
}

bool are_equal(const Solid& a, const Solid& b) { return evaluate(a ^ b).is_empty(); }

// Quarter turns, mirrors and a translation by integers.
Pose random_move(Random& random) {
    std::array<std::size_t, 3> from{0, 1, 2};
    for (std::size_t i = 2; i > 0; --i) std::swap(from[i], from[random.below(i + 1)]);
    std::array<double, 12> rows{};
    for (std::size_t i = 0; i < 3; ++i) {
        rows[4 * i + from[i]] = random.chance(1, 2) ? 1 : -1;
        rows[4 * i + 3] = static_cast<double>(random.between(-9, 9));
    }
    return Pose::from_doubles(rows);
}

reference::Operand moved(const reference::Operand& operand, const Pose& pose) {
    reference::Operand out = operand;
    for (auto& t : out) {
        for (auto& p : t) {
            std::array<std::int64_t, 3> q{};
            for (std::size_t i = 0; i < 3; ++i) {
                const auto entry = [&](std::size_t k) {
                    return static_cast<std::int64_t>(pose.approximate()[4 * i + k]);
                };
                q[i] = entry(0) * p[0] + entry(1) * p[1] + entry(2) * p[2] + entry(3);
            }
            p = {q[0], q[1], q[2]};
        }
        if (pose.is_mirror()) std::swap(t[1], t[2]);
    }
    return out;
}

TEST(TransformedSolid, OfAResultIsTheResultOfMovedOperands) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const auto family = reference::random_family(random, 3);
        const reference::Expression formula = reference::random_expression(random, 3, 3);
        const Pose pose = random_move(random);
        std::vector<Solid> solids;
        std::vector<Solid> moved_solids;
        for (const reference::Operand& o : family) {
            solids.push_back(engines::solid(o));
            moved_solids.push_back(engines::solid(moved(o, pose)));
        }
        LatticeReport report;
        const Solid result = evaluate(engines::formula(formula, solids));
        const Solid there = trisect::transformed(result, pose, &report);
        EXPECT_TRUE(report.lossless) << seed;
        EXPECT_EQ(report.moved, 0U);
        const Solid expected = evaluate(engines::formula(formula, moved_solids));
        EXPECT_TRUE(are_equal(there, expected)) << seed;
        EXPECT_EQ(there.to_brep().counts(), expected.to_brep().counts()) << seed;
        // As an operand, together with what did not move.
        const Solid mixed = evaluate(there - solids[0]);
        EXPECT_TRUE(are_equal(mixed, evaluate(expected - solids[0]))) << seed;
        EXPECT_TRUE(are_equal(trisect::transformed(there, pose.inverse()), result)) << seed;
    }
}

TEST(TransformedSolid, KeepsTheNamesOfFaces) {
    const Solid a = box({0, 0, 0}, {2, 2, 2});
    const Solid b = box({1, 1, 1}, {3, 3, 3});
    const Solid cut = evaluate(a - b);
    const auto names = [](const Solid& s) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> out;
        const trisect::Brep brep = s.to_brep();
        for (const trisect::FaceId f : brep.faces())
            out.emplace(brep.source(f).operand, brep.source(f).face);
        return out;
    };
    const Pose mirror = Pose::from_doubles({-1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0.25});
    EXPECT_EQ(names(trisect::transformed(cut, mirror)), names(cut));
    EXPECT_EQ(trisect::transformed(a, mirror).source_id(), a.source_id());
    const Pose turn = Pose::rotation_near({1, 2, 3}, 33);
    EXPECT_EQ(names(trisect::transformed(cut, turn)), names(cut));
    const trisect::BrepIndex index(trisect::transformed(a, Pose::from_translation({4, 0, 0})));
    const trisect::Place corner = index.locate(trisect::Point3d{4, 0, 0});
    EXPECT_EQ(corner.corner.operand, a.source_id());
    EXPECT_EQ(corner.corner, trisect::BrepIndex(a).locate(trisect::Point3d{0, 0, 0}).corner);
}

TEST(TransformedSolid, TakesAFinerLatticeForAFinerTranslation) {
    const Solid a = box({0, 0, 0}, {1, 1, 1});
    ASSERT_EQ(a.lattice(), trisect::Lattice{0});
    LatticeReport report;
    const Solid b = trisect::transformed(a, Pose::from_translation({0.5, 0.25, 0}), &report);
    EXPECT_TRUE(report.lossless);
    EXPECT_EQ(b.lattice(), trisect::Lattice{-8});
    EXPECT_EQ(trisect::bounds(b), (trisect::Bounds{{0.5, 0.25, 0}, {1.5, 1.25, 1}}));
    EXPECT_EQ(trisect::volume(evaluate(a & b)), 0.375);
}

TEST(TransformedSolid, RoundsATranslationAsAWhole) {
    const Solid ball = Solid::from_mesh(trisect::make_icosphere(10, 3));
    LatticeReport report;
    // A third has no place on any lattice.
    const std::array<Pose::Number, 9> unit{3, 0, 0, 0, 3, 0, 0, 0, 3};
    const std::array<Pose::Number, 3> by{1, 0, 0};
    const Solid there =
        trisect::transformed(ball, Pose::from_integers(unit, by, Pose::Number(3)), &report);
    EXPECT_FALSE(report.lossless);
    EXPECT_EQ(report.moved, 642U);
    EXPECT_GT(report.max_move, 0);
    EXPECT_LE(report.max_move, there.lattice().to_double(0.5));
    EXPECT_LT(report.max_move, 1e-12);
    EXPECT_EQ(report.flipped_faces, 0U);
    EXPECT_EQ(trisect::exact_volume(there), trisect::exact_volume(ball));
}

TEST(TransformedSolid, RoundsVerticesUnderOtherMapsAndReports) {
    const Solid cut = evaluate(box({0, 0, 0}, {2, 2, 2}) - box({1, 1, 1}, {3, 3, 3}));
    LatticeReport report;
    const Solid there =
        trisect::transformed(cut, trisect::AffineMap::rotation({0, 0, 1}, 30), &report);
    EXPECT_FALSE(report.lossless);
    EXPECT_GT(report.moved, 0U);
    EXPECT_LT(report.max_move, 1e-12);
    EXPECT_EQ(report.flipped_faces, 0U);
    EXPECT_EQ(report.lattice, there.lattice());
    EXPECT_NEAR(trisect::volume(there), 7, 1e-12);
    const auto bounds = trisect::bounds(there);
    EXPECT_NEAR(bounds->lo[0], -1, 1e-12);
    EXPECT_NEAR(bounds->hi[1], 1 + std::sqrt(3.0), 1e-12);
    EXPECT_TRUE(trisect::validate(there.to_mesh()).empty());
}

TEST(TransformedSolid, MirrorsAndComplementsKeepTheirInside) {
    const Solid cut = evaluate(box({0, 0, 0}, {2, 2, 2}) - box({1, 1, 1}, {3, 3, 3}));
    const Pose skew = Pose::from_doubles({-1, 0.5, 0, 0, 0, 1, 0.25, 0, 0, 0, 2, 0});
    ASSERT_TRUE(skew.is_mirror());
    EXPECT_EQ(trisect::volume(trisect::transformed(cut, skew)), 14);
    const Solid rest = trisect::transformed(evaluate(~cut), skew);
    EXPECT_TRUE(are_equal(evaluate(~rest), trisect::transformed(cut, skew)));
    const Solid turned = trisect::transformed(evaluate(~cut), Pose::from_quaternion({1, 0, 0, 1}));
    EXPECT_EQ(trisect::volume(evaluate(~turned)), 7);
}

TEST(TransformedSolid, OfSpecialSets) {
    const Pose turn = Pose::rotation_near({1, 2, 3}, 33);
    EXPECT_TRUE(trisect::transformed(Solid(), turn).is_empty());
    EXPECT_TRUE(trisect::transformed(Solid::whole_space(), turn).is_whole_space());
    const Solid half = Solid::half_space({1, 0, 0, -1});
    EXPECT_THROW((void)trisect::transformed(half, turn), trisect::UnsupportedError);
    const Solid above =
        trisect::transformed(half, Pose::from_quaternion({0, 0, 0, 1}, {0.5, 0, 0}));
    EXPECT_EQ(trisect::volume(evaluate(above & box({-2, 0, 0}, {2, 1, 1}))), 2.5);
}

// There a solid whose coordinates are doubles is moved corner by corner.
TEST(TransformedSolid, LeavesTheLattice) {
    const Pose far = Pose::from_translation({0x1p60, 0, 0});
    const Solid there = trisect::transformed(box({0, 0, 0}, {1024, 1, 1}), far);
    EXPECT_EQ(trisect::volume(there), 1024);
    EXPECT_EQ(trisect::bounds(there)->hi[0], 0x1p60 + 1024);
    try {
        (void)trisect::transformed(box({0, 0, 0}, {1, 1, 1}), far);
        ADD_FAILURE() << "2^60 and 2^60 + 1 are one double";
    } catch (const trisect::Error& e) {
        EXPECT_EQ(e.code(), trisect::ErrorCode::InvalidSolid);
    }
    const Solid half = Solid::half_space({1, 0, 0, -1});
    EXPECT_THROW((void)trisect::transformed(half, Pose::from_translation({0x1p140, 0, 0})),
                 trisect::LimitError);
}

TEST(RotationNear, IsExactForQuartersAndThirds) {
    EXPECT_EQ(Pose::rotation_near({0, 0, 1}, 90), Pose::from_quaternion({1, 0, 0, 1}));
    EXPECT_EQ(Pose::rotation_near({0, -2, 0}, 180), Pose::from_quaternion({0, 0, 1, 0}));
    EXPECT_EQ(Pose::rotation_near({1, 1, 1}, 120), Pose::from_quaternion({1, 1, 1, 1}));
    EXPECT_EQ(Pose::rotation_near({3, 4, 5}, 0), Pose());
    EXPECT_EQ(Pose::rotation_near({0, 0, 1}, 450), Pose::from_quaternion({1, 0, 0, 1}));
}

TEST(RotationNear, IsNearTheRotation) {
    for (const int bits : {8, 20, 40}) {
        for (double degrees = -350; degrees < 360; degrees += 37) {
            const Pose p = Pose::rotation_near({1, -2, 0.5}, degrees, bits);
            const auto q = trisect::AffineMap::rotation({1, -2, 0.5}, degrees);
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j)
                    EXPECT_NEAR(p.approximate()[4 * i + j], q.rows[i][j],
                                std::ldexp(1.0, 3 - bits) + 1e-14);
        }
    }
    EXPECT_THROW((void)Pose::rotation_near({0, 0, 0}, 1), trisect::UsageError);
    EXPECT_THROW((void)Pose::rotation_near({0, 0, 1}, 1, 60), trisect::UsageError);
}

TEST(Components, HaveTheirCavities) {
    const Solid shell = evaluate(box({0, 0, 0}, {8, 8, 8}) - box({1, 1, 1}, {7, 7, 7}));
    const Solid inner = evaluate(box({2, 2, 2}, {6, 6, 6}) - box({3, 3, 3}, {5, 5, 5}));
    const Solid aside = box({8, 8, 8}, {9, 9, 9});  // touches a corner
    const auto parts = trisect::components(evaluate(shell | inner | aside));
    ASSERT_EQ(parts.size(), 3U);
    EXPECT_TRUE(are_equal(parts[0], shell));
    EXPECT_TRUE(are_equal(parts[1], inner));
    EXPECT_TRUE(are_equal(parts[2], aside));
    const trisect::Brep brep = parts[2].to_brep();
    EXPECT_EQ(brep.source(trisect::FaceId(0)).operand, aside.source_id());
}

TEST(Components, OfRoundBodiesOffTheLattice) {
    const Solid torus = Solid::from_mesh(trisect::make_torus(2, 0.5, 24, 12));
    const Solid knife =
        Solid::from_mesh(trisect::transformed(trisect::make_box({-9, -0.125, -9}, {9, 0.125, 9}),
                                              trisect::AffineMap::rotation({0.1, 0.2, 1}, 20)));
    const Solid cut = evaluate(torus - knife);
    const auto parts = trisect::components(cut);
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_TRUE(evaluate(parts[0] & parts[1]).is_empty());
    EXPECT_TRUE(are_equal(evaluate(parts[0] | parts[1]), cut));
    EXPECT_EQ(trisect::exact_volume(parts[0]) + trisect::exact_volume(parts[1]),
              trisect::exact_volume(cut));
}

// A box whose bottom has a corner so near to one of its edges that rounding puts it there: the
// triangle between them is gone, and its corner lies inside the edge of the side.
trisect::PolygonMesh box_with_needle(double near) {
    trisect::PolygonMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},     {0, 0, 1},
                   {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, near, 0}};
    mesh.add_triangle(0, 8, 1);
    mesh.add_triangle(0, 3, 8);
    mesh.add_triangle(3, 2, 8);
    mesh.add_triangle(2, 1, 8);
    const std::vector<std::array<std::uint32_t, 4>> sides{
        {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
    for (const auto& side : sides) mesh.add_face(side);
    return mesh;
}

TEST(SolidTransform, TrianglesThatRoundingMakesFlat) {
    const Solid flat = Solid::from_mesh(box_with_needle(0));
    EXPECT_EQ(flat.to_brep({.maximal_faces = false}).counts().shells, 1U);
    const Solid s = Solid::from_mesh(box_with_needle(std::ldexp(1, -60)));
    LatticeReport report;
    const Solid there =
        trisect::transformed(s, trisect::AffineMap::translation({8, 8, 8}), &report);
    EXPECT_EQ(report.moved, 1U);
    const trisect::BrepCounts counts = there.to_brep().counts();
    EXPECT_EQ(counts.vertices, 8U);
    EXPECT_EQ(counts.faces, 6U);
    EXPECT_EQ(there.to_brep({.maximal_faces = false}).counts().shells, 1U);
    EXPECT_TRUE(are_equal(there, box({8, 8, 8}, {9, 9, 9})));
    EXPECT_EQ(trisect::volume(evaluate(there | box({9, 8, 8}, {10, 9, 9}))), 2);
}

// Boxes that are a hair apart from each other's planes leave triangles that a turn makes flat or
// turns over.
TEST(SolidTransform, ThinTrianglesAreGivenUpWhereTheyWouldMeet) {
    const Pose turn = Pose::from_doubles({0.5, 0.866025, 0, 0, -0.866025, 0.5, 0, 0, 0, 0, 1, 0});
    std::mt19937 random(20261129);
    std::size_t met = 0;
    std::size_t mended = 0;
    for (int round = 0; round < 200; ++round) {
        const auto near = [&](double v) { return v + static_cast<double>(random() % 4) * 0x1p-50; };
        const auto slanted = [&](double x) {
            trisect::PolygonMesh mesh =
                trisect::make_box({x, near(1), near(1)}, {x + 3, near(2), near(2)});
            for (trisect::Point3d& p : mesh.points) p[0] += p[2] * 0.37;
            return Solid::from_mesh(mesh);
        };
        const Solid solid = evaluate((slanted(0.1) - slanted(near(1.7))) | slanted(2.9));
        const trisect::ExactMesh mesh = solid.to_exact_mesh();
        trisect::AffineMap map;
        map.rows = {{{0.5, 0.866025, 0, 0}, {-0.866025, 0.5, 0, 0}, {0, 0, 1, 0}}};
        const bool meets_itself =
            !trisect::find_embedding(
                 trisect::import_mesh(trisect::transformed_mesh(mesh, map)).mesh)
                 .is_embedded;
        LatticeReport report;
        const Solid turned = trisect::transformed(solid, turn, &report);
        EXPECT_LT(report.max_move, 1e-14);
        EXPECT_NEAR(volume(turned), volume(solid) * (0.25 + 0.866025 * 0.866025), 1e-13);
        if (!meets_itself) continue;
        ++met;
        mended += trisect::detail::state_of(turned)->embedded ? 1 : 0;
    }
    EXPECT_GT(met, 10U);
    EXPECT_GT(4 * mended, 3 * met);  // the others are left to what comes next
}

// Their own doubles: nothing is repaired where nothing is rounded.
TEST(SolidTransform, ThinTrianglesOfAUserStayUnderExactMaps) {
    trisect::PolygonMesh mesh;
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {2 + 0x1p-51, 2, 0}};
    for (const std::array<std::uint32_t, 3>& t : std::vector<std::array<std::uint32_t, 3>>{
             {0, 2, 1}, {2, 4, 1}, {0, 1, 3}, {0, 3, 2}, {1, 4, 3}, {4, 2, 3}})
        mesh.add_triangle(t[0], t[1], t[2]);
    trisect::SolidOptions options;
    options.embedding = trisect::Embedding::Check;
    const Solid solid = Solid::from_mesh(mesh, options);
    LatticeReport report;
    const Solid twice = trisect::transformed(
        solid, Pose::from_doubles({2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0}), &report);
    EXPECT_TRUE(report.lossless);
    EXPECT_EQ(report.max_move, 0);
    EXPECT_EQ(twice.to_exact_mesh().triangles.size(), 6U);
    EXPECT_EQ(twice.to_exact_mesh().points.size(), 5U);
}

TEST(Components, OfSpecialSets) {
    EXPECT_TRUE(trisect::components(Solid()).empty());
    EXPECT_EQ(trisect::components(box({0, 0, 0}, {1, 1, 1})).size(), 1U);
    EXPECT_THROW((void)trisect::components(Solid::whole_space()), trisect::UnsupportedError);
    EXPECT_THROW((void)trisect::components(Solid::half_space({0, 0, 1, 0})),
                 trisect::UnsupportedError);
}

}  // namespace
}  // namespace solid_transform_test
