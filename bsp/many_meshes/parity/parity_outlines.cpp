// SPDX-License-Identifier: Apache-2.0
//
// Of the four parts that two facets cut each other into at a segment, those below the other facet
// have one parity, since one more mesh is around them, and those above it the other one. Along the
// segment parities change where a third facet meets it.

#include <trisect/bsp/many_meshes/parity/parity_outlines.h>

#include <numeric>

namespace trisect::detail {

bool ParityOutlines::find(std::span<const std::uint8_t> is_crossed) {
    out_ = std::make_shared<OutlinedFacets>();
    if (!find_starts()) return false;
    list_by_second();
    std::size_t first = 0;
    std::size_t second = 0;
    for (const OutlinedSolid::Facet& f : all_.facets) {
        if (is_crossed[f.number] == 0) continue;
        add_own_edges(f);
        while (first < pairs_.size() && pairs_[first].facets[0] == f.number)
            add_segments(static_cast<std::uint32_t>(first++), 0);
        while (second < pairs_.size() && pairs_[seconds_[second]].facets[1] == f.number)
            add_segments(seconds_[second++], 1);
        end_facet(f.number);
    }
    append_odd();
    take_vertices();
    return true;
}

bool ParityOutlines::find_starts() {
    starts_.resize(pairs_.size());
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        const auto& ends = pierced_.ends(p);
        const bool start = !parities_.of_point(ends[0]);
        const bool changes = meetings_.of(p).size() % 2 != 0;
        if ((start != changes) == parities_.of_point(ends[1])) return false;
        starts_[p] = start ? 1 : 0;
    }
    return true;
}

void ParityOutlines::list_by_second() {
    PoolVector<std::uint32_t> next(all_.facets.size() + 1);
    for (const FacetCrossing& c : pairs_) ++next[c.facets[1] + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    seconds_.resize(pairs_.size());
    for (std::uint32_t p = 0; p < pairs_.size(); ++p) seconds_[next[pairs_[p].facets[1]]++] = p;
}

void ParityOutlines::add_own_edges(const OutlinedSolid::Facet& facet) {
    for (std::int8_t i = 0; i < 3; ++i) add_own_edge(facet.number, i);
}

void ParityOutlines::add_own_edge(std::uint32_t facet, std::int8_t i) {
    const OutlinedSolid::Edge& e = all_.edges[3 * facet + static_cast<std::uint32_t>(i)];
    bool odd = parities_.of_corner(e.from);
    std::uint32_t at = e.from;
    const auto add = [&](std::uint32_t to) {
        edges_[odd ? 1 : 0].push_back({at, to, 0, i, false});
        at = to;
        odd = !odd;
    };
    const std::span<const PiercedEdges::Stop> stops = pierced_.stops(e);
    if (e.from < e.to) {
        for (const PiercedEdges::Stop& s : stops) add(s.vertex);
    } else {
        for (std::size_t k = stops.size(); k-- > 0;) add(stops[k].vertex);
    }
    add(e.to);
}

// To the left of a crossing is what lies below the second facet on the first one, and above the
// first one on the second one.
void ParityOutlines::add_segments(std::uint32_t pair, std::size_t side) {
    const std::uint32_t cutter = pairs_[pair].facets[1 - side];
    const auto& ends = pierced_.ends(pair);
    bool odd = starts_[pair] != 0;
    std::uint32_t at = ends[0];
    const auto add = [&](std::uint32_t to) {
        const std::uint32_t from = side == 0 ? at : to;
        const std::uint32_t last = side == 0 ? to : at;
        edges_[odd ? 1 : 0].push_back({from, last, cutter, -1, true});
        edges_[odd ? 0 : 1].push_back({last, from, cutter, -1, false});
        at = to;
        odd = !odd;
    };
    for (const SegmentMeetings::Stop& s : meetings_.of(pair)) add(s.vertex);
    add(ends[1]);
}

void ParityOutlines::end_facet(std::uint32_t facet) {
    for (std::size_t k = 0; k < 2; ++k) {
        OutlinedFacets& to = k == 0 ? *out_ : odd_;
        if (!edges_[k].empty())
            to.facets.push_back({facet, static_cast<std::uint32_t>(to.edges.size()),
                                 static_cast<std::uint32_t>(edges_[k].size())});
        to.edges.insert(to.edges.end(), edges_[k].begin(), edges_[k].end());
        edges_[k].clear();
    }
}

// Parts of odd parity behind those of even parity.
void ParityOutlines::append_odd() {
    const auto first = static_cast<std::uint32_t>(out_->edges.size());
    const auto number = static_cast<std::uint32_t>(all_.facets.size());
    for (const OutlinedFacets::Facet& f : odd_.facets)
        out_->facets.push_back({f.number + number, f.first + first, f.count});
    out_->edges.insert(out_->edges.end(), odd_.edges.begin(), odd_.edges.end());
    odd_ = {};
}

// Those that edges have.
void ParityOutlines::take_vertices() {
    constexpr std::uint32_t unused = ~std::uint32_t{0};
    PoolVector<std::uint32_t> numbers(all_.vertices.size(), unused);
    for (const Edge& e : out_->edges) numbers[e.from] = numbers[e.to] = 0;
    std::uint32_t next = 0;
    for (std::uint32_t& n : numbers)
        if (n != unused) n = next++;
    out_->vertices.reserve(next);
    for (std::size_t v = 0; v < numbers.size(); ++v)
        if (numbers[v] != unused) out_->vertices.push_back(all_.vertices[v]);
    for (Edge& e : out_->edges) {
        e.from = numbers[e.from];
        e.to = numbers[e.to];
    }
}

}  // namespace trisect::detail
