// SPDX-License-Identifier: Apache-2.0
//
// Shared operands read by several threads at once, each evaluating formulas of its own. Also run
// under the thread sanitizer.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/diagnostics.h>

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

using trisect::Expression;
using trisect::PolygonMesh;

// The mesh of a formula of meshes, each made on so many threads.
template <class Formula>
PolygonMesh mesh_on(std::uint32_t threads, const std::vector<PolygonMesh>& meshes,
                    const Formula& formula) {
    const trisect::SolidOptions import{.import = {.threads = threads}};
    trisect::EvaluateOptions options;
    options.threads = threads;
    std::vector<Solid> solids;
    for (const PolygonMesh& m : meshes) solids.push_back(Solid::from_mesh(m, import));
    return evaluate(formula(solids), options).to_mesh(threads);
}

// Returns the mesh, for what has to be true of it.
template <class Formula>
PolygonMesh expect_the_same_on_any_number(const std::vector<PolygonMesh>& meshes,
                                          const Formula& formula) {
    PolygonMesh alone = mesh_on(1, meshes, formula);
    for (const std::uint32_t threads : {0U, 2U, 8U}) {
        const PolygonMesh mesh = mesh_on(threads, meshes, formula);
        EXPECT_EQ(mesh.points, alone.points) << threads;
        EXPECT_EQ(mesh.corners, alone.corners) << threads;
        EXPECT_EQ(mesh.face_begin, alone.face_begin) << threads;
    }
    return alone;
}

// Large enough for parts of their own in import and in to_mesh().
TEST(Threads, MeshesDoNotDependOnTheirNumber) {
    const PolygonMesh mesh = expect_the_same_on_any_number(
        {trisect::make_icosphere(1, 6), trisect::make_box({0, 0, 0.1}, {2, 2, 2})},
        [](const auto& s) { return s[0] - s[1]; });
    EXPECT_GT(mesh.face_count(), 70000U);
}

// A ball of 82,000 facets.
PolygonMesh ball_at(double x, double y, double z) {
    PolygonMesh out = trisect::make_icosphere(1, 6);
    for (auto& p : out.points) p = {p[0] + x, p[1] + y, p[2] + z};
    return out;
}

// Two of three meshes have more than 2^15 facets near each other: these are listed by cells of a
// grid, which threads solve (bsp/many_meshes/crossed_facets.cpp).
TEST(Threads, ManyLargeMeshesDoNotDependOnTheirNumber) {
    const PolygonMesh mesh = expect_the_same_on_any_number(
        {ball_at(0, 0, 0), ball_at(0.11, 0.07, 0.05), ball_at(-0.06, 0.13, -0.09)},
        [](const auto& s) { return s[0] | s[1] | s[2]; });
    EXPECT_GT(mesh.face_count(), 82000U);
}

// Balls that fill one place: the last two unions of halves have more than 4,096 facets near each
// other, and 1,024 pairs that cross, which threads find (bsp/many_meshes/common_part.cpp).
TEST(Threads, DenseMeshesDoNotDependOnTheirNumber) {
    std::vector<PolygonMesh> balls;
    const auto place = [](int i, double step) { return 1.7 * std::fmod(step * (i + 1), 1.0); };
    for (int i = 0; i < 56; ++i) {
        balls.push_back(trisect::make_icosphere(0.6 + 0.01 * (i % 7), 3));
        for (auto& p : balls.back().points)
            p = {p[0] + place(i, 0.8192), p[1] + place(i, 0.6710), p[2] + place(i, 0.5497)};
    }
    const PolygonMesh mesh = expect_the_same_on_any_number(balls, [](const auto& s) {
        Expression all = s[0];
        for (std::size_t i = 1; i < s.size(); ++i) all = all | s[i];
        return all;
    });
    EXPECT_GT(mesh.face_count(), 9000U);
}

// Steps of a chain have work for two threads, though no more than twenty leaves each.
TEST(Threads, ChainsDoNotDependOnTheirNumber) {
    const auto chain = [](std::uint32_t threads) {
        trisect::EvaluateOptions options;
        options.threads = threads;
        Solid part = Solid::from_mesh(trisect::make_icosphere(1, 5));
        for (int i = 0; i < 12; ++i) {
            PolygonMesh tool = trisect::make_icosphere(0.2, 2);
            for (auto& p : tool.points)
                p = {p[0] + std::cos(0.3 * i), p[1] + std::sin(0.3 * i), p[2] + 0.03 * i};
            part = evaluate(part - Expression(Solid::from_mesh(tool)), options);
        }
        return part.to_mesh(threads);
    };
    const PolygonMesh alone = chain(1);
    for (const std::uint32_t threads : {2U, 3U, 8U}) {
        const PolygonMesh mesh = chain(threads);
        EXPECT_EQ(mesh.points, alone.points) << threads;
        EXPECT_EQ(mesh.corners, alone.corners) << threads;
    }
}

