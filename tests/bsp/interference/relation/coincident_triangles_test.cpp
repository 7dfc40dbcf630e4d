// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/relation/coincident_triangles.h>

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/quick_relation.h>

#include "reference/random_solids.h"

namespace {

using reference::Random;
using trisect::Expression;
using trisect::interfere;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;
using trisect::detail::CoincidentTriangles;
using trisect::detail::MeetingCollector;
using trisect::detail::PosedModels;
using trisect::detail::PosedPair;

PosedModels posed(const InterferenceModel& a, const Pose& pose_a, const InterferenceModel& b,
                  const Pose& pose_b) {
    return {trisect::detail::data_of(a), trisect::detail::data_of(b),
            PosedPair(pose_a, a.lattice(), pose_b, b.lattice())};
}

std::size_t coincident(const PosedModels& models) {
    const CoincidentTriangles triangles(models);
    std::size_t n = 0;
    for (std::uint32_t i = 0; i < models.a.triangles.size(); ++i)
        if (triangles.partner_of_a(i) != CoincidentTriangles::none) {
            EXPECT_EQ(triangles.partner_of_b(triangles.partner_of_a(i)), i);
            ++n;
        }
    return n;
}

Relation relation_by_coincidence(const PosedModels& models) {
    MeetingCollector collect(models, false);
    const CoincidentTriangles triangles(models);
    triangles.add_flags(collect.flags);
    triangles.for_other_candidates(collect);
    triangles.add_pairs(collect.pairs);
    add_flags_at_contacts(models, collect.pairs, collect.flags);
    add_flags_of_shells(models, collect.pairs, collect.flags);
    return collect.flags.relation();
}

// With all contacts all pairs of triangles are compared.
Relation relation_by_all_pairs(const InterferenceModel& a, const Pose& pose_a,
                               const InterferenceModel& b, const Pose& pose_b) {
    return interfere(a, pose_a, b, pose_b, {.contacts = true}).relation;
}

// Between a rough surface over a grid and a floor or a ceiling.
constexpr std::size_t side = 4;
using Heights = std::array<std::array<int, side>, side>;

InterferenceModel body(const Heights& heights, double other) {
    trisect::PolygonMesh mesh;
    for (const bool is_other : {false, true})
        for (std::size_t x = 0; x < side; ++x)
            for (std::size_t y = 0; y < side; ++y)
                mesh.points.push_back({static_cast<double>(x), static_cast<double>(y),
                                       is_other ? other : static_cast<double>(heights[x][y])});
    const bool is_floor = other < 0;
    const auto add = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) {
        is_floor ? mesh.add_triangle(p, q, r) : mesh.add_triangle(p, r, q);
    };
    const auto at = [](std::size_t x, std::size_t y, bool is_other) {
        return static_cast<std::uint32_t>((is_other ? side * side : 0) + side * x + y);
    };
    for (std::size_t x = 0; x + 1 < side; ++x)
        for (std::size_t y = 0; y + 1 < side; ++y) {
            add(at(x, y, false), at(x + 1, y, false), at(x + 1, y + 1, false));
            add(at(x, y, false), at(x + 1, y + 1, false), at(x, y + 1, false));
            add(at(x, y, true), at(x + 1, y + 1, true), at(x + 1, y, true));
            add(at(x, y, true), at(x, y + 1, true), at(x + 1, y + 1, true));
        }
    const auto wall = [&](std::size_t x, std::size_t y, std::size_t u, std::size_t v) {
        add(at(x, y, true), at(u, v, true), at(u, v, false));
        add(at(x, y, true), at(u, v, false), at(x, y, false));
    };
    for (std::size_t i = 0; i + 1 < side; ++i) {
        wall(i, 0, i + 1, 0);
        wall(side - 1, i, side - 1, i + 1);
        wall(i + 1, side - 1, i, side - 1);
        wall(0, i + 1, 0, i);
    }
    return InterferenceModel(Solid::from_mesh(mesh));
}

TEST(CoincidentTriangles, OfRoughSurfacesThatFallTogetherInParts) {
    Random random(91);
    std::map<Relation, int> seen;
    std::size_t partners = 0;
    for (int n = 0; n < 400; ++n) {
        Heights low{};
        for (auto& row : low)
            for (int& h : row) h = static_cast<int>(random.between(0, 3));
        Heights high = low;
        const bool raise = random.chance(1, 2);
        for (auto& row : high)
            for (int& h : row)
                if (random.chance(1, 6)) h += static_cast<int>(random.between(raise ? 0 : -1, 1));
        const InterferenceModel a = body(low, -2);
        const InterferenceModel b = body(high, random.chance(1, 2) ? -2 : 6);
        const Pose pose = random.chance(1, 2)
                              ? Pose()
                              : Pose::from_quaternion({3, random.between(-2, 2), 1, -2}, {1, 2, 3});
        const PosedModels models = posed(a, pose, b, pose);
        const Relation expected = relation_by_all_pairs(a, pose, b, pose);
        ASSERT_EQ(relation_by_coincidence(models), expected) << n;
        partners += coincident(models);
        ++seen[expected];
    }
    EXPECT_GT(partners, 2000U);
    for (const Relation r : {Relation::Touching, Relation::Overlapping, Relation::Inside,
                             Relation::Contains, Relation::Equal})
        EXPECT_GT(seen[r], 10) << to_string(r);
}

