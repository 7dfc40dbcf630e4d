// SPDX-License-Identifier: Apache-2.0
//
// Both parts of a solid from one evaluation: the sets, names and meshes of two, exact volumes, and
// how many evaluations it took. Random ones are in engines/split_test.cpp.

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/manifold.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/split.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace split_test {
namespace {

using trisect::Diagnostics;
using trisect::evaluate;
using trisect::EvaluateAllCounters;
using trisect::Expression;
using trisect::MeshMap;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::SplitSolid;

Solid ball(double x, double radius = 1, std::uint32_t level = 3) {
    PolygonMesh mesh = trisect::make_icosphere(radius, level);
    for (auto& p : mesh.points) {
        p[0] += x;
        p[1] += 0.07 * x;
        p[2] += 0.03 * x;
    }
    return Solid::from_mesh(mesh);
}

Solid box(const trisect::Point3d& low, const trisect::Point3d& high) {
    return Solid::from_mesh(trisect::make_box(low, high));
}

void expect_same(const Solid& solid, const Solid& expected) {
    MeshMap names;
    MeshMap wanted_names;
    const PolygonMesh mesh = solid.to_mesh(names);
    const PolygonMesh wanted = expected.to_mesh(wanted_names);
    EXPECT_TRUE(mesh.points == wanted.points);
    EXPECT_EQ(mesh.corners, wanted.corners);
    EXPECT_TRUE(names.source == wanted_names.source);
    EXPECT_EQ(exact_volume(solid), exact_volume(expected));
    EXPECT_EQ(solid.is_empty(), expected.is_empty());
}

struct Made {
    SplitSolid parts;
    std::uint64_t evaluations = 0;
};

template <class Cutter>
Made counted_split(const Solid& solid, const Cutter& cutter) {
    const Diagnostics<EvaluateAllCounters> diagnostics;
    Made out{split(solid, cutter), 0};
    EXPECT_EQ(diagnostics.counters().results, 2U);
    out.evaluations = diagnostics.counters().evaluations;
    return out;
}

// Bounded parts of a bounded solid.
void expect_split(const Solid& a, const Solid& b, std::uint64_t evaluations) {
    const Made made = counted_split(a, b);
    EXPECT_EQ(made.evaluations, evaluations);
    expect_same(made.parts.common, evaluate(a & b));
    expect_same(made.parts.rest, evaluate(a - b));
    EXPECT_EQ(exact_volume(made.parts.common) + exact_volume(made.parts.rest), exact_volume(a));
}

TEST(Split, MeshesInGeneralPositionShareOneEvaluation) {
    expect_split(ball(0), ball(0.61), 1);
    expect_split(ball(0.61), ball(0), 1);
    expect_split(ball(0), ball(0.3, 0.4), 1);  // nested
    expect_split(ball(0.3, 0.4), ball(0), 1);  // within the other one
    expect_split(ball(0), ball(5), 1);         // apart
    expect_split(ball(0, 1, 3), ball(1, 0.2, 2), 1);
}

TEST(Split, ThatTouchOrAreEqual) {
    const Solid a = Solid::from_mesh(trisect::make_icosphere(1, 3));
    // Edges meet edges in the plane of symmetry.
    PolygonMesh small = trisect::make_icosphere(0.5, 3);
    for (auto& p : small.points) p[0] += 0.7;
    expect_split(a, Solid::from_mesh(small), 1);
    // Both begin and end at the same heights: the parts want different moves.
    PolygonMesh moved = trisect::make_icosphere(1, 3);
    for (auto& p : moved.points) p[0] += 0.5;
    expect_split(a, Solid::from_mesh(moved), 2);
    for (auto& p : moved.points) p[0] += 1.5;  // corner to corner
    for (const Solid& b : {Solid::from_mesh(moved), a, ball(0)}) {
        const Made made = counted_split(a, b);
        expect_same(made.parts.common, evaluate(a & b));
        expect_same(made.parts.rest, evaluate(a - b));
    }
    EXPECT_TRUE(split(a, Solid::from_mesh(moved)).common.is_empty());
    EXPECT_TRUE(split(a, a).rest.is_empty());
}

TEST(Split, BoxesWithPlanesInCommon) {
    const Solid a = box({0, 0, 0}, {4, 4, 4});
    for (const Solid& b :
         {box({1, 1, 0}, {2, 2, 4}), box({4, 0, 0}, {8, 4, 4}), box({2, 0, 0}, {4, 4, 4}),
          box({4, 4, 4}, {5, 5, 5}), Solid(), a, box({-1, -1, -1}, {9, 9, 9})})
        expect_split(a, b, 2);
    expect_split(Solid(), a, 2);
    expect_split(a, Solid::whole_space(), 2);
}

// Each of the meshes has been divided, met itself, or is a result.
TEST(Split, WithoutAFastRoadThereAreTwoEvaluations) {
    const Solid a = ball(0);
    const Solid b = ball(0.61);
    const Solid cut = evaluate(a - ball(-0.9));
    expect_split(cut, b, 2);
    expect_split(b, cut, 2);
    const Solid indexed = ball(0);
    indexed.refine();
    expect_split(indexed, b, 2);
    PolygonMesh twice = trisect::make_icosphere(1, 2);
    append(twice, trisect::make_icosphere(1.1, 2));
    trisect::SolidOptions resolve;
    resolve.embedding = trisect::Embedding::Resolve;
    expect_split(Solid::from_mesh(twice, resolve), b, 2);
    {
        const trisect::StopScope limit({.max_work = std::uint64_t{1} << 60});
        EXPECT_EQ(counted_split(ball(0), ball(0.61)).evaluations, 2U);
    }
}

TEST(Split, CoordinatesWithFractions) {
    PolygonMesh mesh = trisect::make_icosphere(1, 3);
    for (auto& p : mesh.points) p[0] += 1e-19 * p[1];
    expect_split(Solid::from_mesh(mesh), ball(0.61), 1);
    expect_split(ball(0.61), Solid::from_mesh(mesh), 1);
}

TEST(Split, UnboundedSets) {
    const Solid a = ball(0);
    const Solid outside = evaluate(~Expression(ball(0.61)));
    const Made made = counted_split(a, outside);
    EXPECT_EQ(exact_volume(made.parts.common), exact_volume(evaluate(a - ball(0.61))));
    const SplitSolid of_space = split(Solid::whole_space(), a);
    EXPECT_EQ(exact_volume(of_space.common), exact_volume(a));
    EXPECT_THROW(static_cast<void>(of_space.rest.to_mesh()), trisect::UnsupportedError);
    const SplitSolid of_complement = split(outside, a);
    EXPECT_TRUE(evaluate(of_complement.common ^ (outside & a)).is_empty());
    EXPECT_TRUE(evaluate(of_complement.rest ^ (outside - a)).is_empty());
    const Solid half = Solid::half_space({1, 2, 3, 0});
    const SplitSolid of_half = split(half, Solid::half_space({1, 2, 3, 1}));
    EXPECT_TRUE(evaluate(of_half.common ^ Solid::half_space({1, 2, 3, 1})).is_empty());
    EXPECT_FALSE(of_half.rest.is_empty());
}

TEST(Split, ByAPlaneInOnePass) {
    const Solid a = ball(0);
    const std::array<double, 4> plane{1, 2, 3, -0.4};
    const Solid half = Solid::half_space(plane);
    const Made made = counted_split(a, half);
    EXPECT_EQ(made.evaluations, 1U);
    expect_same(made.parts.common, evaluate(a & half));
    expect_same(made.parts.rest, evaluate(a - half));
    EXPECT_EQ(exact_volume(split(a, plane).rest), exact_volume(made.parts.rest));
    // The complement is the other side.
    const Solid above = evaluate(~Expression(half));
    const Made turned = counted_split(a, above);
    EXPECT_EQ(turned.evaluations, 1U);
    expect_same(turned.parts.common, evaluate(a & above));
    expect_same(turned.parts.rest, evaluate(a - above));
}

TEST(Split, ByAPlaneThroughCornersEdgesAndFaces) {
    const Solid a = box({0, 0, 0}, {2, 2, 2});
    for (const std::array<double, 4>& plane : {std::array<double, 4>{1, 1, 1, -2},
                                               {1, -1, 0, 0},
                                               {0, 0, 1, -2},
                                               {0, 0, 1, 0},
                                               {1, 1, 0, -4}}) {
        const Solid half = Solid::half_space(plane);
        const Made made = counted_split(a, half);
        EXPECT_EQ(made.evaluations, 2U);
        expect_same(made.parts.common, evaluate(a & half));
        expect_same(made.parts.rest, evaluate(a - half));
    }
    EXPECT_EQ(counted_split(a, std::array<double, 4>{1, 2, 3, -5.5}).evaluations, 1U);
    // Beside all of it.
    for (const double d : {5.0, -5.0}) {
        const Solid half = Solid::half_space({0, 0, 1, d});
        const Made made = counted_split(a, half);
        EXPECT_EQ(made.evaluations, 1U);
        expect_same(made.parts.common, evaluate(a & half));
        expect_same(made.parts.rest, evaluate(a - half));
        EXPECT_EQ(made.parts.common.lattice(), evaluate(a & half).lattice());
        EXPECT_EQ(made.parts.rest.source_id(), 0U);
    }
}

TEST(Split, SlabsOfManyPlanes) {
    const Solid a = ball(0);
    std::vector<std::array<double, 4>> planes;
    for (int i = -9; i < 10; ++i) planes.push_back({0.5, 1, 1.5, -0.211 * i});
    const Diagnostics<EvaluateAllCounters> diagnostics;
    const std::vector<Solid> slabs = split(a, planes);
    ASSERT_EQ(slabs.size(), planes.size() + 1);
    EXPECT_EQ(diagnostics.counters().results, slabs.size());
    EXPECT_EQ(diagnostics.counters().evaluations, 1U);  // also of those beyond the ball
    auto volume = exact_volume(Solid());
    for (std::size_t i = 0; i < slabs.size(); ++i) {
        // Of two new half-spaces the first one comes first in a mesh.
        const Solid low = Solid::half_space(planes[i > 0 ? i - 1 : 0]);
        Expression wanted = a;
        if (i < planes.size()) wanted = wanted & Solid::half_space(planes[i]);
        if (i > 0) wanted = wanted - low;
        const Solid alone = evaluate(wanted);
        EXPECT_EQ(slabs[i].to_mesh().corners, alone.to_mesh().corners) << i;
        EXPECT_TRUE(slabs[i].to_mesh().points == alone.to_mesh().points) << i;
        volume = volume + exact_volume(slabs[i]);
    }
    EXPECT_EQ(volume, exact_volume(a));
}

TEST(Split, PlanesInNoOrder) {
    const Solid a = ball(0);
    const std::vector<std::array<double, 4>> planes{
        {0, 0, 1, -0.3}, {0, 0, 1, 0.4}, {1, 0.1, 0, 0}, {-1, -0.1, 0, 0.2}, {0, 0, 2, -0.6}};
    const std::vector<Solid> parts = split(a, planes);
    ASSERT_EQ(parts.size(), 6U);
    EXPECT_TRUE(parts[1].is_empty());
    EXPECT_TRUE(parts[4].is_empty());
    auto volume = exact_volume(Solid());
    for (const Solid& part : parts) volume = volume + exact_volume(part);
    EXPECT_EQ(volume, exact_volume(a));
    EXPECT_EQ(split(a, std::vector<std::array<double, 4>>()).size(), 1U);
}

TEST(Split, RefusesWhatIsNoPlane) {
    const Solid a = ball(0);
    EXPECT_THROW(static_cast<void>(split(a, std::array<double, 4>{0, 0, 0, 1})),
                 trisect::UsageError);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(static_cast<void>(split(a, std::array<double, 4>{nan, 0, 1, 0})), trisect::Error);
    EXPECT_THROW(
        static_cast<void>(split(a, std::vector<std::array<double, 4>>(70'000, {0, 0, 1, 0}))),
        trisect::LimitError);
}

TEST(Split, ByAnyNumberOfThreads) {
    const Solid a = ball(0, 1, 5);
    const Solid b = ball(0.61, 1, 5);
    for (const std::uint32_t threads : {1U, 2U, 4U}) {
        trisect::EvaluateOptions options;
        options.threads = threads;
        const SplitSolid parts = split(a, b, options);
        expect_same(parts.common, evaluate(a & b));
        expect_same(parts.rest, evaluate(a - b));
        const SplitSolid halves = split(a, Solid::half_space({1, 2, 3, -0.4}), options);
        EXPECT_EQ(exact_volume(halves.common) + exact_volume(halves.rest), exact_volume(a));
    }
}

// Results are operands like others: their trees are made when they are needed.
TEST(Split, PartsAreOperands) {
    const Solid a = ball(0);
    const Solid b = ball(0.61);
    const SplitSolid parts = split(a, b);
    EXPECT_TRUE(evaluate((parts.common | parts.rest) ^ a).is_empty());
    EXPECT_TRUE(evaluate(parts.common & parts.rest).is_empty());
    const SplitSolid again = split(parts.rest, ball(-0.7));
    EXPECT_EQ(exact_volume(again.common) + exact_volume(again.rest), exact_volume(parts.rest));
}

TEST(Split, CancelledAndLimitedByTheScope) {
    std::atomic<bool> stop{true};
    const trisect::StopScope scope(&stop);
    EXPECT_THROW(static_cast<void>(split(ball(0), ball(0.61))), trisect::CancelledError);
}

TEST(Split, OfTheFacadeOfManifold) {
    namespace manifold = trisect::manifold;
    const manifold::Manifold a(ball(0));
    const manifold::Manifold b(ball(0.61));
    const Diagnostics<EvaluateAllCounters> diagnostics;
    const auto [common, rest] = a.Split(b);
    EXPECT_EQ(diagnostics.counters().evaluations, 1U);
    EXPECT_EQ(common.Volume(), (a ^ b).Volume());
    EXPECT_EQ(rest.Volume(), (a - b).Volume());
    const auto [above, below] = a.SplitByPlane({1, 2, 3}, 0.1);
    EXPECT_EQ(diagnostics.counters().evaluations, 2U);
    EXPECT_EQ(above.Volume(), a.TrimByPlane({1, 2, 3}, 0.1).Volume());
    EXPECT_EQ(exact_volume(above.solid()) + exact_volume(below.solid()), exact_volume(a.solid()));
    const manifold::Manifold wrong = manifold::Manifold::Cube({-1, 1, 1});
    EXPECT_EQ(a.Split(wrong).second.Status(), wrong.Status());
    EXPECT_EQ(wrong.SplitByPlane({0, 0, 1}, 0).first.Status(), wrong.Status());
}

TEST(EvaluateAll, UsualFormulasShareOneComparison) {
    const Solid a = ball(0);
    const Solid b = ball(0.61);
    const Expression p = a;
    const Expression q = b;
    const std::vector<Expression> formulas{p | q, p & q, p - q, ~p & q, p ^ q};
    const Diagnostics<EvaluateAllCounters> diagnostics;
    std::vector<trisect::EvaluateReport> reports;
    const std::vector<Solid> solids = evaluate_all(formulas, {}, &reports);
    EXPECT_EQ(diagnostics.counters().results, 5U);
    EXPECT_EQ(diagnostics.counters().evaluations, 1U);
    ASSERT_EQ(reports.size(), 5U);
    for (std::size_t i = 0; i < formulas.size(); ++i) {
        expect_same(solids[i], evaluate(formulas[i]));
        EXPECT_EQ(reports[i].lattice.lattice, solids[i].lattice());
    }
    EXPECT_TRUE(trisect::evaluate_all(std::vector<Expression>()).empty());
}

TEST(EvaluateAll, OtherFormulasAreEvaluatedAlone) {
    const Solid a = ball(0);
    const Solid b = ball(0.61);
    const Solid c = ball(-0.4, 0.5, 2);
    const std::vector<Expression> formulas{a & b, c | a | b, a - b, Expression(c), a & a, b & a};
    const Diagnostics<EvaluateAllCounters> diagnostics;
    const std::vector<Solid> solids = evaluate_all(formulas);
    EXPECT_EQ(diagnostics.counters().evaluations, 5U);
    for (std::size_t i = 0; i < formulas.size(); ++i) expect_same(solids[i], evaluate(formulas[i]));
}

}  // namespace
}  // namespace split_test
