// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/solid_interference.h>

#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/bsp/interference/tree/solid_pair.h>

namespace trisect {

SolidInterference interfere(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b,
                            const SolidInterferenceOptions& options) {
    const detail::SolidBoundary boundary_a(a);
    const detail::SolidBoundary boundary_b(b);
    return detail::relation_of(boundary_a, pose_a, boundary_b, pose_b, options);
}

}  // namespace trisect