// Whether interfere() takes the way by coincidence.
bool goes_by_coincidence(const InterferenceModel& a, const InterferenceModel& b, const Pose& pose) {
    trisect::detail::ObbWalk::Stack stack;
    trisect::detail::CandidatePairs candidates;
    const auto quick = trisect::detail::quick_relation(trisect::detail::data_of(a), pose,
                                                       trisect::detail::data_of(b), pose, stack,
                                                       nullptr, &candidates);
    return !quick && !candidates.is_complete && candidates.may_coincide &&
           !trisect::detail::data_of(a).touches_itself() &&
           !trisect::detail::data_of(b).touches_itself();
}

Solid ball() { return Solid::from_mesh(trisect::make_icosphere(2, 3)); }
Solid block(const std::array<double, 3>& lo, const std::array<double, 3>& hi) {
    return Solid::from_mesh(trisect::make_box(lo, hi));
}

// So many that interfere() takes the way by coincidence, for all but few pairs.
TEST(CoincidentTriangles, OfFineBallsTheirMouldsAndPartsOfThem) {
    const Solid cube = block({-3, -3, -3}, {3, 3, 3});
    const Solid corner = block({1, 1, 0.5}, {2.5, 2.5, 2});
    const Solid dent = block({-0.25, -0.25, 1.5}, {0.25, 0.25, 2.5});
    const Solid core = Solid::from_mesh(trisect::make_icosphere(1, 1));
    const std::vector<InterferenceModel> models{
        InterferenceModel(ball()),
        InterferenceModel(ball()),
        InterferenceModel(evaluate(Expression(cube) - ball())),
        InterferenceModel(evaluate(Expression(ball()) | corner)),
        InterferenceModel(evaluate(Expression(ball()) - dent)),
        InterferenceModel(evaluate(Expression(ball()) - core)),
        InterferenceModel(evaluate((Expression(cube) - ball()) | core))};
    const std::vector<Pose> poses{
        Pose(), Pose::from_doubles({0.8, 0, 0.6, 0.1, 0, 1, 0, 0.2, -0.6, 0, 0.8, 0.3}),
        Pose::from_quaternion({5, 1, 2, 3}, {1, 2, 3})};
    std::map<Relation, int> seen;
    int by_coincidence = 0;
    for (std::size_t i = 0; i < models.size(); ++i)
        for (std::size_t j = 0; j < models.size(); ++j) {
            if (i == j) continue;
            const Pose& pose = poses[(i + j) % poses.size()];
            const Relation r = interfere(models[i], pose, models[j], pose).relation;
            EXPECT_EQ(r, relation_by_all_pairs(models[i], pose, models[j], pose)) << i << " " << j;
            EXPECT_EQ(r, relation_by_coincidence(posed(models[i], pose, models[j], pose)))
                << i << " " << j;
            EXPECT_GT(coincident(posed(models[i], pose, models[j], pose)), 1000U);
            by_coincidence += goes_by_coincidence(models[i], models[j], pose) ? 1 : 0;
            ++seen[r];
        }
    EXPECT_GT(by_coincidence, 30);
    for (const Relation r : {Relation::Touching, Relation::Overlapping, Relation::Inside,
                             Relation::Contains, Relation::Equal})
        EXPECT_GT(seen[r], 1) << to_string(r);
}

// An icosphere is its own mirror image, and falls together with itself in many turns.
TEST(CoincidentTriangles, OfABallAndItsMirrorImage) {
    const InterferenceModel one(ball());
    const InterferenceModel other(ball());
    const Pose mirror = Pose::from_doubles({-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
    const Pose half_turn = Pose::from_quaternion({0, 0, 0, 1}, {0, 0, 0});
    for (const Pose& pose : {mirror, half_turn}) {
        const PosedModels models = posed(one, Pose(), other, pose);
        EXPECT_EQ(coincident(models), one.triangle_count());
        EXPECT_EQ(interfere(one, Pose(), other, pose).relation, Relation::Equal);
        EXPECT_EQ(relation_by_coincidence(models), Relation::Equal);
    }
    // Next to itself nothing falls together.
    const Pose near = Pose::from_translation({0x1p-20, 0, 0});
    EXPECT_EQ(coincident(posed(one, Pose(), other, near)), 0U);
    EXPECT_EQ(interfere(one, Pose(), other, near).relation, Relation::Overlapping);
}

}  // namespace
