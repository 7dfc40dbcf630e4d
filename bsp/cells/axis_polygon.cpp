// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/axis_polygon.h>

#include <algorithm>

#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

// The axis across which a facet lies; 3 is none.
std::size_t axis_of(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    std::size_t k = 0;
    while (k < 3 && (coordinate(a, k) != coordinate(b, k) || coordinate(a, k) != coordinate(c, k)))
        ++k;
    return k;
}

// Of the normal of (a, b, c), which lie in a plane across `axis`.
int sign_of_normal(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                   std::size_t axis) {
    const auto flat = [u = static_cast<int>((axis + 1) % 3), v = static_cast<int>((axis + 2) % 3)](
                          const LatticePoint& p) { return flat_corner(p, u, v); };
    return turn(flat(a), flat(b), flat(c));
}

}  // namespace

std::optional<AxisPlane> axis_plane(const PlaneName& name) {
    if (name.is_splitter()) return AxisPlane{name.facet, 1, name.position()};
    const Source& source = *name.source();
    if (source.is_half_space() || !source.is_whole()) return std::nullopt;
    const LatticePoint& a = source.corner(name.facet, 0);
    const LatticePoint& b = source.corner(name.facet, 1);
    const LatticePoint& c = source.corner(name.facet, 2);
    std::size_t across = axis_of(a, b, c);
    if (!name.is_edge()) {
        if (across == 3) return std::nullopt;
        return AxisPlane{across, sign_of_normal(a, b, c, across),
                         fine_position(coordinate(a, across))};
    }
    // Through an edge and along the axis that the support lies across, or nearly so.
    const auto i = static_cast<int>(name.kind);
    const LatticePoint& from = source.corner(name.facet, i);
    const LatticePoint& to = source.corner(name.facet, (i + 1) % 3);
    const LatticePoint& third = source.corner(name.facet, (i + 2) % 3);
    std::size_t along = 3;
    for (std::size_t k = 0; k < 3; ++k)
        if (coordinate(from, (k + 1) % 3) == coordinate(to, (k + 1) % 3) &&
            coordinate(from, (k + 2) % 3) == coordinate(to, (k + 2) % 3))
            along = k;
    if (along == 3) return std::nullopt;
    if (across == 3) across = static_cast<std::size_t>(source.support(name.facet).dominant_axis());
    const std::size_t axis = 3 - along - across;
    // The facet lies below its edge planes.
    const int sign = coordinate(third, axis) < coordinate(from, axis) ? 1 : -1;
    return AxisPlane{axis, sign, fine_position(coordinate(from, axis))};
}

bool AxisPolygon::read(const PolygonRef& polygon) {
    if (polygon.source->is_half_space() || !polygon.source->is_whole()) return false;
    const Corners corners{&polygon.source->corner(polygon.facet, 0),
                          &polygon.source->corner(polygon.facet, 1),
                          &polygon.source->corner(polygon.facet, 2)};
    plane.axis = axis_of(*corners[0], *corners[1], *corners[2]);
    if (plane.axis == 3) return false;
    ref = polygon;
    plane.sign = sign_of_normal(*corners[0], *corners[1], *corners[2], plane.axis);
    plane.position = fine_position(coordinate(*corners[0], plane.axis));
    slanted_count = 0;
    if (polygon.fragment != nullptr) return read_fragment(corners);
    read_facet(corners);
    return true;
}

// A separating line of two convex polygons runs along an edge of one of them.
bool AxisPolygon::meets(const Cell& cell) const {
    const std::size_t u = (plane.axis + 1) % 3;
    const std::size_t v = (plane.axis + 2) % 3;
    if (plane.position <= cell.lo[plane.axis] || plane.position >= cell.hi[plane.axis])
        return false;
    for (const std::size_t k : {u, v})
        if (lo[k] >= cell.hi[k] || hi[k] <= cell.lo[k]) return false;
    return std::ranges::all_of(slanted_edges(), [&](const SlantedEdge& e) {
        const Int128 step_u = e.to[0] - e.from[0];
        const Int128 step_v = e.to[1] - e.from[1];
        // The corner of the cell that is farthest to the left.
        const std::int64_t at_u = step_v > 0 ? cell.lo[u] : cell.hi[u];
        const std::int64_t at_v = step_u > 0 ? cell.hi[v] : cell.lo[v];
        return step_u * (at_v - e.from[1] * splitting_scale) >
               step_v * (at_u - e.from[0] * splitting_scale);
    });
}

void AxisPolygon::read_facet(const Corners& corners) {
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(
            {coordinate(*corners[0], k), coordinate(*corners[1], k), coordinate(*corners[2], k)});
        lo[k] = fine_position(low);
        hi[k] = fine_position(high);
    }
    for (std::size_t i = 0; i < 3; ++i) add_slanted(*corners[i], *corners[i == 2 ? 0 : i + 1]);
}

void AxisPolygon::add_slanted(const LatticePoint& from, const LatticePoint& to) {
    const std::size_t u = (plane.axis + 1) % 3;
    const std::size_t v = (plane.axis + 2) % 3;
    if (coordinate(from, u) == coordinate(to, u) || coordinate(from, v) == coordinate(to, v))
        return;
    SlantedEdge& e = slanted[slanted_count++];
    const auto at = [&](const LatticePoint& p) {
        return std::array{coordinate(p, u).to_integer(), coordinate(p, v).to_integer()};
    };
    e = {at(from), at(to)};
    if (plane.sign < 0) std::swap(e.from, e.to);
}

bool AxisPolygon::read_fragment(const Corners& corners) {
    const Box& box = ref.fragment->box();
    for (std::size_t k = 0; k < 3; ++k) {
        lo[k] = box.lo[k] * splitting_scale;
        hi[k] = box.hi[k] * splitting_scale;
    }
    lo[plane.axis] = hi[plane.axis] = plane.position;
    for (const EdgeName& e : ref.fragment->edges()) {
        if (const auto across = axis_plane(e.plane)) {
            const bool is_low = e.above == (across->sign > 0);
            std::int64_t& bound = is_low ? lo[across->axis] : hi[across->axis];
            bound = is_low ? std::max(bound, across->position) : std::min(bound, across->position);
        } else if (e.plane.is_edge() && e.plane.source() == ref.source &&
                   e.plane.facet == ref.facet && !e.above) {
            const std::size_t i = e.plane.kind;
            add_slanted(*corners[i], *corners[i == 2 ? 0 : i + 1]);
        } else {
            return false;
        }
    }
    return true;
}

}  // namespace trisect::detail
