// SPDX-License-Identifier: Apache-2.0
//
// Area of a result from the facets that assembly gathers.
#pragma once

#include <optional>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/cells/solid_state.h>

namespace trisect::detail {

/// least <= area <= most, in the user's units, mostly with less than 2^-70 of it between them. They
/// are equal where all facets are across axes and no coordinate has a rest (see split_point.h), and
/// nowhere else.
struct EnclosedArea {
    ExactRational least;
    ExactRational most;
};

/// Nothing for other boundaries whose area may be rational. Neither a mesh nor, mostly, exact
/// points are made. \pre the boundary is bounded and does not meet itself.
[[nodiscard]] std::optional<EnclosedArea> enclosed_area(const SolidState& solid);

}  // namespace trisect::detail
