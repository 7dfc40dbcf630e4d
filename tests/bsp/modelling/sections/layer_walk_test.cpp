// SPDX-License-Identifier: Apache-2.0
//
// Slices by walks are those of the arrangement, number by number; and how many are found so.

#include <trisect/bsp/modelling/sections/layer_walk.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/sections/arranged_slice.h>
#include <trisect/bsp/modelling/sections/section_prism.h>
#include <trisect/bsp/modelling/slices.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/diagnostics.h>

#include <gtest/gtest.h>

#include "support/solids.h"

namespace trisect::detail {
namespace {

using solids::box;

PolygonMesh joined(const PolygonMesh& a, const PolygonMesh& b) {
    PolygonMesh out = a;
    const auto n = static_cast<std::uint32_t>(a.points.size());
    out.points.insert(out.points.end(), b.points.begin(), b.points.end());
    for (std::size_t f = 0; f < b.face_count(); ++f)
        out.add_triangle(n + b.face(f)[0], n + b.face(f)[1], n + b.face(f)[2]);
    return out;
}

/// How walks came out, by LayerOutcome.
using Outcomes = std::vector<int>;

void expect_as_arranged(const MeshSection& mesh, const std::vector<double>& heights,
                        const SliceOptions& options, Outcomes& outcomes) {
    outcomes.resize(5, 0);
    const SectionStack stack(mesh, heights);
    const SectionEdges edges(mesh);
    LayerWalk walk(mesh, edges);
    EvaluateOptions evaluation = options.evaluate;
    evaluation.threads = 1;
    for (std::size_t i = 0; i < stack.size(); ++i) {
        Slice found;
        const LayerOutcome outcome =
            walk.run(stack.plane(i), options.rule, evaluation.winding, found);
        ++outcomes[static_cast<std::size_t>(outcome)];
        if (outcome != LayerOutcome::Found) continue;
        EXPECT_EQ(found, arranged_slice(mesh, stack.plane(i), options.rule, evaluation))
            << stack.plane(i).height;
    }
}

/// Under all rules and across all axes; also at the heights of corners.
Outcomes expect_as_arranged(const ExactMesh& mesh) {
    Outcomes outcomes;
    for (int axis = 0; axis < 3; ++axis) {
        SliceOptions options;
        options.frame = SliceFrame::across(axis);
        const MeshSection section(mesh, options.frame);
        std::vector<double> heights{-1.3, 0.1, 1 / 3.0, 0.5, 1, 1.7, 2, 2.5, 3};
        for (std::uint32_t v = 0; v < section.point_count(); v += 17)
            heights.push_back(section.level(v));
        for (const SliceRule rule : {SliceRule::Closed, SliceRule::Below, SliceRule::Above}) {
            options.rule = rule;
            expect_as_arranged(section, heights, options, outcomes);
        }
    }
    return outcomes;
}

int found_of(const Outcomes& outcomes) {
    return outcomes[static_cast<std::size_t>(LayerOutcome::Found)];
}
int all_of(const Outcomes& outcomes) {
    int sum = 0;
    for (const int n : outcomes) sum += n;
    return sum;
}

TEST(LayerWalk, FindsWhatTheArrangementFinds) {
    const AffineMap turn{{{{0.36, 0.48, -0.8, 0}, {-0.8, 0.6, 0, 0}, {0.48, 0.64, 0.6, 0}}}};
    const Solid ring = Solid::from_mesh(make_torus(2, 0.7, 20, 12));
    const Solid ball = Solid::from_mesh(make_icosphere(1.5, 2));
    for (const Solid& solid :
         {ring, transformed(ring, turn), ball, evaluate(ring - ball), evaluate(ring | ball),
          evaluate(box(-1, 2) - ball), evaluate(box(0, 3) - box(1, 2)),
          transformed(evaluate(box(0, 3) - box(1, 2)), turn)}) {
        const Outcomes outcomes = expect_as_arranged(solid.to_exact_mesh());
        EXPECT_GT(2 * found_of(outcomes), all_of(outcomes));
    }
}

TEST(LayerWalk, FindsWhatTheArrangementFindsOfRandomBlocks) {
    std::mt19937 random{7};
    const auto number = [&](std::uint32_t n) { return static_cast<double>(random() % n); };
    const auto block = [&] {
        const Point3d low{number(4), number(4), number(4)};
        return box(low, {low[0] + 1 + number(3), low[1] + 1 + number(3), low[2] + 1 + number(3)});
    };
    int found = 0;
    for (int round = 0; round < 30; ++round)
        found += found_of(expect_as_arranged(
            evaluate(((block() | block() | block()) - block()) ^ block()).to_exact_mesh()));
    EXPECT_GT(found, 500);
}

PolygonMesh turned_inside_out(PolygonMesh mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        std::swap(mesh.corners[mesh.face_begin[f]], mesh.corners[mesh.face_begin[f] + 1]);
    return mesh;
}

// Corners a few last digits from each other: many are equal when rounded, and sides cross.
TEST(LayerWalk, FindsWhatTheArrangementFindsWhereRoundingShows) {
    std::mt19937 random{11};
    Outcomes outcomes;
    for (int round = 0; round < 40; ++round) {
        PolygonMesh mesh = make_icosphere(1, 1 + round % 2);
        for (Point3d& p : mesh.points) {
            p[2] *= 0x1p30;
            for (std::size_t k = 0; k < (round % 4 < 2 ? 1U : 2U); ++k)
                p[k] = std::ldexp(std::round(std::ldexp(p[k], 3 + round % 5)), -51) + 1 +
                       std::ldexp(static_cast<double>(random() % 2), -52);
        }
        std::vector<double> heights;
        for (int i = -9; i < 10; ++i) heights.push_back(i * 0x1.2p26);
        for (const auto winding :
             {EvaluateOptions::Winding::Positive, EvaluateOptions::Winding::NonZero}) {
            SliceOptions options;
            options.evaluate.winding = winding;
            expect_as_arranged(MeshSection(mesh), heights, options, outcomes);
        }
    }
    EXPECT_GT(found_of(outcomes), 100);
    EXPECT_GT(outcomes[static_cast<std::size_t>(LayerOutcome::Collapsed)], 100);
}

// Shells that are a few last digits thick: their sides cross.
TEST(LayerWalk, FindsWhatTheArrangementFindsOfThinShells) {
    std::mt19937 random{13};
    Outcomes outcomes;
    for (std::uint32_t round = 0; round < 24; ++round) {
        const PolygonMesh large = make_icosphere(1, 1 + round % 2);
        PolygonMesh small = turned_inside_out(large);
        for (Point3d& p : small.points)
            for (double& c : p) c *= 1 - 0x1p-53 * static_cast<double>(random() % (2 + round));
        std::vector<double> heights;
        for (int i = -9; i < 10; ++i) heights.push_back(0.1 * i);
        expect_as_arranged(MeshSection(joined(large, small)), heights, {}, outcomes);
    }
    EXPECT_GT(found_of(outcomes), 100);
    EXPECT_GT(outcomes[static_cast<std::size_t>(LayerOutcome::Crossing)], 50);
}

// Loops around loops of their own direction are left to the arrangement, under either rule.
TEST(LayerWalk, FindsWhatTheArrangementFindsOfMeshesWithinMeshes) {
    const PolygonMesh large = make_icosphere(2, 2);
    PolygonMesh small = make_icosphere(1, 2);
    const std::vector<double> heights{0.1, 0.6, 1.5};
    for (const bool turned : {false, true}) {
        if (turned) small = turned_inside_out(small);
        for (const auto winding :
             {EvaluateOptions::Winding::Positive, EvaluateOptions::Winding::NonZero}) {
            SliceOptions options;
            options.evaluate.winding = winding;
            const PolygonMesh both = joined(large, small);
            Outcomes outcomes;
            expect_as_arranged(MeshSection(both), heights, options, outcomes);
            EXPECT_EQ(found_of(outcomes), turned ? 3 : 1);
            const PolygonMesh inside_out = turned ? joined(small, small) : both;
            expect_as_arranged(MeshSection(inside_out), heights, options, outcomes);
        }
    }
}

SliceCounters counters_of(const Solid& solid, const std::vector<double>& heights) {
    const Diagnostics<SliceCounters> diagnostics;
    static_cast<void>(slices(solid, heights));
    return diagnostics.counters();
}

TEST(LayerWalk, CountsLayersThatGoEitherWay) {
    const Solid solid = box(0, 2);
    SliceCounters counts = counters_of(solid, {0.5, 1, 1, 1.5});
    EXPECT_EQ(counts.walked, 3U);
    EXPECT_EQ(counts.arranged, 0U);
    // Faces at both ends.
    counts = counters_of(solid, {0, 0.5, 2, 3});
    EXPECT_EQ(counts.walked, 2U);
    EXPECT_EQ(counts.faces, 2U);
    EXPECT_EQ(counts.arranged, 2U);
    // An edge in common.
    counts = counters_of(evaluate(box({0, 0, 0}, {1, 1, 1}) | box({1, 1, 0}, {2, 2, 1})), {0.5});
    EXPECT_EQ(counts.walked, 0U);
    EXPECT_EQ(counts.touching, 1U);
    // Two edges that are nearer than doubles at the height.
    const Solid far = transformed(Solid::from_mesh(make_icosphere(1, 4)),
                                  AffineMap{{{{0x1p-49, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}}}});
    const std::vector<double> heights{0.1, 0.2, 0.3};
    counts = counters_of(far, heights);
    EXPECT_EQ(counts.walked + counts.arranged, heights.size());
    EXPECT_EQ(counts.arranged, counts.touching + counts.collapsed + counts.crossing + counts.faces);
    EXPECT_GT(counts.crossing + counts.collapsed, 0U);
}

TEST(LayerWalk, CountsOnAllThreads) {
    std::vector<double> heights;
    for (int i = 0; i < 100; ++i) heights.push_back(-0.99 + 0.02 * i);
    SliceOptions options;
    for (const std::uint32_t threads : {1U, 3U}) {
        options.evaluate.threads = threads;
        const Diagnostics<SliceCounters> diagnostics;
        static_cast<void>(slices(Solid::from_mesh(make_icosphere(1, 2)), heights, options));
        EXPECT_EQ(diagnostics.counters().walked, heights.size());
    }
}

}  // namespace
}  // namespace trisect::detail
