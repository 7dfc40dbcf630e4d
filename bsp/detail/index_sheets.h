// SPDX-License-Identifier: Apache-2.0
//
// Which planes of a leaf have all of its polygons on one side?
#pragma once

#include <cstdint>
#include <optional>

#include <trisect/bsp/detail/index_core.h>

namespace trisect::detail {

/// A plane of a leaf *bounds it from above* when no polygon of the leaf reaches above it: then
/// whatever is above it in the cell is outside. Likewise from below. On a convex or concave piece
/// of the surface all planes do one of the two. Bits of the first polygons of a leaf.
struct LeafSheets {
    static constexpr unsigned polygons = 62;
    /// Marks a word that is known.
    static constexpr std::uint64_t known = std::uint64_t{1} << 63U;
    std::uint64_t outside_above = 0;
    std::uint64_t inside_below = 0;
};

/// What was found by a trace about the points that are above these planes of a leaf and below all
/// others; the last two such regions are kept.
[[nodiscard]] std::optional<bool> remembered(const IndexLeaf& leaf, std::uint64_t above);
void remember(const IndexLeaf& leaf, std::uint64_t above, bool inside);

/// Whether a leaf's sheets are not known yet.
[[nodiscard]] bool has_unknown_sheets(const IndexLeaf& leaf);

/// Worked out when a leaf is first asked for it and then kept with the leaf, each kind in one
/// word: threads that come at the same time write the same. O(n^2) for n polygons.
[[nodiscard]] LeafSheets sheets_of(const IndexBase& index, const IndexTree::Cell& cell,
                                   const IndexGrid::Position& at);

}  // namespace trisect::detail
