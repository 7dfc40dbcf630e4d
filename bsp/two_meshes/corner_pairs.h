// SPDX-License-Identifier: Apache-2.0
//
// Relations of facets that have a corner in common.
#pragma once

#include <optional>

#include <trisect/bsp/cells/infinitesimal_shift.h>
#include <trisect/bsp/cells/shift/shifted_pairs.h>
#include <trisect/bsp/leaf/doubles/filtered_facets.h>

namespace trisect::detail {

/// A corner of the one facet that is one of the other as well, the first such of the one; null
/// where there is none.
[[nodiscard]] const LatticePoint* common_corner(const FilteredFacet& first,
                                                const FilteredFacet& second);

/// What relate_shifted() says of two whole facets, from the doubles of their cell; the second one's
/// corners move (InfinitesimalShift::moves). Answers agree with it, but for the last bits of ends.
/// Nothing where they have no corner in common, or three, or doubles leave another sign open than
/// those that are 0 by a common corner. Takes a third of the time.
[[nodiscard]] std::optional<ShiftedPair> relate_at_corners(FilteredFacets& facets, LeafIndex first,
                                                           LeafIndex second,
                                                           const InfinitesimalShift& shift);

}  // namespace trisect::detail
