// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/trace/trace_winding.h>

#include <cmath>
#include <vector>

namespace trisect::detail {

namespace {

// The edges of a polygon as planes with the side that is outside.
struct PlaneEdge {
    Plane plane;
    int outside;
};
std::vector<PlaneEdge> plane_edges(const PolygonRef& ref) {
    std::vector<PlaneEdge> out;
    if (ref.fragment != nullptr) {
        for (const EdgeName& e : ref.fragment->edges())
            out.push_back({e.plane.plane(), e.above ? -1 : 1});
    } else if (!ref.source->is_half_space()) {
        for (int i = 0; i < 3; ++i) out.push_back({ref.source->edge_plane(ref.facet, i), 1});
    }
    return out;
}

}  // namespace

Box box_of_segment(const Approximation& a, const Approximation& b) {
    Box r;
    for (std::size_t k = 0; k < 3; ++k) {
        r.lo[k] =
            static_cast<std::int64_t>(std::floor(std::min(a.c[k] - a.error, b.c[k] - b.error)));
        r.hi[k] =
            static_cast<std::int64_t>(std::ceil(std::max(a.c[k] + a.error, b.c[k] + b.error)));
    }
    return r;
}

std::optional<int> trace_winding(std::span<const PolygonRef> polygons, bool flipped,
                                 const FinePoint& from, const FinePoint& to) {
    const Approximation start = approximate(from);
    const TraceTarget target(to);
    const Box segment = box_of_segment(start, target.approximation());
    int winding = 0;
    for (const PolygonRef& ref : polygons) {
        if (!ref.box().overlaps(segment)) continue;
        const Plane support = ref.source->support(ref.facet);
        const int at_start = side(from, start, support);
        const int at_end = side(target, support);
        if (at_start == at_end && at_start != 0) continue;
        const std::vector<PlaneEdge> edges = plane_edges(ref);
        if (at_start == 0 || at_end == 0) {
            const auto from_outside = [&](const PlaneEdge& e) {
                return side(from, start, e.plane) * e.outside > 0;
            };
            const auto to_outside = [&](const PlaneEdge& e) {
                return side(target, e.plane) * e.outside > 0;
            };
            if (avoids_in_plane(at_start, at_end, edges, from_outside, to_outside)) continue;
            return std::nullopt;
        }
        const SupportCrossing crossing(from, start, target, support);
        int worst = -1;
        for (const PlaneEdge& e : edges)
            worst = std::max(worst, e.outside * crossing.side_of(e.plane));
        if (worst == 0) return std::nullopt;
        if (worst > 0) continue;
        const bool entering = at_start > 0;
        winding += entering != (ref.flipped != flipped) ? 1 : -1;
    }
    return winding;
}

}  // namespace trisect::detail
