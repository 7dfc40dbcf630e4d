// SPDX-License-Identifier: Apache-2.0
//
// least_distance: certified bounds on the clearance of moving solids.
// With a time at which they are as near as the upper one.
#pragma once

#include <optional>

#include <trisect/bsp/interference/enclosed_motion.h>
#include <trisect/bsp/interference/motion.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/solid.h>

namespace trisect {

struct LeastDistanceOptions {
    /// How far apart the bounds may be, as a part of the upper one; between 2^-30 and 1.
    double relative = 1e-6;
    /// The same in the user's units: a distance below this may count as 0. What is smaller
    /// than 2^-40 of the extent of the solids and their motions is taken as that.
    double absolute = 0;
};

/// The least distance of two boundaries over a range of time, in the user's units.
struct LeastDistance {
    /// Proved: at no time is the distance below this,
    double lower = 0;
    /// and at `time` it is not above this.
    double upper = 0;
    double time = 0;
    /// Of a pair of points that is nearly as close then, as NamedDistance.
    EntityName a;
    EntityName b;
    Point3d on_a{};
    Point3d on_b{};
    /// Whether the bounds are as close as requested. When they are not, doubles do not
    /// decide more at some times.
    bool is_narrow = false;
};

/// The least distance of the boundaries of two solids in enclosed motion, over the whole time;
/// nothing when one is empty. Both bounds are 0 where boundaries certainly pass through each other;
/// the search ends there, at no particular one of such times.
///
/// Both motions have the same duration, or one of them stands still. The distance is that of
/// boundaries, as in boundary_distance(): of a solid inside of another it is the clearance, and
/// enclosed_first_contact() decides whether they meet.
///
/// The distance at some times bounds the least one from above. Ranges of time are halved until
/// boxes grown by the sweep, or a plane for each pair of triangles that is left, prove all of the
/// rest farther than what is requested below that bound. The error of a plane falls with the square
/// of the range.
///
/// Cost: some hundred questions of distance and ranges; more where solids are at nearly the least
/// distance for long.
/// \throw UsageError for options out of range and durations that differ, UnsupportedError when a
/// solid is unbounded, both are stretched otherwise than alike along all axes, or the relative
/// motion of two rational enclosures has a degree above 8,
/// LimitError when poses are too wide for each other (kernel/pose.h); and what the motions throw.
[[nodiscard]] std::optional<LeastDistance> least_distance(const Solid& a,
                                                          const EnclosedMotion& motion_a,
                                                          const Solid& b,
                                                          const EnclosedMotion& motion_b,
                                                          const LeastDistanceOptions& options = {});
/// The same of rational motions, whose parameter is the time.
[[nodiscard]] std::optional<LeastDistance> least_distance(const Solid& a, const Motion& motion_a,
                                                          const Solid& b, const Motion& motion_b,
                                                          const LeastDistanceOptions& options = {});

}  // namespace trisect
