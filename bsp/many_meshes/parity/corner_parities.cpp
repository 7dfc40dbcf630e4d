// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/parity/corner_parities.h>

#include <algorithm>

#include <trisect/bsp/many_meshes/point_side.h>

namespace trisect::detail {

bool CornerParities::find(std::span<const std::uint8_t> is_crossed) {
    const std::size_t corners = pierced_.first_vertex();
    parents_.resize(corners);
    for (std::uint32_t v = 0; v < corners; ++v) parents_[v] = {v, false};
    corners_.assign(corners, 0);
    if (!join_edges(is_crossed)) return false;
    find_roots();
    find_points();
    return true;
}

CornerParities::Root CornerParities::root(std::uint32_t vertex) {
    bool is_other = false;
    while (parents_[vertex].vertex != vertex) {
        Root& parent = parents_[vertex];
        const Root next = parents_[parent.vertex];
        parent = {next.vertex, parent.is_other != next.is_other};
        is_other = is_other != parent.is_other;
        vertex = parent.vertex;
    }
    return {vertex, is_other};
}

bool CornerParities::join(std::uint32_t a, std::uint32_t b, bool differ) {
    const Root of_a = root(a);
    const Root of_b = root(b);
    const bool roots_differ = (of_a.is_other != of_b.is_other) != differ;
    if (of_a.vertex == of_b.vertex) return !roots_differ;
    const auto [low, high] = std::minmax(of_a.vertex, of_b.vertex);
    parents_[high] = {low, roots_differ};
    return true;
}

// Each edge goes both ways in the facets that have it.
bool CornerParities::join_edges(std::span<const std::uint8_t> is_crossed) {
    for (const OutlinedSolid::Facet& f : all_.facets)
        for (const OutlinedSolid::Edge& e : all_.edges_of(f)) {
            if (e.from > e.to) continue;
            const bool differ = is_crossed[f.number] != 0 && pierced_.stops(e).size() % 2 != 0;
            if (!join(e.from, e.to, differ)) return false;
        }
    return true;
}

std::size_t CornerParities::boxes_around(std::uint32_t vertex, std::size_t slot) const {
    OutlineBox point = OutlineBox::none();
    point.add(all_.vertices[vertex].at);
    std::size_t n = 0;
    for (std::size_t i = 0; i < solids_.size(); ++i)
        if (i != slot && solids_[i].box.meets(point)) ++n;
    return n;
}

bool CornerParities::parity_at(std::uint32_t vertex, std::size_t slot) const {
    bool odd = false;
    for (std::size_t i = 0; i < solids_.size(); ++i)
        if (i != slot) odd = odd != is_open_at_corner(all_.vertices[vertex], solids_[i], exact_);
    return odd;
}

// Of a few corners of what hangs together the one that the fewest boxes are around.
void CornerParities::find_roots() {
    constexpr std::uint32_t most_tried = 64;
    struct Best {
        std::uint32_t vertex = 0;
        std::uint32_t slot = 0;
        std::size_t boxes = 0;
        std::uint32_t tried = 0;
    };
    PoolVector<std::uint32_t> slots(corners_.size());
    for (const OutlinedSolid::Facet& f : all_.facets)
        for (const OutlinedSolid::Edge& e : all_.edges_of(f)) slots[e.from] = f.slot;
    PoolVector<Best> best(corners_.size());
    for (std::uint32_t v = 0; v < corners_.size(); ++v) {
        Best& b = best[root(v).vertex];
        if (b.tried == most_tried || (b.tried > 0 && b.boxes == 0)) continue;
        const std::size_t boxes = boxes_around(v, slots[v]);
        if (b.tried++ == 0 || boxes < b.boxes) b = {v, slots[v], boxes, b.tried};
    }
    for (std::uint32_t v = 0; v < corners_.size(); ++v) {
        const Best& b = best[v];
        if (b.tried == 0) continue;
        const bool odd = parity_at(b.vertex, b.slot) != root(b.vertex).is_other;
        corners_[v] = odd ? 1 : 0;
    }
    for (std::uint32_t v = 0; v < corners_.size(); ++v) {
        const Root r = root(v);
        if (r.vertex != v) corners_[v] = (corners_[r.vertex] != 0) != r.is_other ? 1 : 0;
    }
}

// Below the facet a point is in its mesh.
void CornerParities::find_points() {
    points_.assign(all_.vertices.size() - pierced_.first_vertex(), 0);
    for (std::size_t i = 0; i < pierced_.edge_count(); ++i) {
        const OutlinedSolid::Edge& e = all_.edges[pierced_.edge(i)];
        bool odd = of_corner(std::min(e.from, e.to));
        for (const PiercedEdges::Stop& s : pierced_.stops_of(i)) {
            points_[s.vertex - pierced_.first_vertex()] = odd != s.rises ? 1 : 0;
            odd = !odd;
        }
    }
}

}  // namespace trisect::detail
