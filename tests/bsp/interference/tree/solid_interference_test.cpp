// SPDX-License-Identifier: Apache-2.0
//
// Interference of solids on their own trees against that of models, which are made of B-reps.

#include <trisect/bsp/interference/solid_interference.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

#include "engines/engines.h"
#include "support/interference_oracle.h"

namespace {

using trisect::Contact;
using trisect::EntityName;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::InterferenceModel;
using trisect::NamedContact;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;

// In cells of so few polygons, resolved.
Solid solid_of(const brute::Body& body, std::uint32_t leaf_polygons) {
    std::vector<Solid> solids;
    for (const auto& operand : body.operands) solids.push_back(engines::solid(operand));
    EvaluateOptions options;
    options.leaf_polygons = leaf_polygons;
    return evaluate(engines::formula(body.formula, solids), options);
}

using Kind = std::tuple<int, int, int, bool>;

std::set<Kind> kinds_of(const std::vector<Contact>& contacts) {
    std::set<Kind> out;
    for (const Contact& c : contacts)
        out.emplace(static_cast<int>(c.a.kind()), static_cast<int>(c.b.kind()), c.dimension,
                    c.opposite);
    return out;
}

std::set<Kind> kinds_of(const std::vector<NamedContact>& contacts) {
    std::set<Kind> out;
    for (const NamedContact& c : contacts)
        out.emplace(static_cast<int>(c.a.kind), static_cast<int>(c.b.kind), c.dimension,
                    c.opposite);
    return out;
}

// Faces of operands in one plane form one face of a B-rep: what an entity has in common with it is
// found under each of their names, with some perhaps a smaller part.
std::string difference(const std::set<Kind>& found, const std::set<Kind>& expected) {
    std::string out;
    const auto print = [&out](const char* what, const Kind& k) {
        out += std::string(what) + ' ' + std::to_string(std::get<0>(k)) + ' ' +
               std::to_string(std::get<1>(k)) + " of dimension " + std::to_string(std::get<2>(k)) +
               '\n';
    };
    for (const Kind& k : expected)
        if (!found.contains(k)) print("missing", k);
    for (const Kind& k : found) {
        const bool has_larger = std::ranges::any_of(expected, [&k](const Kind& e) {
            return std::get<0>(e) == std::get<0>(k) && std::get<1>(e) == std::get<1>(k) &&
                   std::get<2>(e) >= std::get<2>(k);
        });
        if (!has_larger) print("found", k);
    }
    return out;
}

bool touches_itself(const Solid& solid) {
    return trisect::detail::data_of(InterferenceModel(solid)).touches_itself();
}

TEST(SolidInterference, OfRandomScenesIsThatOfModels) {
    std::map<Relation, int> seen;
    for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
        reference::Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        const auto few = static_cast<std::uint32_t>(1 + seed % 7);
        const Solid a = solid_of(scene.a, few);
        const Solid b = solid_of(scene.b, few);
        const auto expected = interfere(InterferenceModel(a), scene.pose_a, InterferenceModel(b),
                                        scene.pose_b, {.contacts = true});
        const auto quick = interfere(a, scene.pose_a, b, scene.pose_b);
        ASSERT_EQ(quick.relation, expected.relation)
            << "seed " << seed << ": " << to_string(quick.relation) << " instead of "
            << to_string(expected.relation);
        const auto found = interfere(a, scene.pose_a, b, scene.pose_b, {.contacts = true});
        ASSERT_EQ(found.relation, expected.relation) << "seed " << seed << ", with contacts";
        // Where a boundary touches itself, entities of a B-rep are not those of the set.
        if (!touches_itself(a) && !touches_itself(b)) {
            EXPECT_EQ(difference(kinds_of(found.contacts), kinds_of(expected.contacts)), "")
                << "seed " << seed;
        }
        ++seen[found.relation];
    }
    for (const Relation r : {Relation::Disjoint, Relation::Touching, Relation::Overlapping,
                             Relation::Inside, Relation::Contains, Relation::Equal})
        EXPECT_GT(seen[r], 10) << to_string(r);
}

}  // namespace
