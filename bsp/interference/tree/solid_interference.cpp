// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/solid_interference.h>

#include <algorithm>

#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/bsp/interference/tree/solid_pair.h>

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
    const detail::SolidBoundary boundary_a(a);
    const detail::SolidBoundary boundary_b(b);
    return detail::relation_of(boundary_a, pose_a, boundary_b, pose_b, options);
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
