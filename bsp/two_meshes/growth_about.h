// SPDX-License-Identifier: Apache-2.0
//
// A centre about which one of two meshes grows.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <span>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/cells/infinitesimal_shift.h>

namespace trisect::detail {

/// A facet of the first one of two meshes, and on which side of it the second one's facets that
/// cover a part of it should go.
struct WantedSide {
    std::uint32_t facet = 0;
    bool above = false;
    bool is_wish = false;  ///< it may go to the other side as well
    friend auto operator<=>(const WantedSide&, const WantedSide&) = default;
};

/// A shift by which the second mesh grows or shrinks and goes to all of these sides, or to all but
/// wishes. Found in doubles: the search that uses it shows whether it does. Nothing where none was
/// found; a mesh that fills a hole of a convex shape, or all of its width, has one. O(n).
[[nodiscard]] std::optional<InfinitesimalShift> growth_about(const LatticeMesh& first,
                                                             std::span<const WantedSide> sides);

}  // namespace trisect::detail
