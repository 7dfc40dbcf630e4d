// SPDX-License-Identifier: Apache-2.0
//
// Distance of two placed curved surfaces, to a stated tolerance.
#pragma once

#include <cstdint>

#include <trisect/bsp/hierarchies/curved/patch_tree.h>
#include <trisect/kernel/pose.h>

namespace trisect::hierarchies {

struct PatchDistanceOptions {
    /// The interval found is at most this wide, in the user's units.
    double tolerance = 1e-9;
    /// Pairs of parts that may be compared before the search gives up.
    std::uint64_t max_tests = std::uint64_t{1} << 22;
};

/// Certified: lower <= distance of the surfaces <= upper. Surfaces that meet have lower = 0.
struct PatchDistance {
    double lower = 0;
    double upper = 0;
    SurfacePoint a;  ///< points at most `upper` apart
    SurfacePoint b;
    bool reached = false;     ///< upper - lower <= tolerance
    std::uint64_t tests = 0;  ///< pairs of parts compared: N_bv of the cost function
};

/// The distance of surfaces, not of solids: of a solid inside another one it is the clearance.
///
/// Best-first search over pairs of parts, halving the larger one. Where `max_tests` or doubles end
/// the search early the interval is wider than requested, and `reached` is false; it still holds.
/// \throw UsageError unless the tolerance is positive.
[[nodiscard]] PatchDistance patch_distance(PatchTree& a, const Pose& pose_a, PatchTree& b,
                                           const Pose& pose_b,
                                           const PatchDistanceOptions& options = {});

/// Outcome of an interference test of two surfaces.
enum class PatchInterference : std::uint8_t {
    Apart,     ///< proved: they have no common point
    Near,      ///< proved: there are points of both within the tolerance of each other
    Undecided  ///< the search was ended before either was proved
};

/// Whether surfaces interfere, to a tolerance. Surfaces that meet are Near; surfaces at least the
/// tolerance apart are Apart; between these either answer is right.
[[nodiscard]] PatchInterference patches_interfere(PatchTree& a, const Pose& pose_a, PatchTree& b,
                                                  const Pose& pose_b,
                                                  const PatchDistanceOptions& options = {});

}  // namespace trisect::hierarchies
