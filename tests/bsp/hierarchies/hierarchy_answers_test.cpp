// SPDX-License-Identifier: Apache-2.0
//
// Every structure gives the answers of all pairs in exact arithmetic, on small grids where nearly
// everything coincides.

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/hierarchies/pairs/queries.h>
#include <trisect/bsp/hierarchies/structures.h>
#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/meeting_pairs.h>
#include <trisect/bsp/interference/relation/pair_distance.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/interference_oracle.h"

namespace {

using namespace trisect;
using namespace trisect::hierarchies;

struct Placed {
    InterferenceModel a;
    Pose pose_a;
    InterferenceModel b;
    Pose pose_b;
};

std::vector<FacePair> brute_faces(const Placed& s) {
    const detail::PosedPair poses(s.pose_a, s.a.lattice(), s.pose_b, s.b.lattice());
    detail::TrianglePairTest test(poses);
    std::vector<FacePair> r;
    for (std::uint32_t i = 0; i < s.a.triangle_count(); ++i)
        for (std::uint32_t j = 0; j < s.b.triangle_count(); ++j)
            if (test(posed_triangle(trisect::detail::data_of(s.a), i),
                     posed_triangle(trisect::detail::data_of(s.b), j))
                    .meets())
                r.emplace_back(trisect::detail::data_of(s.a).triangles[i].face,
                               trisect::detail::data_of(s.b).triangles[j].face);
    std::ranges::sort(r);
    r.erase(std::unique(r.begin(), r.end()), r.end());
    return r;
}

ClosestFeatures brute_closest(const Placed& s) {
    ClosestFeatures best;
    bool any = false;
    for (std::uint32_t i = 0; i < s.a.triangle_count(); ++i)
        for (std::uint32_t j = 0; j < s.b.triangle_count(); ++j) {
            const auto c = detail::exact_closest(trisect::detail::data_of(s.a), s.pose_a, i,
                                                 trisect::detail::data_of(s.b), s.pose_b, j);
            if (c.squared.sign() == 0) return {};
            if (any && best.squared < c.squared) continue;
            if (!any || c.squared < best.squared) best = {c.squared, {}};
            any = true;
            for (const auto& f : c.features) {
                const std::pair names{entity_of(trisect::detail::data_of(s.a), i, f.a),
                                      entity_of(trisect::detail::data_of(s.b), j, f.b)};
                if (!best.features || names < *best.features) best.features = names;
            }
        }
    return best;
}

// What all structures must answer.
struct Expected {
    std::vector<FacePair> faces;
    Relation relation;
    std::optional<ExactRational> squared;
    std::optional<ClosestFeatures> closest = {};
};

Expected expected_answers(const Placed& s) {
    return {brute_faces(s), interfere(s.a, s.pose_a, s.b, s.pose_b).relation,
            exact_squared_distance(s.a, s.pose_a, s.b, s.pose_b)};
}

void expect_answers(PairStructure& structure, const Placed& s, const Expected& expected) {
    SCOPED_TRACE(structure.name());
    CostCounters counters;
    structure.place(s.pose_a, s.pose_b, counters);
    EXPECT_EQ(meeting_faces(structure, counters), expected.faces);
    EXPECT_EQ(boundaries_meet(structure, counters), !expected.faces.empty());
    EXPECT_EQ(relation(structure, counters), expected.relation);
    if (!structure.has_doubles()) return;
    const ClosestFeatures found = closest(structure, counters);
    EXPECT_EQ(found.squared, expected.squared);
    EXPECT_EQ(found.features.has_value(), expected.faces.empty());
    if (expected.closest) {
        EXPECT_EQ(found, *expected.closest);
    }
    const DistanceInterval d = distance(structure, counters);
    EXPECT_LE(ExactRational::from_double(d.lower) * ExactRational::from_double(d.lower),
              found.squared);
    EXPECT_GE(ExactRational::from_double(d.upper) * ExactRational::from_double(d.upper),
              found.squared);
}

TEST(HierarchyAnswers, OfRandomScenesOnASmallGridAreThoseOfAllPairs) {
    for (std::uint64_t seed = 1; seed <= 120; ++seed) {
        SCOPED_TRACE(seed);
        reference::Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        const Placed s{InterferenceModel(scene.a.solid()), scene.pose_a,
                       InterferenceModel(scene.b.solid()), scene.pose_b};
        if (s.a.is_empty() || s.b.is_empty()) continue;
        const Expected expected = expected_answers(s);
        for (const StructureInfo& kind : all_structures())
            expect_answers(*make_structure(kind.kind, s.a, s.b), s, expected);
    }
}

TEST(HierarchyAnswers, ClosestFeaturesOfSolidsApartOnASmallGridWithManyTies) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        reference::Random random(seed);
        const InterferenceModel a(engines::solid(reference::random_embedded_solid(random)));
        const InterferenceModel b(engines::solid(reference::random_embedded_solid(random)));
        if (a.is_empty() || b.is_empty() || a.triangle_count() * b.triangle_count() > 4000)
            continue;
        const auto far = [&random] { return static_cast<double>(random.between(-12, 12)); };
        const Placed s{a, Pose(), b, Pose::from_translation({20, far(), far()})};
        Expected expected = expected_answers(s);
        expected.closest = brute_closest(s);
        for (const StructureInfo& kind : all_structures())
            expect_answers(*make_structure(kind.kind, a, b), s, expected);
    }
}

TEST(HierarchyAnswers, OfOneStructurePlacedAgainAndAgain) {
    const InterferenceModel torus(Solid::from_mesh(make_torus(4, 1, 12, 8)));
    reference::Random random(7);
    for (const StructureInfo& kind : all_structures()) {
        const auto structure = make_structure(kind.kind, torus, torus);
        for (int i = 0; i < 12; ++i) {
            const auto some = [&random](int most) { return random.between(-most, most); };
            const Pose pose = Pose::from_quaternion(
                {5, some(4), some(4), some(4)},
                {static_cast<double>(some(5)), static_cast<double>(some(5)), 0});
            const Placed s{torus, Pose(), torus, pose};
            expect_answers(*structure, s, expected_answers(s));
        }
    }
}

}  // namespace
