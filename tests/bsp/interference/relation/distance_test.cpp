// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/boundary_distance.h>

#include <gtest/gtest.h>

#include <cmath>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/interference/relation/distance_search.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/models.h"

namespace distance_test {
namespace {

using reference::Random;
using trisect::are_nearer_than;
using trisect::boundary_distance;
using trisect::exact_squared_distance;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Solid;
using trisect::detail::DistanceSearch;

// The least of all pairs of triangles, in rationals.
ExactRational brute(const InterferenceModel& a, const Pose& pa, const InterferenceModel& b,
                    const Pose& pb) {
    std::optional<ExactRational> least;
    for (std::uint32_t i = 0; i < a.triangle_count(); ++i)
        for (std::uint32_t j = 0; j < b.triangle_count(); ++j) {
            const auto d = trisect::detail::exact_squared_distance(
                trisect::detail::data_of(a), pa, i, trisect::detail::data_of(b), pb, j);
            if (!least || d < *least) least = d;
        }
    return *least;
}

void expect_right(const InterferenceModel& a, const Pose& pa, const InterferenceModel& b,
                  const Pose& pb) {
    const ExactRational exact = brute(a, pa, b, pb);
    EXPECT_EQ(exact_squared_distance(a, pa, b, pb), exact);
    const auto found = boundary_distance(a, pa, b, pb);
    ASSERT_TRUE(found.has_value());
    const auto square = [](double v) {
        return ExactRational::from_double(v) * ExactRational::from_double(v);
    };
    EXPECT_LE(square(found->lower), exact);
    EXPECT_GE(square(found->upper), exact);
    EXPECT_LE(found->upper - found->lower, 1e-9 * (1 + found->upper));
    const double d = std::sqrt(exact.to_double());
    for (const double limit : {0.5 * d, std::nextafter(d, 0.0), d, std::nextafter(d, 1e9), 2 * d})
        EXPECT_EQ(are_nearer_than(a, pa, b, pb, limit), exact < square(limit)) << limit;
    double way = 0;
    for (std::size_t k = 0; k < 3; ++k)
        way += (found->on_a[k] - found->on_b[k]) * (found->on_a[k] - found->on_b[k]);
    if (found->lower > 0) {
        EXPECT_NEAR(std::sqrt(way), found->upper, 1e-9 * (1 + found->upper));
    }
}

TEST(BoundaryDistance, RandomSolidsOnASmallGridAgainstAllPairsInRationals) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        const InterferenceModel a(engines::solid(reference::random_embedded_solid(random)));
        const InterferenceModel b(engines::solid(reference::random_embedded_solid(random)));
        const auto far = [&random] { return static_cast<double>(random.between(-20, 20)); };
        SCOPED_TRACE(seed);
        expect_right(a, Pose(), b, Pose::from_translation({far(), far(), far()}));
        if (seed % 4 == 0)
            expect_right(a, Pose::from_quaternion({3, 1, 0, 1}, {far(), 0, 0}), b,
                         Pose::from_quaternion({1, 0, 2, 0}, {0, far(), far()}));
        // A pose that stretches: distances are those of the world.
        if (seed % 8 == 0)
            expect_right(a, Pose::from_doubles({2, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0.25, far()}), b,
                         Pose::from_translation({far(), far(), far()}));
    }
}

// What is called certainly farther is farther, at limits next to the distance, too.
TEST(TriangleDistance, CertainlyFartherIsNeverWrong) {
    using trisect::detail::are_certainly_farther;
    Random random(61);
    int certain = 0;
    for (int i = 0; i < 4000; ++i) {
        trisect::detail::TriangleCorners p;
        trisect::detail::TriangleCorners q;
        for (auto* t : {&p, &q})
            for (auto& c : *t)
                for (double& v : c)
                    v = static_cast<double>(random.between(0, 12)) + (t == &q ? 6 : 0);
        const auto closest = trisect::detail::closest_points(p, q);
        const auto bounds = trisect::detail::certify(p, q, closest, 0);
        // The way of the closest points, any other one, or none.
        std::array<double, 3> first{};
        if (i % 3 == 0) first = trisect::detail::way_between(p, q, closest);
        if (i % 3 == 1)
            for (double& v : first) v = static_cast<double>(random.between(-5, 5));
        for (const double limit : {0.25 * bounds.upper, 0.9 * bounds.upper, bounds.lower,
                                   std::nextafter(bounds.upper, 1e9), 2 * bounds.upper}) {
            if (!are_certainly_farther(p, q, limit, 0, first)) continue;
            ++certain;
            EXPECT_LT(limit, bounds.upper);
        }
    }
    EXPECT_GT(certain, 2000);
}

