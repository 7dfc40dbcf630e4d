// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/hierarchies/volumes/frame_hull.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <trisect/bsp/hierarchies/convex/convex_hull.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::hierarchies {

ConvexPolytope frame_hull(std::span<const detail::Vector3> points) {
    std::vector<LatticePoint> rounded;
    rounded.reserve(points.size());
    const auto r = [](double v) { return Coordinate(std::nearbyint(v / frame_hull_unit)); };
    for (const detail::Vector3& p : points) rounded.push_back({r(p[0]), r(p[1]), r(p[2])});
    // A corner of a mesh comes with every triangle at it.
    std::ranges::sort(rounded);
    rounded.erase(std::unique(rounded.begin(), rounded.end()), rounded.end());
    return convex_hull(rounded, Lattice{});
}

detail::AreaMoments surface_moments(const ConvexPolytope& hull) {
    const auto position = [&hull](std::uint32_t i) {
        return detail::scaled(hull.vertices()[i].doubles(), frame_hull_unit);
    };
    detail::AreaMoments m;
    for (std::size_t f = 0; f < hull.face_count(); ++f) {
        const auto corners = hull.corners(f);
        for (std::size_t i = 2; i < corners.size(); ++i)
            m.add(position(corners[0]), position(corners[i - 1]), position(corners[i]));
    }
    return m;
}

}  // namespace trisect::hierarchies
