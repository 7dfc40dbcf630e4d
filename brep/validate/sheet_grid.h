// SPDX-License-Identifier: Apache-2.0
//
// Triangles of sheets that come near others: those that a search for contacts has to look at.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// The numbers of all triangles whose boxes may overlap that of a triangle of another sheet;
/// triangles without a sheet (no_sheet) are one each. A coordinate may be off by `error`.
/// Ascending. Those left out have nothing in common with triangles of other sheets. O(n).
[[nodiscard]] std::vector<std::uint32_t> triangles_near_others(
    std::span<const LatticePoint> points, std::span<const std::array<std::uint32_t, 3>> triangles,
    std::span<const std::uint32_t> sheets, double error = 0);

}  // namespace trisect::detail
