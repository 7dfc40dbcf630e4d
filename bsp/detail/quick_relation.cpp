// SPDX-License-Identifier: Apache-2.0
//
// Bodies of a scene are mostly apart or mostly cross, and both can be known from one walk down the
// trees of boxes: a crossing of an edge with a face is Overlapping whatever else there is. So the
// walk goes on past pairs of triangles that doubles cannot tell (parts in one plane have many of
// them) and looks for a crossing; only if there is none, these pairs matter. Where the boundaries
// have no point in common, a shell of one lies wholly on one side of the other's
// boundary; when one of its vertices is outside of the other's bounding box, it is outside. No
// vertex is located in a solid for that.
#include "quick_relation.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include "approximate_map.h"
#include "triangle_filter.h"

namespace trisect::detail {
namespace {

/// Whether certainly every shell has a vertex outside of the bounding box of the other model. The
/// map is from the lattice of the model to that of the other one.
bool shells_are_beyond(const InterferenceModelData& model, const ApproximateMap& map,
                       const InterferenceModelData& other) {
    if (!map.is_usable()) return false;
    const double error = map.error_below(model.largest, model.position_error);
    for (const VertexId v : model.shell_vertex) {
        const std::array<double, 3> p = map(model.position(v));
        bool beyond = false;
        for (std::size_t k = 0; k < 3; ++k)
            beyond = beyond || p[k] - error > other.hi[k] || p[k] + error < other.lo[k];
        if (!beyond) return false;
    }
    return true;
}

}  // namespace

std::optional<Relation> quick_relation(const InterferenceModelData& a, const Pose& pose_a,
                                       const InterferenceModelData& b, const Pose& pose_b,
                                       ObbWalk::Stack& stack) {
    const ApproximateMap map = approximate_map(pose_a, a.brep.lattice(), pose_b, b.brep.lattice());
    if (!map.is_usable()) return std::nullopt;
    bool may_touch = false;
    ObbWalk walk(a.boxed(), b.boxed(), map, stack);
    const bool cross = walk.run([&may_touch](std::uint32_t, std::uint32_t, PairVerdict verdict) {
        may_touch = true;
        return verdict == PairVerdict::Crossing;
    });
    if (cross) return Relation::Overlapping;
    if (may_touch || !shells_are_beyond(b, map, a)) return std::nullopt;
    const ApproximateMap back = approximate_map(pose_b, b.brep.lattice(), pose_a, a.brep.lattice());
    if (!shells_are_beyond(a, back, b)) return std::nullopt;
    return Relation::Disjoint;
}

}  // namespace trisect::detail
