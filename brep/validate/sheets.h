// SPDX-License-Identifier: Apache-2.0
//
// Sheets: height-field patches of a surface, free of self-intersection.
// One linear pass proves that.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

struct PreparedMesh;
class Twins;

inline constexpr std::uint32_t no_sheet = std::numeric_limits<std::uint32_t>::max();

/// By triangle the number of its sheet, or no_sheet. Two triangles of one sheet have nothing in
/// common but the corners and edges that they share by name; or they are of one face that is planar
/// and is not to be compared with itself. Cost: O(n log n).
[[nodiscard]] std::vector<std::uint32_t> find_sheets(const PreparedMesh& mesh);

/// The same for a manifold of which every triangle is a face; nothing if a triangle has no area.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> find_sheets(
    std::span<const LatticePoint> points, std::span<const std::array<std::uint32_t, 3>> triangles,
    const Twins& twins);

}  // namespace trisect::detail
