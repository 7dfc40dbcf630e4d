// SPDX-License-Identifier: Apache-2.0
//
// Correspondence of triangles of a deformed solid and its predecessor.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/interference/interference_model.h>

namespace trisect::hierarchies {

/// For each triangle of `before` the number of the same one in `after`: of the same face of the
/// same operand (FaceSource; operands in the order of their numbers), in the order of the
/// triangles' numbers where there are several: for a tree it does not matter which of them is
/// which. Nothing if a face has another number of triangles, or is not there. O(n log n).
[[nodiscard]] std::optional<std::vector<std::uint32_t>> same_triangles(
    const InterferenceModel& before, const InterferenceModel& after);

}  // namespace trisect::hierarchies
