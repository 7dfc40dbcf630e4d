// SPDX-License-Identifier: Apache-2.0
//
// Contact regions and overlap of two placed solids.
//
// A boolean cuts from each solid what is near the other one; the rest of a large part costs
// nothing.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_overlap.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// What a ContactRegion is, by names. A maximal face has the name of one of the operands' faces
/// that it consists of.
struct NamedRegion {
    std::uint8_t dimension = 0;
    EntityName a;
    EntityName b;
    /// Of areas: the outward normals point in opposite directions.
    bool opposite = false;
    std::vector<std::vector<ContactPoint>> loops;
};

/// All contact regions, by falling dimension, then by names. The same as those of
/// InterferenceModels of the solids. Cost: a boolean with the box of the other solid and a model of
/// the outcome, for each solid; some microseconds a point. \throw as interfere
[[nodiscard]] std::vector<NamedRegion> contact_regions(const Solid& a, const Pose& pose_a,
                                                       const Solid& b, const Pose& pose_b);

/// A ∩ B. Exact between poses that differ by a translation, quarter turns and mirrors, where a
/// lattice has both solids, whatever operations made them. Else as for InterferenceModels, but of
/// results of operations the corners that the boxes make are rounded, too.
/// \throw as interfere; LimitError when the poses are too wide for each other
[[nodiscard]] Overlap overlap(const Solid& a, const Pose& pose_a, const Solid& b,
                              const Pose& pose_b);

}  // namespace trisect
