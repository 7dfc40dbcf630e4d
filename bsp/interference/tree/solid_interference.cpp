// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/solid_interference.h>

#include <algorithm>

#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference_model.h>

namespace trisect {

namespace {

EntityName name_of(const BoundaryEntity& entity, const Brep& brep) {
    EntityName name;
    name.kind = entity.is_face()   ? EntityName::Kind::Face
                : entity.is_edge() ? EntityName::Kind::Edge
                                   : EntityName::Kind::Vertex;
    if (entity.is_face()) name.faces[name.face_count++] = brep.source(entity.face());
    return name;
}

}  // namespace

SolidInterference interfere(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b,
                            const SolidInterferenceOptions& options) {
    const InterferenceModel model_a(a);
    const InterferenceModel model_b(b);
    const InterferenceResult r =
        interfere(model_a, pose_a, model_b, pose_b, {.contacts = options.contacts});
    SolidInterference out{r.relation, {}};
    for (const Contact& c : r.contacts)
        out.contacts.push_back({name_of(c.a, model_a.brep()), name_of(c.b, model_b.brep()),
                                c.dimension, c.opposite});
    std::ranges::sort(out.contacts);
    return out;
}

std::optional<NamedDistance> boundary_distance(const Solid& a, const Pose& pose_a, const Solid& b,
                                               const Pose& pose_b) {
    const InterferenceModel model_a(a);
    const InterferenceModel model_b(b);
    const auto d = boundary_distance(model_a, pose_a, model_b, pose_b);
    if (!d) return std::nullopt;
    return NamedDistance{d->lower,
                         d->upper,
                         name_of(d->a, model_a.brep()),
                         name_of(d->b, model_b.brep()),
                         d->on_a,
                         d->on_b};
}

bool are_nearer_than(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b,
                     double distance) {
    return are_nearer_than(InterferenceModel(a), pose_a, InterferenceModel(b), pose_b, distance);
}

}  // namespace trisect
