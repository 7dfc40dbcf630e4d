// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/level_set/level_set_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>

namespace trisect {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Bounds around{{-1.25, -1.25, -1.25}, {1.25, 1.25, 1.25}};

double volume_of(const PolygonMesh& mesh) {
    return exact_volume(import_mesh(mesh).mesh).to_double();
}

bool is_sound(const PolygonMesh& mesh) {
    return validate(mesh).empty() && is_embedded(import_mesh(mesh).mesh);
}

double ball(const Point3d& p) { return 1 - std::hypot(p[0], p[1], p[2]); }
double ring(const Point3d& p) { return 0.3 - std::hypot(std::hypot(p[0], p[1]) - 0.8, p[2]); }
double gyroid(const Point3d& p) {
    return std::sin(4 * p[0]) * std::cos(4 * p[1]) + std::sin(4 * p[1]) * std::cos(4 * p[2]) +
           std::sin(4 * p[2]) * std::cos(4 * p[0]);
}

TEST(LevelSetMesh, VolumesConvergeWithTheSquareOfTheEdge) {
    const double of_ball = 4 * pi / 3;
    const double of_ring = 2 * pi * 0.8 * pi * 0.09;
    for (const double edge : {0.25, 0.125, 0.0625}) {
        const PolygonMesh a = make_level_set(ball, around, edge);
        const PolygonMesh b = make_level_set(ring, around, edge);
        EXPECT_TRUE(is_sound(a) && is_sound(b));
        EXPECT_NEAR(volume_of(a) / of_ball, 1, 0.4 * edge * edge);
        EXPECT_NEAR(volume_of(b) / of_ring, 1, 4 * edge * edge);
    }
}

TEST(LevelSetMesh, IsCutOffAtTheBox) {
    const auto everywhere = [](const Point3d&) { return 1.0; };
    const Bounds box{{0.1, -3, 1e-3}, {0.7, 5, 0.3}};  // to the last digit
    const PolygonMesh full = make_level_set(everywhere, box, 0.5);
    EXPECT_TRUE(is_sound(full));
    EXPECT_EQ(bounds(full), box);
    const PolygonMesh one = make_level_set(everywhere, box, 100);
    EXPECT_EQ(one.face_count(), 24U);
    // A gyroid has as much inside as outside.
    const PolygonMesh half = make_level_set(gyroid, {{0, 0, 0}, {pi / 2, pi / 2, pi / 2}}, 0.1);
    EXPECT_TRUE(is_sound(half));
    EXPECT_NEAR(volume_of(half), std::pow(pi / 2, 3) / 2, 0.005);
    EXPECT_EQ(make_level_set([](const Point3d&) { return -1.0; }, box, 1).face_count(), 0U);
    EXPECT_EQ(make_level_set([](const Point3d&) { return 0.0; }, box, 1).face_count(), 0U);
}

TEST(LevelSetMesh, LinearFunctionsAreExactToRounding) {
    const auto below = [](const Point3d& p) { return 0.3 - p[0] - p[1] - p[2]; };
    const PolygonMesh mesh = make_level_set(below, {{0, 0, 0}, {1, 1, 1}}, 0.15);
    EXPECT_TRUE(is_sound(mesh));
    EXPECT_NEAR(volume_of(mesh), 0.027 / 6, 1e-12);
    // Through corners of the grid.
    const PolygonMesh flat =
        make_level_set([](const Point3d& p) { return p[2]; }, {{-1, -1, -1}, {1, 1, 1}}, 0.25);
    EXPECT_TRUE(is_sound(flat));
    EXPECT_NEAR(volume_of(flat), 4, 0.02);
}

TEST(LevelSetMesh, LevelsAndRootsMoveTheSurface) {
    LevelSetOptions options;
    options.level = 0.5;
    EXPECT_NEAR(volume_of(make_level_set(ball, around, 0.1, options)), pi / 6, 0.01);
    // Far from linear; its surface is the ball's.
    const auto bent = [](const Point3d& p) { return std::cbrt(ball(p)); };
    const auto error = [&](std::uint32_t steps) {
        LevelSetOptions refined;
        refined.root_steps = steps;
        double worst = 0;
        for (const Point3d& p : make_level_set(bent, around, 0.2, refined).points)
            worst = std::max(worst, std::fabs(ball(p)));
        return worst;
    };
    EXPECT_GT(error(0), 0.02);
    EXPECT_LT(error(12), 1e-3);  // vertices keep away from grid points
}

TEST(LevelSetMesh, ThreadsChangeNothing) {
    LevelSetOptions many;
    many.threads = 4;
    many.root_steps = 2;
    LevelSetOptions one = many;
    one.threads = 1;
    EXPECT_EQ(make_level_set(ring, around, 0.05, many), make_level_set(ring, around, 0.05, one));
}

TEST(LevelSetMesh, NamesWhatIsWrong) {
    const double infinity = std::numeric_limits<double>::infinity();
    const auto with_hole = [&](const Point3d& p) {
        return p == Point3d{0.5, 0.5, 0.5} ? infinity : ball(p);
    };
    try {
        (void)make_level_set(with_hole, {{0, 0, 0}, {1, 1, 1}}, 0.5);
        FAIL();
    } catch (const UsageError& e) {
        EXPECT_NE(std::string(e.what()).find("(0.5, 0.5, 0.5)"), std::string::npos) << e.what();
    }
    const auto make = [](const Bounds& box, double edge) {
        return make_level_set(ball, box, edge);
    };
    EXPECT_THROW((void)make(around, 0), UsageError);
    EXPECT_THROW((void)make(around, std::nan("")), UsageError);
    EXPECT_THROW((void)make({{0, 0, 0}, {1, 0, 1}}, 1), UsageError);
    EXPECT_THROW((void)make({{0, 0, 0}, {1, infinity, 1}}, 1), UsageError);
    EXPECT_THROW((void)make({{0, 0, 0}, {1, std::nan(""), 1}}, 1), UsageError);
    EXPECT_THROW((void)make({{-1e308, 0, 0}, {1e308, 1, 1}}, 1e308), LimitError);
    EXPECT_THROW((void)make(around, 1e-4), LimitError);
    EXPECT_THROW((void)make(around, 1e-300), LimitError);
    EXPECT_THROW((void)make({{1e7, 0, 0}, {1e7 + 1, 1, 1}}, 1), LimitError);
    EXPECT_THROW(
        (void)make_level_set([](const Point3d&) -> double { throw LimitError("mine"); }, around, 1),
        LimitError);
    const StopScope scope({.max_work = 10});
    EXPECT_THROW((void)make(around, 0.1), LimitError);
}

/// Values on a small grid, most of them at the level, whatever the place.
PolygonMesh random_level_set(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto kind = random() % 3;
    const auto n = static_cast<double>(1 + random() % 4);
    const auto value = [&]() -> double {
        const double sign = static_cast<double>(random() % 3) - 1;
        if (kind == 0) return sign;
        if (kind == 1) return sign * (1 + static_cast<double>(random() % 1000) * 1e-3);
        return random() % 4 != 0 ? 0 : sign;
    };
    return make_level_set([&](const Point3d&) { return value(); }, {{0, 0, 0}, {n, n, n + 1}}, 1);
}

void expect_sound(std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t seed = first; seed < first + count; ++seed) {
        const PolygonMesh mesh = random_level_set(seed);
        ASSERT_TRUE(mesh.face_count() == 0 || is_sound(mesh)) << seed;
    }
}

TEST(LevelSetMesh, RandomGrids) { expect_sound(0, 200); }
TEST(LevelSetMesh, ThousandsOfRandomGrids) { expect_sound(1000, 10'000); }

// As far from the origin as the proof reaches.
TEST(LevelSetMesh, RandomGridsFarAway) {
    std::mt19937 random(5);
    const double far = 0x1p20 - 4;
    for (int i = 0; i < 100; ++i) {
        const auto value = [&](const Point3d&) { return static_cast<double>(random() % 3) - 1; };
        const Bounds box{{far + 0.1, -far - 3.1, far + 0.3}, {far + 3.2, -far, far + 3.6}};
        const PolygonMesh mesh = make_level_set(value, box, 1.2);
        ASSERT_TRUE(mesh.face_count() == 0 || is_sound(mesh)) << i;
    }
}

}  // namespace
}  // namespace trisect
