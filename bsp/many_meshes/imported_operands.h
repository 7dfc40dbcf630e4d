// SPDX-License-Identifier: Apache-2.0
//
// Operands that are imported meshes, not divided yet.
#pragma once

#include <vector>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/bsp/divide/cell_task.h>

namespace trisect::detail {

[[nodiscard]] inline const Source& source_of(const SolidState& solid) {
    return *solid.root().node->polygons().whole_source();
}

/// Whether the operand leaves open what is far out of its mesh.
[[nodiscard]] inline bool is_open_far_out(const SolidState& solid,
                                          const Crossings::Operand& operand) {
    return complemented_winding(solid.root().node->winding(), solid.root().complemented) ==
           operand.open;
}

[[nodiscard]] inline std::vector<Box> boxes_of(const SolidStates& solids) {
    std::vector<Box> boxes;
    for (const auto& s : solids) boxes.push_back(source_of(*s).box());
    return boxes;
}

}  // namespace trisect::detail
