// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/outline_edges.h>

#include <utility>
#include <vector>

#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

namespace {

// Corners by their names. Mostly two edges of a face have one, and the second one finds it by its
// number.
class Corners {
public:
    explicit Corners(Workbench& bench) : bench_(bench) {}

    PointId operator()(const NamedOutlines::Vertex& v) {
        const Source* const source = v.planes[0].source();
        if (source != source_) look_for(source);
        const std::uint32_t facet = v.planes[0].facet;
        PointId& known = known_[number_][source->corner_index(facet, v.corner)];
        if (known < 0) known = bench_.corner(source, facet, v.corner);
        return known;
    }

private:
    void look_for(const Source* source) {
        const auto next = static_cast<std::int32_t>(known_.size());
        const auto [number, is_new] = numbers_.insert(BoundaryParts::key_of(source), next);
        if (is_new) known_.emplace_back(source->mesh().points.size(), -1);
        source_ = source;
        number_ = as_index(number);
    }

    Workbench& bench_;
    FlatMap numbers_;                         // of sources
    std::vector<PoolVector<PointId>> known_;  // by number of the source, and by corner
    const Source* source_ = nullptr;          // the last one
    std::size_t number_ = 0;
};

}  // namespace

// Nearly every edge has a plane and a corner of its own.
OutlineNames name_outlines(const NamedOutlines& outlines, Workbench& bench) {
    OutlineNames out;
    bench.reserve_unnamed(4 * outlines.faces.size() + outlines.edges.size(), outlines.edges.size());
    out.supports.reserve(outlines.faces.size());
    for (const NamedOutlines::Face& f : outlines.faces)
        out.supports.push_back(bench.plane(PlaneName::support(f.source, f.facet)));
    Corners corner(bench);
    const auto point = [&](const NamedOutlines::Vertex& v) {
        if (v.corner >= 0) return corner(v);
        return bench.meet(bench.plane(v.planes[0]), bench.plane(v.planes[1]),
                          bench.plane(v.planes[2]));
    };
    out.edges.reserve(outlines.edges.size());
    for (const NamedOutlines::Edge& e : outlines.edges) {
        const PointId from = point(e.from);
        const PointId to = point(e.to);
        out.edges.push_back({from,
                             to,
                             static_cast<std::int32_t>(e.face),
                             {bench.plane(e.line.plane), e.line.above}});
    }
    return out;
}

void add_outlines(const NamedOutlines& outlines, OutlineNames names, BoundaryParts& parts,
                  BoundaryEdges& edges) {
    PoolVector<std::int32_t> numbers;
    numbers.reserve(outlines.faces.size());
    for (std::size_t i = 0; i < outlines.faces.size(); ++i) {
        const NamedOutlines::Face& face = outlines.faces[i];
        const FacetMarks& marks = parts.sources[parts.table_of(face.source)];
        numbers.push_back(marks.number_of_worked(face.facet, face.flipped));
        BoundaryFacet& f = parts.facets[as_index(numbers.back())];
        f.support = names.supports[i];
        f.parts = 1;
        ++parts.stats.traced_facets;
    }
    for (BoundaryEdge& e : names.edges) e.facet = numbers[as_index(e.facet)];
    if (edges.empty()) {
        edges = std::move(names.edges);
    } else {
        edges.insert(edges.end(), names.edges.begin(), names.edges.end());
    }
}

}  // namespace trisect::detail
