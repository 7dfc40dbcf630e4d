// SPDX-License-Identifier: Apache-2.0
//
// Distance between the boundaries of two placed solids.
// It is a certified interval at once, and the exact number on demand.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/kernel/point3d.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// The distance of two boundaries, in the user's units: lower <= distance <= upper, exactly. The
/// interval is a few roundings wide. Both are 0 where boundaries cross; where they merely touch,
/// lower is 0 and upper next to it.
///
/// The closest features are those of a pair of points at most `upper` apart. Other pairs may be
/// equally close; a point on a common edge of two triangles is named by the edge.
struct BoundaryDistance {
    double lower = 0;
    double upper = 0;
    BoundaryEntity a;
    BoundaryEntity b;
    Point3d on_a{};  ///< near to the closest points, in the world
    Point3d on_b{};
};

/// Nothing when one of the models is empty. Of a solid inside of another it is the clearance to its
/// boundary; interfere() decides whether it is inside.
///
/// Cost: best-first search over pairs of boxes, typically a few hundred of them.
[[nodiscard]] std::optional<BoundaryDistance> boundary_distance(const InterferenceModel& a,
                                                                const Pose& pose_a,
                                                                const InterferenceModel& b,
                                                                const Pose& pose_b);

/// The square of the distance, exactly. Rationals for the few pairs of triangles between which the
/// interval cannot decide. \throw LimitError when the poses are too wide for each other.
[[nodiscard]] std::optional<ExactRational> exact_squared_distance(const InterferenceModel& a,
                                                                  const Pose& pose_a,
                                                                  const InterferenceModel& b,
                                                                  const Pose& pose_b);

/// Whether the distance of the boundaries is less than `distance`, exactly; false when one is
/// empty. Much cheaper than the distance: boxes farther apart are never opened, and the search ends
/// at the first pair of triangles that is nearer. \throw UsageError for a distance that is not
/// finite or negative, LimitError as above.
[[nodiscard]] bool are_nearer_than(const InterferenceModel& a, const Pose& pose_a,
                                   const InterferenceModel& b, const Pose& pose_b, double distance);

}  // namespace trisect
