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

std::optional<AxisSupport> axis_support(const Source& source, std::uint32_t facet) {
    if (source.is_half_space()) return std::nullopt;
    const LatticePoint& a = source.corner(facet, 0);
    const LatticePoint& b = source.corner(facet, 1);
    const LatticePoint& c = source.corner(facet, 2);
    const std::size_t axis = axis_of(a, b, c);
    if (axis == 3) return std::nullopt;
    return AxisSupport{axis, sign_of_normal(a, b, c, axis), coordinate(a, axis)};
}

template <class Number>
std::optional<AxisPlane<Number>> axis_plane(const PlaneName& name) {
    using Numbers = AxisNumbers<Number>;
    if (name.is_splitter())
        return AxisPlane<Number>{name.facet, 1, Numbers::from_fine(name.position())};
    const Source& source = *name.source();
    if (source.is_half_space()) return std::nullopt;
    if (!name.is_edge()) {
        const auto support = axis_support(source, name.facet);
        if (!support || !Numbers::takes(support->at)) return std::nullopt;
        return AxisPlane<Number>{support->axis, support->sign, axis_position<Number>(support->at)};
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
    std::size_t across = axis_of(from, to, third);
    if (across == 3) across = static_cast<std::size_t>(source.support(name.facet).dominant_axis());
    const std::size_t axis = 3 - along - across;
    if (!Numbers::takes(coordinate(from, axis))) return std::nullopt;
    // The facet lies below its edge planes.
    const int sign = coordinate(third, axis) < coordinate(from, axis) ? 1 : -1;
    return AxisPlane<Number>{axis, sign, axis_position<Number>(coordinate(from, axis))};
}

template <class Number>
bool AxisPolygon<Number>::read(const PolygonRef& polygon) {
    if (!AxisNumbers<Number>::takes(*polygon.source)) return false;
    const Corners corners{&polygon.source->corner(polygon.facet, 0),
                          &polygon.source->corner(polygon.facet, 1),
                          &polygon.source->corner(polygon.facet, 2)};
    plane.axis = axis_of(*corners[0], *corners[1], *corners[2]);
    if (plane.axis == 3) return false;
    ref = polygon;
    plane.sign = sign_of_normal(*corners[0], *corners[1], *corners[2], plane.axis);
    plane.position = axis_position<Number>(coordinate(*corners[0], plane.axis));
    slanted_count = 0;
    if (polygon.fragment != nullptr) return read_fragment(corners);
    read_facet(corners);
    return true;
}

// A separating line of two convex polygons runs along an edge of one of them.
template <class Number>
bool AxisPolygon<Number>::meets(const AxisBox<Number>& cell) const {
    using Numbers = AxisNumbers<Number>;
    const std::size_t u = (plane.axis + 1) % 3;
    const std::size_t v = (plane.axis + 2) % 3;
    if (plane.position <= cell.lo[plane.axis] || plane.position >= cell.hi[plane.axis])
        return false;
    for (const std::size_t k : {u, v})
        if (lo[k] >= cell.hi[k] || hi[k] <= cell.lo[k]) return false;
    return std::ranges::all_of(slanted_edges(), [&](const SlantedEdge<Number>& e) {
        const Number step_u = e.to[0] - e.from[0];
        const Number step_v = e.to[1] - e.from[1];
        // The corner of the cell that is farthest to the left.
        const Number at_u = step_v > 0 ? cell.lo[u] : cell.hi[u];
        const Number at_v = step_u > 0 ? cell.hi[v] : cell.lo[v];
        return Numbers::multiply(step_u, at_v - e.from[1] * Numbers::scale) >
               Numbers::multiply(step_v, at_u - e.from[0] * Numbers::scale);
    });
}

template <class Number>
void AxisPolygon<Number>::read_facet(const Corners& corners) {
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(
            {coordinate(*corners[0], k), coordinate(*corners[1], k), coordinate(*corners[2], k)});
        lo[k] = axis_position<Number>(low);
        hi[k] = axis_position<Number>(high);
    }
    for (std::size_t i = 0; i < 3; ++i) add_slanted(*corners[i], *corners[i == 2 ? 0 : i + 1]);
}

template <class Number>
void AxisPolygon<Number>::add_slanted(const LatticePoint& from, const LatticePoint& to) {
    const std::size_t u = (plane.axis + 1) % 3;
    const std::size_t v = (plane.axis + 2) % 3;
    if (coordinate(from, u) == coordinate(to, u) || coordinate(from, v) == coordinate(to, v))
        return;
    SlantedEdge<Number>& e = slanted[slanted_count++];
    const auto at = [&](const LatticePoint& p) {
        return std::array{AxisNumbers<Number>::place(coordinate(p, u)),
                          AxisNumbers<Number>::place(coordinate(p, v))};
    };
    e = {at(from), at(to)};
    if (plane.sign < 0) std::swap(e.from, e.to);
}

template <class Number>
bool AxisPolygon<Number>::read_fragment(const Corners& corners) {
    const Box& box = ref.fragment->box();
    using Numbers = AxisNumbers<Number>;
    for (std::size_t k = 0; k < 3; ++k) {
        lo[k] = Numbers::from_fine(fine_lower(box.lo[k], Numbers::whole));
        hi[k] = Numbers::from_fine(fine_upper(box.hi[k], Numbers::whole));
    }
    lo[plane.axis] = hi[plane.axis] = plane.position;
    for (const EdgeName& e : ref.fragment->edges()) {
        if (const auto across = axis_plane<Number>(e.plane)) {
            const bool is_low = e.above == (across->sign > 0);
            Number& bound = is_low ? lo[across->axis] : hi[across->axis];
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

// A facet of whole coordinates may have been cut by one with fractions.
bool is_axis_polygon(const PolygonRef& polygon) {
    if (AxisPolygon<std::int64_t>().read(polygon)) return true;
    return !(polygon.fragment == nullptr && polygon.source->is_whole()) &&
           AxisPolygon<Int128>().read(polygon);
}

template std::optional<AxisPlane<std::int64_t>> axis_plane(const PlaneName& name);
template std::optional<AxisPlane<Int128>> axis_plane(const PlaneName& name);
template struct AxisPolygon<std::int64_t>;
template struct AxisPolygon<Int128>;

}  // namespace trisect::detail
