// SPDX-License-Identifier: Apache-2.0
//
// Shared operands read by several threads at once, each evaluating formulas of its own. Also run
// under the thread sanitizer.

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <thread>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace {

using trisect::evaluate;
using trisect::Solid;

constexpr std::size_t thread_count = 6;

// Copies of the handles come and go in all threads; volumes are exact, so equal means equal.
std::string work(const Solid& ball, const Solid& box, const Solid& cut) {
    std::string log;
    for (int round = 0; round < 3; ++round) {
        const Solid kept = ball;  // NOLINT(performance-unnecessary-copy-initialization)
        const std::array results{evaluate(kept - box), evaluate(cut & box), evaluate(cut ^ kept),
                                 evaluate(~cut | box)};
        for (const Solid& s : results) log += trisect::exact_volume(s.to_brep()).to_string() + " ";
    }
    return log;
}

TEST(Threads, EvaluateOnSharedOperands) {
    const Solid ball = Solid::from_mesh(trisect::make_icosphere(4, 2));
    const Solid box = Solid::from_mesh(trisect::make_box({-1, -1, -1}, {5, 3, 2}));
    const Solid cut = evaluate(ball - Solid::from_mesh(trisect::make_box({-9, -9, 1}, {9, 9, 2})));
    const std::string alone = work(ball, box, cut);
    std::array<std::string, thread_count> logs;
    {
        std::array<std::jthread, thread_count> threads;
        for (std::size_t i = 0; i < thread_count; ++i)
            threads[i] = std::jthread([&, i] { logs[i] = work(ball, box, cut); });
    }
    for (const std::string& log : logs) EXPECT_EQ(log, alone);
}

TEST(Threads, ImportAndNameSolidsAtOnce) {
    std::array<std::uint32_t, thread_count> names{};
    {
        std::array<std::jthread, thread_count> threads;
        for (std::size_t i = 0; i < thread_count; ++i)
            threads[i] = std::jthread([&names, i] {
                for (int k = 0; k < 50; ++k)
                    names[i] = Solid::from_mesh(trisect::make_box({1, 1, 1})).source_id();
            });
    }
    for (std::size_t i = 0; i < thread_count; ++i)
        for (std::size_t j = i + 1; j < thread_count; ++j) EXPECT_NE(names[i], names[j]);
}

// Large enough for parts of their own in import and in to_mesh().
TEST(Threads, MeshesDoNotDependOnTheirNumber) {
    const trisect::PolygonMesh ball = trisect::make_icosphere(1, 6);
    const trisect::PolygonMesh box = trisect::make_box({0, 0, 0.1}, {2, 2, 2});
    const auto cut = [&](std::uint32_t threads) {
        const trisect::SolidOptions import{.import = {.threads = threads}};
        trisect::EvaluateOptions options;
        options.threads = threads;
        const Solid a = Solid::from_mesh(ball, import);
        const Solid b = Solid::from_mesh(box, import);
        return evaluate(a - b, options).to_mesh(threads);
    };
    const trisect::PolygonMesh alone = cut(1);
    ASSERT_GT(alone.face_count(), 70000U);
    for (const std::uint32_t threads : {0U, 2U, 8U}) {
        const trisect::PolygonMesh mesh = cut(threads);
        EXPECT_EQ(mesh.points, alone.points);
        EXPECT_EQ(mesh.corners, alone.corners);
        EXPECT_EQ(mesh.face_begin, alone.face_begin);
    }
}

}  // namespace
