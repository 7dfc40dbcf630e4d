// SPDX-License-Identifier: Apache-2.0
//
// Volume of a result from the facets that assembly gathers.
#pragma once

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/cells/solid_state.h>

namespace trisect::detail {

/// least <= volume <= most, in the user's units; equal ones where no coordinate has a rest (see
/// split_point.h). Else they mostly differ by less than 2^-70 of the volume, by more where the
/// solid is thin or far from the origin.
struct EnclosedVolume {
    ExactRational least;
    ExactRational most;
};

/// Neither a mesh nor, mostly, exact points are made. \pre the solid is bounded, and its boundary
/// does not meet itself.
[[nodiscard]] EnclosedVolume enclosed_volume(const SolidState& solid);

}  // namespace trisect::detail
