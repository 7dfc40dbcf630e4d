// SPDX-License-Identifier: Apache-2.0

#include "solid_interference_oracle.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference_query.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/solid_transform.h>

#include "engines/engines.h"

namespace brute {

namespace {

using trisect::Contact;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::interfere;
using trisect::InterferenceModel;
using trisect::NamedContact;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;

EvaluateOptions in_cells_of(std::uint32_t leaf_polygons) {
    EvaluateOptions options;
    options.leaf_polygons = leaf_polygons;
    return options;
}

using ContactKind = std::tuple<int, int, int, bool>;

std::set<ContactKind> contact_kinds(const std::vector<Contact>& contacts) {
    std::set<ContactKind> out;
    for (const Contact& c : contacts)
        out.emplace(static_cast<int>(c.a.kind()), static_cast<int>(c.b.kind()), c.dimension,
                    c.opposite);
    return out;
}

std::set<ContactKind> contact_kinds(const std::vector<NamedContact>& contacts) {
    std::set<ContactKind> out;
    for (const NamedContact& c : contacts)
        out.emplace(static_cast<int>(c.a.kind), static_cast<int>(c.b.kind), c.dimension,
                    c.opposite);
    return out;
}

std::string text_of(const char* what, const ContactKind& k) {
    return std::string(what) + ' ' + std::to_string(std::get<0>(k)) + ' ' +
           std::to_string(std::get<1>(k)) + " of dimension " + std::to_string(std::get<2>(k)) +
           '\n';
}

// Faces of operands in one plane form one face of a B-rep: what an entity has in common with it is
// found under each of their names, with some perhaps a smaller part.
std::string difference_of_kinds(const std::set<ContactKind>& found,
                                const std::set<ContactKind>& expected) {
    std::string out;
    for (const ContactKind& k : expected)
        if (!found.contains(k)) out += text_of("missing", k);
    for (const ContactKind& k : found) {
        const bool has_larger = std::ranges::any_of(expected, [&k](const ContactKind& e) {
            return std::get<0>(e) == std::get<0>(k) && std::get<1>(e) == std::get<1>(k) &&
                   std::get<2>(e) >= std::get<2>(k);
        });
        if (!has_larger) out += text_of("found", k);
    }
    return out;
}

bool meets_itself(const InterferenceModel& model) {
    return trisect::detail::data_of(model).touches_itself();
}

std::string other_relation(const char* what, Relation found, Relation expected) {
    if (found == expected) return {};
    return std::string(what) + to_string(found) + " instead of " + to_string(expected) + '\n';
}

Relation seen_from_b(Relation r) {
    return r == Relation::Inside     ? Relation::Contains
           : r == Relation::Contains ? Relation::Inside
                                     : r;
}

}  // namespace

Solid solid_of(const Body& body, std::uint32_t leaf_polygons) {
    std::vector<Solid> solids;
    for (const auto& operand : body.operands) solids.push_back(engines::solid(operand));
    return evaluate(engines::formula(body.formula, solids), in_cells_of(leaf_polygons));
}

std::string difference_of_solids(const Scene& scene, std::uint32_t leaf_polygons,
                                 Relation* relation) {
    const Solid a = solid_of(scene.a, leaf_polygons);
    const Solid b = solid_of(scene.b, leaf_polygons);
    const InterferenceModel model_a(a);
    const InterferenceModel model_b(b);
    const auto expected =
        interfere(model_a, scene.pose_a, model_b, scene.pose_b, {.contacts = true});
    const auto found = interfere(a, scene.pose_a, b, scene.pose_b, {.contacts = true});
    std::string out = other_relation("with contacts ", found.relation, expected.relation);
    out += other_relation("without contacts ", interfere(a, scene.pose_a, b, scene.pose_b).relation,
                          expected.relation);
    out += other_relation("of B to A ", interfere(b, scene.pose_b, a, scene.pose_a).relation,
                          seen_from_b(expected.relation));
    // Where a boundary touches itself, entities of a B-rep are not those of the set.
    if (!meets_itself(model_a) && !meets_itself(model_b))
        out += difference_of_kinds(contact_kinds(found.contacts), contact_kinds(expected.contacts));
    if (relation != nullptr) *relation = expected.relation;
    return out;
}

std::string difference_along_cuts(const Scene& scene, std::uint32_t leaf_polygons,
                                  reference::Random& random, int cuts) {
    Solid a = solid_of(scene.a, leaf_polygons);
    const Solid b = solid_of(scene.b, leaf_polygons);
    if (a.is_empty() || b.is_empty()) return {};
    const InterferenceModel model_b(b);
    trisect::InterferenceQuery query(a, b);
    std::string out;
    for (int i = 0; i < cuts && out.empty(); ++i) {
        trisect::Point3d by{};
        for (double& c : by) c = static_cast<double>(random.below(5)) - 2;
        const Solid tool = transformed(b, Pose::from_translation(by));
        a = evaluate(Expression(a) - Expression(tool), in_cells_of(leaf_polygons));
        query.replace_a(a);
        const Relation expected =
            interfere(InterferenceModel(a), scene.pose_a, model_b, scene.pose_b).relation;
        out += other_relation("after a cut ", interfere(a, scene.pose_a, b, scene.pose_b).relation,
                              expected);
        out +=
            other_relation("by the query ", query.relation(scene.pose_a, scene.pose_b), expected);
    }
    return out;
}

}  // namespace brute
