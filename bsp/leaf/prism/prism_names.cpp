// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/prism/prism_names.h>

#include <algorithm>

namespace trisect::detail {

std::span<const PrismCorner> PrismNames::corners_between(LeafIndex i, std::size_t position,
                                                         bool all) const {
    const PrismSideFace& w = side_face(i);
    if (w.wall < 0 || !all) return {};
    const bool is_low = position + 1 == w.first_layer;
    const auto side = facets_->walls().side(w.wall, is_low ? PrismWalls::Bottom : PrismWalls::Top);
    return side.subspan(1, side.size() - 2);
}

std::span<const PrismCorner> PrismNames::corners_upright(LeafIndex i, Bound b, std::size_t below,
                                                         std::size_t above) const {
    const PrismSideFace& w = side_face(i);
    if (w.wall < 0 || b >= 0) return {};
    const auto side =
        facets_->walls().side(w.wall, b == at_from ? PrismWalls::AtFrom : PrismWalls::AtTo);
    const auto first = std::ranges::partition_point(
        side, [&](const PrismCorner& c) { return height_of(w, c) <= facets_->positions()[below]; });
    const auto end = std::ranges::partition_point(
        side, [&](const PrismCorner& c) { return height_of(w, c) < facets_->positions()[above]; });
    return {first, end};
}

NamedOutlines::Vertex PrismNames::vertex(LeafIndex i, Bound b, std::size_t position) const {
    using Vertex = NamedOutlines::Vertex;
    if (b >= 0) return Vertex::meet(support_of(i), support_of(b), plane_at(position));
    const PrismSideFace& w = side_face(i);
    const std::size_t end = b == at_from ? 0 : 1;
    const bool is_low = position + 1 == w.first_layer;
    if (is_low || position + 1 == w.end_layer)
        return vertex_of(w, facets_->corner_of(w, end, !is_low));
    if (w.wall >= 0)
        for (const PrismCorner& c :
             facets_->walls().side(w.wall, end == 0 ? PrismWalls::AtFrom : PrismWalls::AtTo))
            if (height_of(w, c) == facets_->positions()[position]) return vertex_of(w, c);
    const PolygonRef& f = w.facets[end];
    return Vertex::meet(support_of(i), PlaneName::edge(f.source, f.facet, w.upright[end].edge),
                        plane_at(position));
}

}  // namespace trisect::detail
