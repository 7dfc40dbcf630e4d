// SPDX-License-Identifier: Apache-2.0
//
// Meshes that meet themselves in places, beside sets of embedded solids.

#include <gtest/gtest.h>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/solid_measure.h>

#include "engines/evaluate_stats.h"
#include "support/mesh_builders.h"

namespace {

using trisect::Embedding;
using trisect::Expression;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::test::EvaluateStats;
using trisect::test::flipped;
using trisect::test::together;

PolygonMesh moved(PolygonMesh mesh, double x, double y) {
    for (auto& p : mesh.points) {
        p[0] += x;
        p[1] += y;
    }
    return mesh;
}
PolygonMesh ball(double radius, double x, double y = 0) {
    return moved(trisect::make_icosphere(radius, 3), x, y);
}

Solid solid(const PolygonMesh& mesh, Embedding embedding = Embedding::Assume) {
    return Solid::from_mesh(mesh, {.import = {}, .embedding = embedding});
}

// All operations of a mesh that meets itself with an embedded one, with itself and with what is
// left of both. `set` is what it bounds, of embedded solids.
void expect_set(const PolygonMesh& mesh, const Expression& set) {
    const Solid resolved = solid(mesh, Embedding::Check);
    const Solid expected = trisect::evaluate(set);
    const auto compare = [&](const Expression& ours, const Expression& theirs) {
        const Solid a = trisect::evaluate(ours);
        const Solid b = trisect::evaluate(theirs);
        EXPECT_TRUE(trisect::evaluate(Expression(a) ^ b).is_empty());
        EXPECT_EQ(trisect::exact_volume(a), trisect::exact_volume(b));
    };
    EvaluateStats stats;
    (void)trisect::test::evaluate(resolved, {}, &stats);
    EXPECT_GT(stats.embedded_cells, 0U);
    const Solid other = solid(ball(0.7, 0.4, 0.9));
    compare(Expression(resolved) | other, Expression(expected) | other);
    compare(Expression(resolved) & other, Expression(expected) & other);
    compare(Expression(resolved) - other, Expression(expected) - other);
    compare(Expression(other) - resolved, Expression(other) - expected);
    compare(Expression(resolved) ^ other, Expression(expected) ^ other);
    const Solid refined = solid(mesh, Embedding::Check);
    refined.refine(1);
    compare(Expression(refined) | other, Expression(expected) | other);
    compare(Expression(other) - refined, Expression(other) - expected);
    const Solid moved_self = solid(moved(mesh, 0.11, 0.07), Embedding::Check);
    const Solid moved_set = trisect::evaluate(Expression(moved_self));
    compare(Expression(resolved) | moved_self, Expression(expected) | moved_set);
    compare(Expression(resolved) - moved_self, Expression(expected) - moved_set);
}

TEST(EmbeddedPart, BallsThatCross) {
    expect_set(together(ball(1, 0), ball(1, 1)), Expression(solid(ball(1, 0))) | solid(ball(1, 1)));
}

TEST(EmbeddedPart, ABallWithinAnotherOneAndACavity) {
    expect_set(
        together(ball(1, 0), together(ball(0.5, 0), together(flipped(ball(0.4, 3)), ball(0.8, 3)))),
        Expression(solid(ball(1, 0))) | (Expression(solid(ball(0.8, 3))) - solid(ball(0.4, 3))));
}

TEST(EmbeddedPart, ATorusThroughABallAndAShellInsideOut) {
    const PolygonMesh torus = trisect::make_torus(1, 0.25, 64, 32);
    expect_set(together(torus, together(ball(0.5, 1), flipped(ball(0.3, 0, 2.5)))),
               Expression(solid(torus)) | solid(ball(0.5, 1)));
}

// There -1 is inside as well.
TEST(EmbeddedPart, NotUnderTheRuleOfNonZero) {
    const PolygonMesh mesh = together(ball(1, 0), flipped(ball(0.3, 3)));
    trisect::EvaluateOptions options;
    options.winding = trisect::EvaluateOptions::Winding::NonZero;
    const Solid b = solid(ball(1, 0.5));
    const Solid ours = trisect::evaluate(Expression(solid(mesh, Embedding::Check)) | b, options);
    const Solid expected =
        trisect::evaluate(Expression(solid(ball(1, 0))) | b | solid(ball(0.3, 3)));
    EXPECT_EQ(trisect::exact_volume(ours), trisect::exact_volume(expected));
}

}  // namespace
