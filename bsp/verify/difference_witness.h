// SPDX-License-Identifier: Apache-2.0
//
// Witness point for the difference of two sets, judged by definition.
#pragma once

#include <optional>
#include <span>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure/grid_distance.h>
#include <trisect/bsp/verify.h>
#include <trisect/bsp/verify/difference_radius.h>

namespace trisect::detail {

struct WitnessQuestion {
    BooleanOperation operation;
    const VerifyOptions& options;
    Lattice lattice;
    std::span<const ImportedMesh> meshes;  ///< the operands and RESULT
    std::span<const Solid> solids;         ///< the same
    const GridTriangles& exact;            ///< boundary of the exact result
    const GridTriangles& result;           ///< faces of RESULT
    std::span<const double> moved;         ///< of each mesh, in the user's units
};

/// Near the farthest vertex that was found. Nothing when no point could be separated from the
/// boundary, or none is farther than options.within. \throw Error (Internal) when the point is in
/// both sets or in neither.
[[nodiscard]] std::optional<Witness> find_witness(const WitnessQuestion& question,
                                                  const DifferenceRadius& radius);

}  // namespace trisect::detail
