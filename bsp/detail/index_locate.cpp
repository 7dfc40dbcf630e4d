// SPDX-License-Identifier: Apache-2.0
//
// Point location: one descent to a leaf, then the leaf's polygons one by one. A polygon that
// contains the point is noted; otherwise the segment to the leaf's reference is traced across it.
// Afterwards the point is on the boundary, or its winding number is known.
//
// What kind of boundary point it is, the normals of the noted polygons tell: in one plane a face,
// planes through one line an edge, else a vertex. Near the point the boundary is a cone over these
// polygons, so this is a property of the set.

#include <algorithm>
#include <cmath>
#include <numeric>

#include <trisect/bsp/detail/index_core.h>
#include <trisect/bsp/detail/index_signs.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

namespace {

// The winding number of the point, or something on the boundary noted in `on`.
int winding_in_leaf(const IndexPolygons& polygons, const IndexTree& tree, const IndexTree::Leaf& l,
                    const IndexPoint& p, std::vector<PolygonId>& on) {
    int winding = l.winding;
    const Reference reference(l.reference);
    if (const Source* source = polygons.only_source()) {
        for (const PolygonId id : tree.listed(l)) {
            const Passing s = passing(source->corner(id, 0), source->corner(id, 1),
                                      source->corner(id, 2), p, reference);
            if (s == Passing::On) {
                on.push_back(id);
            } else {
                winding += static_cast<int>(s);
            }
        }
        return winding;
    }
    for (const PolygonId id : tree.listed(l)) {
        const Passing s = passing(polygons, id, p, reference);
        if (s == Passing::On) {
            on.push_back(id);
        } else {
            winding += polygons.is_flipped(id) ? -static_cast<int>(s) : static_cast<int>(s);
        }
    }
    return winding;
}

bool is_beyond(const IndexTree& tree, const IndexPoint& p) {
    if (!tree.is_bounded()) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (p[k] - p.error() > tree.hi()[k] || p[k] + p.error() < tree.lo()[k]) return true;
    return false;
}

bool are_parallel(const Plane& a, const Plane& b) {
    for (int k = 0; k < 3; ++k)
        if (sign_of_cross(a, b, k) != 0) return false;
    return true;
}

}  // namespace

Location locate_polygons(const IndexBase& index, const IndexPoint& point,
                         std::vector<PolygonId>& on) {
    on.clear();
    const IndexTree& tree = index.tree;
    if (is_beyond(tree, point))
        return tree.is_inside_beyond() ? Location::Inside : Location::Outside;
    bool inside = false;
    bool several = false;
    tree.for_leaves_at(point, [&](const IndexTree::Node& n) {
        if (!n.is_mixed()) {
            inside = n.is_inside();
            return;
        }
        const std::size_t before = on.size();
        const int winding = winding_in_leaf(index.polygons, tree, tree.leaf(n.next), point, on);
        if (on.empty()) inside = winding > 0;
        several = several || (before != 0 && on.size() != before);
    });
    if (on.empty()) return inside ? Location::Inside : Location::Outside;
    if (several) {
        std::sort(on.begin(), on.end());
        on.erase(std::unique(on.begin(), on.end()), on.end());
    }
    return Location::OnFace;
}

std::vector<std::uint32_t> query_order(const IndexBase& index,
                                       std::span<const std::array<double, 3>> points) {
    if (points.size() >= 0xffffffffU) throw LimitError("more than 2^32 points at once");
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    constexpr std::size_t worth_it = 2000;  // fewer points are not many to a cell
    if (points.size() < worth_it) return order;
    // Five bits of each coordinate in the box, interleaved: a Morton curve.
    const double unit = std::ldexp(1.0, index.solid.lattice().exponent);
    std::array<double, 3> origin{};
    std::array<double, 3> scale{};
    for (std::size_t k = 0; k < 3; ++k) {
        origin[k] = index.tree.lo()[k] * unit;
        const double extent = index.tree.hi()[k] * unit - origin[k];
        scale[k] = 32 / extent;
    }
    const auto spread = [](std::uint32_t v) {  // abcde to a00b00c00d00e
        v = (v | (v << 8)) & 0x300fU;
        v = (v | (v << 4)) & 0x30c3U;
        return (v | (v << 2)) & 0x9249U;
    };
    std::vector<std::uint32_t> keys(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::uint32_t key = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double t = (points[i][k] - origin[k]) * scale[k];
            const std::uint32_t v =
                t > 0 ? (t < 32 ? static_cast<std::uint32_t>(t) : 31U) : 0U;  // also for no number
            key |= spread(v) << k;
        }
        keys[i] = key;
    }
    // A counting sort.
    std::vector<std::uint32_t> begin((1U << 15U) + 1, 0);
    for (const std::uint32_t key : keys) ++begin[key + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    for (std::uint32_t i = 0; i < keys.size(); ++i) order[begin[keys[i]]++] = i;
    return order;
}

Place place_on(const IndexPolygons& polygons, std::vector<PolygonId>& on) {
    if (on.size() > 1)
        std::sort(on.begin(), on.end(),
                  [&](PolygonId a, PolygonId b) { return polygons.name(a) < polygons.name(b); });
    Place place;
    std::array<Plane, 3> planes;
    std::size_t rank = 0;
    for (const PolygonId id : on) {
        if (rank == 3) break;
        const Plane p = polygons.support(id);
        if (rank == 1 && are_parallel(planes[0], p)) continue;
        if (rank == 2 && sign_of_det(planes[0], planes[1], p) == 0) continue;
        planes[rank] = p;
        place.faces[rank] = polygons.face_source(id);
        ++rank;
    }
    place.face_count = static_cast<std::uint8_t>(rank);
    place.location = rank == 1   ? Location::OnFace
                     : rank == 2 ? Location::OnEdge
                                 : Location::OnVertex;
    return place;
}

Place place_on(const IndexPolygons& polygons, std::vector<PolygonId>& on, const IndexPoint& point) {
    Place place = place_on(polygons, on);
    if (place.location != Location::OnVertex || !point.is_doubles()) return place;
    for (const PolygonId id : on) {
        const Source& s = polygons.source(id);
        if (s.is_half_space()) continue;
        for (int i = 0; i < 3; ++i) {
            const LatticePoint& c = s.corner(polygons.facet(id), i);
            if (static_cast<double>(c.x) != point[0] || static_cast<double>(c.y) != point[1] ||
                static_cast<double>(c.z) != point[2])
                continue;
            const CornerSource name{static_cast<std::uint32_t>(s.serial()),
                                    s.corner_index(polygons.facet(id), i)};
            if (!place.corner.is_valid() || name < place.corner) place.corner = name;
        }
    }
    return place;
}

}  // namespace trisect::detail
