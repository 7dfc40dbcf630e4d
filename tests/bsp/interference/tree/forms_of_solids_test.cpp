// SPDX-License-Identifier: Apache-2.0
//
// Solids of all forms: complements within trees, half-spaces, results that are evaluated when they
// are first needed, coordinates with fractions, poses beyond doubles, many threads.

#include <trisect/bsp/interference/solid_interference.h>

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_query.h>
#include <trisect/kernel/error.h>

#include "reference/random_solids.h"
#include "support/solids.h"

namespace {

using trisect::evaluate;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::InterferenceModel;
using trisect::InterferenceQuery;
using trisect::Point3d;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;

// Placed on a grid around the origin, where things coincide.
void expect_same_as_models(const Solid& a, const Solid& b, double step, int reach) {
    const InterferenceModel model_a(a);
    const InterferenceModel model_b(b);
    for (int x = -reach; x <= reach; ++x)
        for (int y = -reach; y <= reach; ++y)
            for (int z = -reach; z <= reach; ++z) {
                const Pose pose = Pose::from_translation({step * x, step * y, step * z});
                const Relation expected = interfere(model_a, Pose(), model_b, pose).relation;
                EXPECT_EQ(interfere(a, Pose(), b, pose).relation, expected)
                    << x << ' ' << y << ' ' << z;
                EXPECT_EQ(interfere(a, Pose(), b, pose, {.contacts = true}).relation, expected);
            }
}

TEST(FormsOfSolids, ComplementsWithinTrees) {
    EvaluateOptions options;
    options.leaf_polygons = 5;
    const Solid part = evaluate(
        ~(~(Expression(solids::box(-4, 4)) - Expression(solids::box(-2, -2, -5, 2, 2, 5))) |
          Expression(solids::box(3, 3, 3, 5, 5, 5))),
        options);
    expect_same_as_models(part, solids::box(-1, 1), 1, 4);
    const Solid other = evaluate(~(~Expression(part) & ~Expression(solids::box(-1, 1))), options);
    expect_same_as_models(other, part, 2, 2);
}

TEST(FormsOfSolids, CutByHalfSpaces) {
    EvaluateOptions options;
    options.leaf_polygons = 8;
    Solid part = solids::ball(4, 3);
    for (const std::array<double, 4>& plane :
         {std::array<double, 4>{1, 0, 0, -2}, {0, 1, 1, -3}, {0, 0, 1, -3}, {-1, -1, -1, -4}})
        part = evaluate(Expression(part) & Expression(Solid::half_space(plane)), options);
    expect_same_as_models(part, solids::box(-1, 1), 1, 4);
    EXPECT_THROW((void)interfere(Solid::half_space({1, 0, 0, 0}), Pose(), part, Pose()),
                 trisect::UnsupportedError);
    EXPECT_THROW((void)interfere(evaluate(~Expression(part)), Pose(), part, Pose()),
                 trisect::UnsupportedError);
}

TEST(FormsOfSolids, EmptySolidsAndTheSameOne) {
    const Solid block = solids::box(0, 2);
    EXPECT_EQ(interfere(Solid(), Pose(), block, Pose()).relation, Relation::Disjoint);
    EXPECT_EQ(interfere(block, Pose(), Solid(), Pose()).relation, Relation::Disjoint);
    EXPECT_FALSE(boundary_distance(Solid(), Pose(), block, Pose()).has_value());
    EXPECT_FALSE(are_nearer_than(Solid(), Pose(), block, Pose(), 1e9));
    EXPECT_EQ(interfere(block, Pose(), block, Pose()).relation, Relation::Equal);
    const Solid fine = solids::ball(1, 4);
    EXPECT_EQ(interfere(fine, Pose(), fine, Pose()).relation, Relation::Equal);
}

TEST(FormsOfSolids, ResultsThatAreNotYetEvaluated) {
    const Solid a = solids::ball(2, 5);
    const Solid b = solids::ball(2, 5, {1.1, 0.3, 0.3});
    const Solid cut = evaluate(Expression(a) - Expression(b));
    const Solid probe = solids::ball(0.5, 3);
    for (const double x : {-2.6, -2.0, -1.0, 0.0, 0.5, 1.0}) {
        const Pose pose = Pose::from_translation({x, 0.1, 0.2});
        EXPECT_EQ(
            interfere(cut, Pose(), probe, pose).relation,
            interfere(InterferenceModel(cut), Pose(), InterferenceModel(probe), pose).relation);
    }
}

TEST(FormsOfSolids, FractionsOfCoordinates) {
    // Fine digits beside large numbers: the tool moves to the stock's unit with bits behind it.
    const Solid stock = evaluate(Expression(solids::box(0, 1024)) -
                                 Expression(solids::box(100.1, 100.1, 100.1, 200.3, 200.3, 2000)));
    const Solid tool = solids::ball(50.05, 3, {}, 0x1p-60);
    const InterferenceModel model(stock);
    const InterferenceModel model_of_tool(tool);
    for (const double z : {100.1, 150.2, 900.0, 1074.0, 1075.0})
        for (const double x : {150.2, 149.95, 300.0}) {
            const Pose pose = Pose::from_translation({x, 150.2, z});
            EXPECT_EQ(interfere(stock, Pose(), tool, pose).relation,
                      interfere(model, Pose(), model_of_tool, pose).relation)
                << x << ' ' << z;
            EXPECT_EQ(exact_squared_distance(stock, Pose(), tool, pose),
                      exact_squared_distance(model, Pose(), model_of_tool, pose));
        }
}

// A version just cut, from several threads: its leaves get their boxes meanwhile.
TEST(FormsOfSolids, OneVersionAndManyThreads) {
    Solid stock = solids::ball(1, 5);
    stock.refine();
    const Solid tool = solids::ball(0.2, 3);
    for (int round = 0; round < 4; ++round) {
        const double a = 0.7 * round;
        const Point3d at{std::cos(a), std::sin(a), 0};
        stock = evaluate(Expression(stock) - Expression(solids::ball(0.1, 2, at)));
        constexpr int count = 24;
        const auto pose_of = [&](int i) {
            const double out = 1.1 + 0.01 * i;
            return Pose::from_translation({at[0] * out, at[1] * out, 0.01 * i});
        };
        std::array<std::atomic<int>, count> found{};
        std::vector<std::thread> threads;
        for (int t = 0; t < 4; ++t)
            threads.emplace_back([&] {
                for (int i = 0; i < count; ++i)
                    found[static_cast<std::size_t>(i)] +=
                        static_cast<int>(interfere(stock, Pose(), tool, pose_of(i)).relation);
            });
        for (std::thread& t : threads) t.join();
        const InterferenceModel model(stock);
        const InterferenceModel model_of_tool(tool);
        for (int i = 0; i < count; ++i)
            EXPECT_EQ(
                found[static_cast<std::size_t>(i)],
                4 * static_cast<int>(interfere(model, Pose(), model_of_tool, pose_of(i)).relation));
    }
}

}  // namespace
