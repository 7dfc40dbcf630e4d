// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/level_set/level_vertices.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace trisect::detail {
namespace {

/// The first end of the edge between two nodes, and its direction.
std::pair<NodePoint, unsigned> edge_between(const NodePoint& p, const NodePoint& q) {
    const bool p_is_centre = p[0] % 2 != 0;
    const bool q_is_centre = q[0] % 2 != 0;
    if (p_is_centre == q_is_centre) {
        const bool is_up = p[0] < q[0] || p[1] < q[1] || p[2] < q[2];
        const NodePoint& low = is_up ? p : q;
        const unsigned axis = p[0] != q[0] ? 0 : p[1] != q[1] ? 1 : 2;
        return {low, LevelGrid::short_directions + axis};
    }
    const NodePoint& centre = p_is_centre ? p : q;
    const NodePoint& corner = p_is_centre ? q : p;
    unsigned direction = 0;
    for (unsigned k = 0; k < 3; ++k)
        if (corner[k] > centre[k]) direction |= 1U << k;
    return {centre, direction};
}

std::uint16_t bit(unsigned direction) { return static_cast<std::uint16_t>(1U << direction); }

}  // namespace

LevelVertices::LevelVertices(const LevelGrid& grid, std::span<const LevelCrossing> crossings,
                             const std::vector<std::int8_t>& signs,
                             const std::unordered_map<std::size_t, Point3d>& moved)
    : grid_(grid), signs_(signs), first_(grid.size()), mask_(grid.size()) {
    std::size_t next = 0;
    for (std::size_t n = 0; n < grid.size(); ++n) {
        first_[n] = static_cast<std::uint32_t>(places_.size());
        if (signs[n] == 0)
            add_node(n, moved.at(n));
        else if (signs[n] > 0 && is_corner_of_side(grid.point(n)))
            add_node(n, grid.place(grid.point(n)));
        const std::size_t begin = next;
        while (next < crossings.size() && crossings[next].node == n) ++next;
        add_edges(crossings.subspan(begin, next - begin));
    }
}

bool LevelVertices::is_corner_of_side(const NodePoint& p) const {
    return !grid_.is_inner(p) && grid_.is_node(p);
}

void LevelVertices::add_node(std::size_t node, const Point3d& place) {
    mask_[node] = itself;
    places_.push_back(place);
}

void LevelVertices::add_edges(std::span<const LevelCrossing> crossings) {
    for (const LevelCrossing& c : crossings) {
        if (signs_[c.node] == 0 || signs_[other_end(grid_, c)] == 0) continue;
        mask_[c.node] =
            static_cast<std::uint16_t>(mask_[c.node] | bit(static_cast<unsigned>(c.direction)));
        places_.push_back(place_on_edge(grid_, c));
    }
}

std::uint32_t LevelVertices::at_node(const NodePoint& p) const { return first_[grid_.number(p)]; }

std::uint32_t LevelVertices::on_edge(const NodePoint& p, const NodePoint& q) const {
    const auto [first, direction] = edge_between(p, q);
    const std::size_t node = grid_.number(first);
    const unsigned before = mask_[node] & (bit(direction) - 1U);
    const unsigned of_node = (mask_[node] & itself) != 0 ? 1 : 0;
    return first_[node] + of_node + static_cast<std::uint32_t>(std::popcount(before));
}

}  // namespace trisect::detail