// Prisms of eight sides on a grid, each turned otherwise; its outer rows reach out of a plate.
PolygonMesh pockets(int n) {
    constexpr std::uint32_t sides = 8;
    PolygonMesh out;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const auto first = static_cast<std::uint32_t>(out.points.size());
            for (const double z : {0.5, 2.0})
                for (std::uint32_t k = 0; k < sides; ++k) {
                    const double angle = 0.3 * i + 0.7 * j + 0.25 * std::numbers::pi * k;
                    out.points.push_back({i + 0.4 * std::cos(angle), j + 0.4 * std::sin(angle), z});
                }
            for (std::uint32_t k = 0; k < sides; ++k) {
                const std::uint32_t a = first + k;
                const std::uint32_t b = first + (k + 1) % sides;
                out.add_triangle(a, b, b + sides);
                out.add_triangle(a, b + sides, a + sides);
                if (k < 2) continue;
                out.add_triangle(first, a, a - 1);
                out.add_triangle(first + sides, a - 1 + sides, a + sides);
            }
        }
    return out;
}

// Many enough for several parts of the search for crossings, of the walk and of the caps.
TEST(Threads, PrismsDoNotDependOnTheirNumber) {
    constexpr int n = 38;
    const trisect::Diagnostics<trisect::EvaluateCounters> diagnostics;
    const PolygonMesh mesh = expect_the_same_on_any_number(
        {trisect::make_box({0.05, 0.03, 0}, {n - 1.1, n - 1.02, 1}), pockets(n),
         trisect::make_box({3.31, -1, 0.25}, {3.37, 5.2, 3})},
        [](const auto& s) { return s[0] - s[1] - s[2]; });
    EXPECT_GT(mesh.face_count(), 40000U);
    EXPECT_EQ(diagnostics.counters().prism_leaves, 4U);  // once for each number
}

// Square bars along an axis through a cube of side 27, as of a sponge of level three.
PolygonMesh bars(int axis) {
    PolygonMesh out;
    const auto add = [&](int u, int v, int size) {
        const auto first = static_cast<std::uint32_t>(out.points.size());
        const PolygonMesh bar =
            trisect::make_box({-1.0, 1.0 * u, 1.0 * v}, {28.0, 1.0 * (u + size), 1.0 * (v + size)});
        for (const trisect::Point3d& p : bar.points) {
            trisect::Point3d turned{};
            for (std::size_t k = 0; k < 3; ++k)
                turned[(k + static_cast<std::size_t>(axis)) % 3] = p[k];
            out.points.push_back(turned);
        }
        for (const std::uint32_t c : bar.corners) out.corners.push_back(first + c);
        for (std::size_t f = 0; f < bar.face_count(); ++f)
            out.face_begin.push_back(out.face_begin.back() + 4);
    };
    for (int size = 9; size >= 1; size /= 3)
        for (int u = size; u < 27; u += 3 * size)
            for (int v = size; v < 27; v += 3 * size) {
                bool is_in_larger = false;
                for (int larger = 3 * size; larger <= 9; larger *= 3)
                    is_in_larger = is_in_larger || (u / larger % 3 == 1 && v / larger % 3 == 1);
                if (!is_in_larger) add(u, v, size);
            }
    return out;
}

// Outlines of planes across axes.
TEST(Threads, SpongesDoNotDependOnTheirNumber) {
    const PolygonMesh mesh = expect_the_same_on_any_number(
        {trisect::make_box({0, 0, 0}, {27, 27, 27}), bars(0), bars(1), bars(2)},
        [](const auto& s) { return s[0] - s[1] - s[2] - s[3]; });
    EXPECT_EQ(trisect::exact_volume(Solid::from_mesh(mesh).to_brep()).to_string(), "8000");
}

// A mesh that is large enough for several parts, between two planes.
TEST(Threads, SlabsDoNotDependOnTheirNumber) {
    const PolygonMesh mesh =
        expect_the_same_on_any_number({trisect::make_icosphere(1, 6)}, [](const auto& s) {
            return Expression(s[0]) & Solid::half_space({1, 2, 3, -0.4}) &
                   Solid::half_space({-1, -2, -3, -0.3});
        });
    EXPECT_GT(mesh.face_count(), 5000U);
}

}  // namespace
