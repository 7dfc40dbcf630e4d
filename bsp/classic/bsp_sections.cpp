// SPDX-License-Identifier: Apache-2.0
//
// The plane of a node within its cell.
//
// Whether a plane cuts a convex cell is a feasibility question. Floating-point codes solve a linear
// programme and get "nearly"; here the plane's polygon is clipped by the planes above it in the
// tree, exactly and without new planes, and the plane cuts the cell when something with area is
// left: a section within the border of the cell would be coplanar with one of the ancestors' planes
// and is refused like one outside.
//
// Cells may be unbounded, polygons may not. So space ends at a cube beyond all lattice points. Its
// six planes are as small as planes can be, so the widths of predicates do not notice them.
//
// Clipping starts with the nearest ancestor. Near planes cut most, and then most of the others are
// found not to cut at all, which costs a few filtered signs and no copy.

#include <trisect/bsp/classic/bsp_sections.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <trisect/kernel/lattice_point.h>

namespace trisect {

namespace {

/// The cube's plane at the upper or lower end of an axis; the cube is below it.
Plane splitter(int axis, bool upper) {
    if (upper) return Plane::axis_aligned(axis, 1, coordinate_limit);
    return Plane::axis_aligned(axis, 1, -coordinate_limit).flipped();
}

/// Keeps the part with area on one side. \return whether there is one.
bool keep_part(ConvexPolygon& polygon, const Plane& plane, Side side) {
    ConvexPolygon other;
    const auto parts = side == Side::Below ? polygon.split(plane, polygon, other)
                                           : polygon.split(plane, other, polygon);
    return parts.is_cut() || parts.side() == side;
}

struct Ancestor {
    std::uint32_t parent = 0;
    Side side = Side::On;  // of the parent's plane; On for the root
};

std::vector<Ancestor> ancestors(const BspTree& tree) {
    std::vector<Ancestor> result(tree.nodes().size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const BspTree::Node& node = tree.nodes()[i];
        const auto id = static_cast<std::uint32_t>(i);
        if (!node.below.is_leaf()) result[node.below.index()] = {id, Side::Below};
        if (!node.above.is_leaf()) result[node.above.index()] = {id, Side::Above};
    }
    return result;
}

}  // namespace

ConvexPolygon section_of_space(const Plane& plane) {
    // Seen along its dominant axis the plane fills the whole square of the other two.
    const int axis = plane.dominant_axis();
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::vector<Plane> edges{splitter(v, false), splitter(u, true), splitter(v, true),
                             splitter(u, false)};
    if (plane.normal(axis) < 0) std::swap(edges[0], edges[2]);
    ConvexPolygon section(plane, std::move(edges));
    for (const bool upper : {false, true})
        if (!keep_part(section, splitter(axis, upper), Side::Below)) return {};
    return section;
}

std::vector<ConvexPolygon> cell_sections(const BspTree& tree) {
    const std::vector<Ancestor> above = ancestors(tree);
    std::vector<ConvexPolygon> sections;
    sections.reserve(tree.nodes().size());
    for (std::size_t i = 0; i < tree.nodes().size(); ++i) {
        ConvexPolygon section = section_of_space(tree.nodes()[i].plane);
        for (std::size_t at = i; above[at].side != Side::On && !section.is_empty();
             at = above[at].parent) {
            if (!keep_part(section, tree.nodes()[above[at].parent].plane, above[at].side))
                section = ConvexPolygon();
        }
        sections.push_back(std::move(section));
    }
    return sections;
}

}  // namespace trisect
