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

/// What a slab has of the mesh.
struct SlabValue {
    /// Nothing where it is not known: beside a plane that goes through a corner, and where no plane
    /// cuts any of several shells.
    std::optional<UndividedMeshes> part;
    bool is_all = false;  ///< the slab has the whole mesh; then there is no part
    bool is_none = false;
};

/// The values of slabs of one mesh, each above the one before, without trees: those that
/// evaluate_between_half_spaces() has of each alone. Linear in the mesh, whatever the number of
/// planes, and in the crossings.
/// \pre is_mesh_with_half_spaces() of each; the planes are_ascending()
[[nodiscard]] std::vector<SlabValue> evaluate_slabs(std::span<const MeshSlab> slabs,
                                                    const EvaluateSettings& options,
                                                    EvaluateStats& stats);

/// The plane of the only facet of a half-space.
[[nodiscard]] Plane plane_of_half_space(const SolidState& state);

}  // namespace trisect::detail
