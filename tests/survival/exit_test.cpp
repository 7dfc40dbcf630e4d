// SPDX-License-Identifier: Apache-2.0
//
// Memory that evaluations hand on to each other outlives everything that may still want it: objects
// with static storage that were made before it was first needed, and so end after most others.

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace {

using trisect::Solid;

Solid ball_at(double x) {
    trisect::PolygonMesh mesh = trisect::make_icosphere(1, 3);
    for (auto& p : mesh.points) p[0] += x;
    return Solid::from_mesh(mesh);
}

// Leaves of all kinds, and fragments in them.
Solid chain(const Solid& start) {
    Solid out = start;
    for (int i = 0; i < 5; ++i) out = evaluate(out - ball_at(0.75 + i / 64.0));
    return evaluate(out - Solid::from_mesh(trisect::make_box({0, 0, 0}, {2, 2, 2})));
}

struct EvaluatesWhenItEnds {
    std::unique_ptr<Solid> solid;
    ~EvaluatesWhenItEnds() {
        if (chain(*solid).to_mesh().face_count() == 0) std::_Exit(3);
    }
};

[[noreturn]] void end_after_an_evaluation() {
    static EvaluatesWhenItEnds last;
    last.solid = std::make_unique<Solid>(ball_at(0));
    if (chain(*last.solid).to_mesh().face_count() == 0) std::_Exit(2);
    std::exit(0);
}

TEST(Exit, AfterAnEvaluation) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(end_after_an_evaluation(), testing::ExitedWithCode(0), "");
}

}  // namespace
