// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/sections/section_prism.h>

#include <utility>

#include <trisect/brep/measure.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {
namespace {

/// Where the winding number of the sides is as the rule has it.
Expression region_within(SectionSides found, const EvaluateOptions& options) {
    if (found.sides.empty()) return Solid();
    const Expression positive = flat_prism(found.corners, found.sides, 0, 1);
    if (options.winding == EvaluateOptions::Winding::Positive) return positive;
    for (auto& [from, to] : found.sides) std::swap(from, to);
    return positive | flat_prism(found.corners, found.sides, 0, 1);
}

}  // namespace

ExactMesh mesh_of_bounded(const Solid& solid, const EvaluateOptions& options) {
    const int far_out = state_of(solid)->far_out;
    ExactMesh mesh = solid.to_exact_mesh(options.threads);
    // Half-spaces alone decide it only when they have been put together.
    if (far_out == 1 || (far_out < 0 && (mesh.triangles.empty() ? solid.is_whole_space()
                                                                : exact_volume(mesh).sign() < 0)))
        throw UnsupportedError("an unbounded set has no section");
    return mesh;
}

// Both sides have the same faces in the plane, if no face of the solid itself is there.
SectionPrism section_prism(const MeshSection& mesh, const SectionPlane& plane, SliceRule rule,
                           const EvaluateOptions& options) {
    using Place = MeshSection::Place;
    const Place first = rule == SliceRule::Above ? Place::Above : Place::Below;
    SectionSides found = mesh.right(plane, first);
    bool is_exact = found.is_exact;
    const Expression one = region_within(std::move(found), options);
    if (rule != SliceRule::Closed || !mesh.has_face_in(plane))
        return {evaluate(one, options), is_exact};
    found = mesh.right(plane, Place::Above);
    is_exact = is_exact && found.is_exact;
    return {evaluate(one | region_within(std::move(found), options), options), is_exact};
}

}  // namespace trisect::detail