TEST(BoundaryDistance, FeaturesOfBoxesAreNamed) {
    const InterferenceModel a = models::box(0, 0, 0, 1, 1, 1);
    const auto corner = boundary_distance(a, Pose(), a, Pose::from_translation({2, 2, 2}));
    EXPECT_TRUE(corner->a.is_vertex() && corner->b.is_vertex());
    const auto edge = boundary_distance(a, Pose(), a, Pose::from_translation({2, 2, 0.25}));
    EXPECT_FALSE(edge->a.is_face() && edge->b.is_face());
    const auto face = boundary_distance(models::box(0, 0, 0, 4, 4, 1), Pose(), a,
                                        Pose::from_quaternion({100, 50, 31, 7}, {2, 2, 3}));
    EXPECT_TRUE(face->a.is_face() && face->b.is_vertex());
}

TEST(BoundaryDistance, TouchingCrossingNestedAndEmpty) {
    const InterferenceModel a = models::box(0, 0, 0, 4, 4, 4);
    const InterferenceModel b = models::box(0, 0, 0, 1, 1, 1);
    const auto at = [](double x, double y, double z) { return Pose::from_translation({x, y, z}); };
    EXPECT_EQ(exact_squared_distance(a, Pose(), b, at(4, 1, 1)), ExactRational());
    EXPECT_EQ(boundary_distance(a, Pose(), b, at(4, 1, 1))->lower, 0);
    EXPECT_LE(boundary_distance(a, Pose(), b, at(4, 1, 1))->upper, 1e-12);
    EXPECT_EQ(exact_squared_distance(a, Pose(), b, at(3.5, 1.25, 1.125)), ExactRational());
    EXPECT_TRUE(are_nearer_than(a, Pose(), b, at(4, 1, 1), 1e-300));
    EXPECT_FALSE(are_nearer_than(a, Pose(), b, at(4, 1, 1), 0));
    EXPECT_EQ(exact_squared_distance(a, Pose(), b, at(1, 1, 2)), ExactRational(1));  // inside
    EXPECT_FALSE(are_nearer_than(a, Pose(), b, at(1, 1, 2), 1));
    EXPECT_TRUE(are_nearer_than(a, Pose(), b, at(1, 1, 2), std::nextafter(1, 2)));
    EXPECT_FALSE(boundary_distance(a, Pose(), InterferenceModel(), Pose()).has_value());
    EXPECT_FALSE(are_nearer_than(InterferenceModel(), Pose(), b, Pose(), 5));
    EXPECT_THROW((void)are_nearer_than(a, Pose(), b, Pose(), -1), trisect::UsageError);
    EXPECT_THROW((void)are_nearer_than(a, Pose(), b, Pose(), std::nan("")), trisect::UsageError);
}

TEST(BoundaryDistance, FewBoxesAreOpenedAndFewerFromAStart) {
    const InterferenceModel torus(Solid::from_mesh(trisect::make_torus(1, 0.25, 64, 32)));
    const Pose away = Pose::from_quaternion({10, 1, 2, 3}, {2.75, 0.25, 0.125});
    DistanceSearch search(trisect::detail::data_of(torus), Pose(), trisect::detail::data_of(torus),
                          away);
    search.run();
    EXPECT_GT(search.lower(), 0.1);
    EXPECT_LT(search.upper() - search.lower(), 1e-12);
    const auto fresh = search.counters();
    EXPECT_LT(fresh.triangle_pairs, 400U);
    const auto best = search.candidates().front();
    search.run(std::numeric_limits<double>::infinity(), false, {{best.a, best.b}});
    EXPECT_LE(search.counters().node_tests, 2 * fresh.node_tests);
    EXPECT_EQ(search.candidates().front().a, best.a);
}

}  // namespace
}  // namespace distance_test
