// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/solid_interference.h>

#include <algorithm>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/bsp/interference/tree/solid_pair.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect {

namespace {

// Whether both are one solid in one place. Comparing all its triangles with themselves would take a
// while.
bool is_same_in_place(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b) {
    if (detail::state_of(a) != detail::state_of(b)) return false;
    const auto r = detail::relative_pose(pose_a, a.lattice(), pose_b, b.lattice());
    return r.is_translation() &&
           std::ranges::all_of(r.translation(), [](const auto& t) { return t.is_zero(); });
}

}  // namespace

SolidInterference interfere(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b,
                            const SolidInterferenceOptions& options) {
    const detail::SolidBoundary boundary_a(a);
    const detail::SolidBoundary boundary_b(b);
    if (!options.contacts && !boundary_a.is_empty() && is_same_in_place(a, pose_a, b, pose_b))
        return {Relation::Equal, {}};
    return detail::relation_of(boundary_a, pose_a, boundary_b, pose_b, options);
}

}  // namespace trisect
