// SPDX-License-Identifier: Apache-2.0
//
// Parts of a mesh between parallel planes, all in one pass.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>

namespace trisect::detail {

/// A mesh between two planes, below one, or above one.
struct MeshSlab {
    Residual::Ref formula;
    /// The mesh, a half-space of the plane above, and one of the plane below; of the first slab and
    /// the last one there is one half-space.
    SolidStates solids;
};

/// The values of slabs of one mesh, each above the one before, without trees: those that
/// evaluate_between_half_spaces() has of each alone. Linear in the mesh, whatever the number of
/// planes, and in the crossings. Nothing of the slabs beside a plane that goes through a corner,
/// and of those whose planes cut nothing.
/// \pre is_mesh_with_half_spaces() of each; the planes are_ascending()
[[nodiscard]] std::vector<std::optional<UndividedMeshes>> evaluate_slabs(
    std::span<const MeshSlab> slabs, const EvaluateSettings& options, EvaluateStats& stats);

/// The plane of the only facet of a half-space.
[[nodiscard]] Plane plane_of_half_space(const SolidState& state);

}  // namespace trisect::detail
