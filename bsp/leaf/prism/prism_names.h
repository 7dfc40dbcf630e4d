// SPDX-License-Identifier: Apache-2.0
//
// Names of planes, vertices and edges at the side faces of prisms.
#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include <trisect/bsp/cells/named_outlines.h>
#include <trisect/bsp/leaf/prism/prism_facets.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

/// Of the side faces of a list, which must outlive it. Where a wall passes through as it is, all
/// corners of its facets are vertices, and what is outlined beside it has them in its edges. Where
/// nothing beside it is whole, assembly takes them out again.
class PrismNames {
public:
    /// Where an interval of a side face ends: at the side face of that number, which crosses it, or
    /// with the side face itself.
    using Bound = LeafIndex;
    static constexpr Bound at_from = -1;
    static constexpr Bound at_to = -2;

    explicit PrismNames(const PrismFacets& facets) : facets_(&facets) {}

    [[nodiscard]] const PrismSideFace& side_face(LeafIndex i) const {
        return facets_->side_faces()[as_index(i)];
    }
    [[nodiscard]] PlaneName support_of(LeafIndex i) const {
        const PolygonRef& f = side_face(i).facets[0];
        return PlaneName::support(f.source, f.facet);
    }
    [[nodiscard]] PlaneName plane_at(std::size_t position) const {
        const PolygonRef& f = facets_->cap_at(position);
        return PlaneName::support(f.source, f.facet);
    }
    [[nodiscard]] NamedOutlines::Vertex vertex(LeafIndex i, Bound b, std::size_t position) const;
    /// Corners of a wall within its edge at a position. `all`: the edge is all of the side face's,
    /// where it ends.
    [[nodiscard]] std::span<const PrismCorner> corners_between(LeafIndex i, std::size_t position,
                                                               bool all) const;
    /// Those between two positions.
    [[nodiscard]] std::span<const PrismCorner> corners_upright(LeafIndex i, Bound b,
                                                               std::size_t below,
                                                               std::size_t above) const;
    /// Calls out() for the parts of an edge between corners within it. `turned`: from its end to
    /// its beginning.
    template <class Out>
    static void divide(const PrismSideFace& w, NamedOutlines::Edge edge,
                       std::span<const PrismCorner> between, bool turned, const Out& out);

private:
    [[nodiscard]] static NamedOutlines::Vertex vertex_of(const PrismSideFace& w,
                                                         const PrismCorner& c) {
        return NamedOutlines::Vertex::corner_of(w.facets[0].source, c.facet, c.corner);
    }
    [[nodiscard]] Coordinate height_of(const PrismSideFace& w, const PrismCorner& c) const {
        return coordinate(w.facets[0].source->corner(c.facet, c.corner), facets_->axis());
    }

    const PrismFacets* facets_;
};

template <class Out>
void PrismNames::divide(const PrismSideFace& w, NamedOutlines::Edge edge,
                        std::span<const PrismCorner> between, bool turned, const Out& out) {
    if (between.empty()) {
        if (turned) std::swap(edge.from, edge.to);
        return out(edge);
    }
    const NamedOutlines::Vertex end = edge.to;
    const auto add = [&](const NamedOutlines::Vertex& to) {
        edge.to = to;
        NamedOutlines::Edge part = edge;
        if (turned) std::swap(part.from, part.to);
        out(part);
        edge.from = to;
    };
    for (const PrismCorner& c : between) add(vertex_of(w, c));
    add(end);
}

}  // namespace trisect::detail
