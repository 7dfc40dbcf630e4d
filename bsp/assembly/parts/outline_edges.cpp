// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/outline_edges.h>

#include <vector>

#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// Numbers of the faces among the facets that are worked on.
PoolVector<std::int32_t> add_faces(const NamedOutlines& outlines, BoundaryParts& parts) {
    PoolVector<std::int32_t> numbers;
    numbers.reserve(outlines.faces.size());
    for (const NamedOutlines::Face& face : outlines.faces) {
        const FacetMarks& marks = parts.sources[parts.table_of(face.source)];
        numbers.push_back(marks.number_of_worked(face.facet, face.flipped));
        BoundaryFacet& f = parts.facets[as_index(numbers.back())];
        f.support = parts.bench.plane(PlaneName::support(face.source, face.facet));
        f.parts = 1;
        ++parts.stats.traced_facets;
    }
    return numbers;
}

// Corners by their names. Mostly two edges of a face have one, and the second one finds it by its
// number.
class Corners {
public:
    explicit Corners(BoundaryParts& parts) : parts_(parts), known_(parts.sources.size()) {}

    PointId operator()(const NamedOutlines::Vertex& v) {
        const Source* const source = v.planes[0].source();
        if (source != source_) {
            source_ = source;
            of_source_ = &known_[parts_.table_of(source)];
            if (of_source_->empty()) of_source_->resize(source->mesh().points.size(), -1);
        }
        const std::uint32_t facet = v.planes[0].facet;
        PointId& known = (*of_source_)[source->corner_index(facet, v.corner)];
        if (known < 0) known = parts_.bench.corner(source, facet, v.corner);
        return known;
    }

private:
    BoundaryParts& parts_;
    std::vector<PoolVector<PointId>> known_;  // by table and corner
    const Source* source_ = nullptr;          // of the last one
    PoolVector<PointId>* of_source_ = nullptr;
};

}  // namespace

void add_outlines(const NamedOutlines& outlines, BoundaryParts& parts, BoundaryEdges& edges) {
    check_stop(outlines.edges.size());
    const PoolVector<std::int32_t> numbers = add_faces(outlines, parts);
    Corners corner(parts);
    const auto point = [&](const NamedOutlines::Vertex& v) {
        if (v.corner >= 0) return corner(v);
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
