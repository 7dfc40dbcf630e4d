// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/outline_edges.h>

#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

void add_outlines(const NamedOutlines& outlines, BoundaryParts& parts, BoundaryEdges& edges) {
    check_stop(outlines.edges.size());
    PoolVector<std::int32_t> numbers;
    numbers.reserve(outlines.faces.size());
    for (const NamedOutlines::Face& face : outlines.faces) {
        const FacetMarks& marks = parts.sources[parts.table_of(face.source)];
        numbers.push_back(marks.number_of_worked(face.facet, face.flipped));
        BoundaryFacet& f = parts.facets[static_cast<std::size_t>(numbers.back())];
        f.support = parts.bench.plane(PlaneName::support(face.source, face.facet));
        f.parts = 1;
        ++parts.stats.traced_facets;
    }
    const auto point = [&](const NamedOutlines::Vertex& v) {
        if (v.corner >= 0)
            return parts.bench.corner(v.planes[0].source(), v.planes[0].facet, v.corner);
        return parts.bench.meet(parts.bench.plane(v.planes[0]), parts.bench.plane(v.planes[1]),
                                parts.bench.plane(v.planes[2]));
    };
    edges.reserve(edges.size() + outlines.edges.size());
    for (const NamedOutlines::Edge& e : outlines.edges) {
        const PointId from = point(e.from);
        const PointId to = point(e.to);
        edges.push_back(
            {from, to, numbers[e.face], {parts.bench.plane(e.line.plane), e.line.above}});
    }
}

}  // namespace trisect::detail
