// SPDX-License-Identifier: Apache-2.0
//
// Work on several threads that is stopped: every task runs, the first failure keeps its kind, and
// what was stopped can be done again. tests/campaign/stop_campaign.cpp goes on with this.

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_group.h>

#include <array>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/task_group.h>

namespace {

using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::PolygonMesh;
using trisect::Solid;

Solid sphere(const trisect::Point3d& by) {
    PolygonMesh mesh = trisect::make_icosphere(1, 5);
    for (auto& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] += by[k];
    return Solid::from_mesh(mesh);
}

// More threads than the machine may have.
class StoppedThreads : public testing::Test {
protected:
    tbb::global_control threads_{tbb::global_control::max_allowed_parallelism, 8};
};

// As a task of a group that is cancelled, the way a caller's own may be.
template <class Work>
void in_a_cancelled_group(const Work& work) {
    tbb::task_group group;
    group.run([&] {
        group.cancel();
        work();
    });
    (void)group.wait();
}

TEST_F(StoppedThreads, BothHalvesRunInAGroupThatIsCancelled) {
    for (int round = 0; round < 100; ++round) {
        std::atomic<int> ran{0};
        in_a_cancelled_group(
            [&] { trisect::detail::both_at_once([&] { ++ran; }, [&] { ++ran; }); });
        EXPECT_EQ(ran, 2);
    }
}

TEST_F(StoppedThreads, AllPartsRunInAGroupThatIsCancelled) {
    std::atomic<std::size_t> done{0};
    in_a_cancelled_group([&] {
        trisect::detail::ParallelParts(100'000, 4)
            .for_each(
                [&](std::size_t, std::size_t begin, std::size_t end) { done += end - begin; });
    });
    EXPECT_EQ(done, 100'000U);
}

TEST_F(StoppedThreads, EvaluationInAGroupThatIsCancelledGivesItsResult) {
    const Expression formula = (sphere({0, 0, 0}) ^ sphere({0.3, 0.2, 0.1})) - sphere({0.6, 0, 0});
    const PolygonMesh expected = evaluate(formula).to_mesh();
    for (int round = 0; round < 20; ++round)
        in_a_cancelled_group(
            [&] { EXPECT_EQ(evaluate(formula).to_mesh().points, expected.points); });
}

TEST_F(StoppedThreads, TheFirstFailureOfARecursionLeavesIt) {
    trisect::detail::SharedFailure failure;
    failure.guard([] { throw std::runtime_error("first"); });
    failure.guard([&] { failure.check(); });
    failure.guard([] { throw std::logic_error("second"); });
    EXPECT_THROW(failure.check(), trisect::detail::Abandoned);
    EXPECT_THROW(failure.rethrow(), std::runtime_error);
}

TEST_F(StoppedThreads, LimitsStayLimitsAndCancelledStaysCancelled) {
    const Expression formula = (sphere({0, 0, 0}) ^ sphere({0.3, 0.2, 0.1})) - sphere({0.6, 0, 0});
    trisect::EvaluateReport report;
    const PolygonMesh expected = evaluate(formula, {}, &report).to_mesh();
    for (const std::uint32_t threads : {2U, 4U, 8U}) {
        for (int round = 0; round < 30; ++round) {
            EvaluateOptions options;
            options.threads = threads;
            {
                const std::uint64_t part = report.memory * static_cast<std::uint64_t>(round) / 100;
                const trisect::StopScope limited({.max_memory = 1 + part});
                EXPECT_THROW((void)evaluate(formula, options), trisect::LimitError);
            }
            std::atomic<bool> cancel = false;
            std::thread other([&] {
                std::this_thread::sleep_for(std::chrono::microseconds(200 * round));
                cancel = true;
            });
            try {
                const Solid solid = [&] {
                    const trisect::StopScope stopped(&cancel);
                    return evaluate(formula, options);
                }();
                EXPECT_EQ(solid.to_mesh().points, expected.points);
            } catch (const trisect::CancelledError&) {  // as asked
            }
            other.join();
        }
        EXPECT_EQ(evaluate(formula).to_mesh().points, expected.points);
    }
}

TEST_F(StoppedThreads, LoopsLookAtTheFlagOfTheThreadThatStartsThem) {
    const std::atomic<bool> cancel = true;
    const trisect::StopScope scope(&cancel);
    const trisect::detail::ParallelParts parts(100'000, 4);
    EXPECT_THROW(parts.for_each([](std::size_t, std::size_t, std::size_t) {}),
                 trisect::CancelledError);
}

}  // namespace
