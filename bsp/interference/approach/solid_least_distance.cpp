// SPDX-License-Identifier: Apache-2.0

#include <span>
#include <utility>

#include <trisect/bsp/interference/approach/least_distance_search.h>
#include <trisect/bsp/interference/approach/swept_view.h>
#include <trisect/bsp/interference/least_distance.h>
#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/bsp/interference/tree/solid_places.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

// Between breaks.
bool is_similar(const EnclosedMotion& motion) {
    const std::span<const double> breaks = motion.breaks();
    for (std::size_t i = 1; i < breaks.size(); ++i)
        if (!detail::is_about_similar(
                detail::piece_of(motion.enclose(breaks[i - 1], breaks[i]).motion, 0)))
            return false;
    return true;
}

// Distances are taken in the space of A.
LeastDistance seen_from_a(const detail::SolidBoundary& a, const EnclosedMotion& motion_a,
                          const detail::SolidBoundary& b, const EnclosedMotion& motion_b,
                          const LeastDistanceOptions& options) {
    detail::LeastDistanceSearch search(a, motion_a, b, motion_b, options);
    search.run();
    LeastDistance out;
    out.lower = search.lower();
    out.upper = search.upper();
    out.time = search.time();
    out.is_narrow = search.is_narrow();
    const detail::DistanceCandidate& nearest = search.nearest();
    const auto on_a = point_on(a, nearest.a, nearest.closest.on_p);
    const auto on_b = point_on(b, nearest.b, nearest.closest.on_q);
    out.a = name_near(a, nearest.a, on_a);
    out.b = name_near(b, nearest.b, on_b);
    out.on_a = detail::in_world(on_a, a.lattice, search.pose_a(out.time));
    out.on_b = detail::in_world(on_b, b.lattice, search.pose_b(out.time));
    return out;
}

}  // namespace

std::optional<LeastDistance> least_distance(const Solid& a, const EnclosedMotion& motion_a,
                                            const Solid& b, const EnclosedMotion& motion_b,
                                            const LeastDistanceOptions& options) {
    const detail::SolidBoundary boundary_a(a);
    const detail::SolidBoundary boundary_b(b);
    if (boundary_a.is_empty() || boundary_b.is_empty()) return std::nullopt;
    // Where A rotates by matrices in doubles, and B does not, B is the better place.
    if (motion_a.is_still() && is_similar(motion_a))
        return seen_from_a(boundary_a, motion_a, boundary_b, motion_b, options);
    if (is_similar(motion_b)) {
        LeastDistance out = seen_from_a(boundary_b, motion_b, boundary_a, motion_a, options);
        std::swap(out.a, out.b);
        std::swap(out.on_a, out.on_b);
        return out;
    }
    if (!is_similar(motion_a))
        throw UnsupportedError("the least distance of two solids that are both stretched");
    return seen_from_a(boundary_a, motion_a, boundary_b, motion_b, options);
}

std::optional<LeastDistance> least_distance(const Solid& a, const Motion& motion_a, const Solid& b,
                                            const Motion& motion_b,
                                            const LeastDistanceOptions& options) {
    return least_distance(a, EnclosedMotion(motion_a), b, EnclosedMotion(motion_b), options);
}

}  // namespace trisect
