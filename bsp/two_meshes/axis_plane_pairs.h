// SPDX-License-Identifier: Apache-2.0
//
// Relations of facets in one axis-normal plane.
#pragma once

#include <optional>

#include <trisect/bsp/cells/infinitesimal_shift.h>
#include <trisect/bsp/cells/shift/shifted_pairs.h>

namespace trisect::detail {

/// What relate_shifted() says of two facets of one plane across an axis, by comparisons of
/// coordinates and the signs of one component of their normals. Nothing of others, where doubles
/// leave such a sign open, and where the second one's corners move to both sides. \pre their
/// corners are not the same
[[nodiscard]] std::optional<ShiftedPair> relate_across_axis(const FacetCorners& first,
                                                            const FacetCorners& second,
                                                            const InfinitesimalShift& shift);

}  // namespace trisect::detail
