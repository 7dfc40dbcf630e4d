// SPDX-License-Identifier: Apache-2.0
//
// Two boundaries in general position cross in closed polylines, and only there the side changes on
// which one lies of the other. So a vertex beside a crossing has a known side, and shares it with
// all to which it is joined by edges that nothing pierces. What is kept of a facet is bounded by
// the pieces of its edges on the open side, and by the crossings themselves; of a part in several
// pieces one may go that nothing crosses. No piece is made that does not bound the result, and an
// edge that two facets share is pierced in the same vertices.
//
// Facets whose boxes do not meet that of the other solid lie far out of it: they are kept as they
// are, or not at all. Mostly these are many more than the others; then vertices keep their numbers.

#include <trisect/bsp/many_meshes/common_part.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/many_meshes/buckets.h>
#include <trisect/bsp/many_meshes/common_segments.h>
#include <trisect/bsp/many_meshes/crossed_facets.h>
#include <trisect/bsp/many_meshes/point_side.h>
#include <trisect/bsp/many_meshes/spare_outlines.h>
#include <trisect/bsp/many_meshes/vertex_sides.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

}  // namespace

class CommonPart::Steps {
public:
    Steps(const ManyMeshes& meshes, const EvaluateSettings& options)
        : meshes_(meshes),
          special_(meshes.facet_count()),
          exact_(meshes, special_),
          finder_(meshes, options, special_),
          segments_(meshes, exact_) {}

    /// Takes what the first one has.
    [[nodiscard]] bool run(OutlinedSolid& first, OutlinedSolid& second, EvaluateStats& stats) {
        start(first, second);
        if (!find_cuts(stats)) return false;
        for (std::size_t i = 0; i < 2; ++i) {
            stops_[i].sort(solids_[i]->edges.size());
            cuts_[i].sort(solids_[i]->facets.size());
            if (!find_sides(i)) return false;
        }
        keeps_numbers_ = keeps_most_vertices();
        if (keeps_numbers_ && 2 * first.unused_edges <= first.edges.size()) {
            stay_in(first);
        } else {
            reserve();
            if (keeps_numbers_) take_vertices(first);
            keep_parts(0);
        }
        keep_parts(1);
        out_.open_far_out = first.open_far_out && second.open_far_out;
        if (!lines_->empty()) out_.lines.push_back(std::move(lines_));
        return true;
    }
    [[nodiscard]] OutlinedSolid result() { return std::move(out_); }
    [[nodiscard]] SpareOutlines& spare() { return spare_; }
    [[nodiscard]] const SpecialPosition& special() const { return special_; }

private:
    // Where an edge of a part pierces the other solid.
    struct Stop {
        std::uint32_t vertex = 0;  // of those that were made
        bool opens = false;        // what follows along the edge
        std::uint32_t cutter = 0;
        std::uint32_t place = 0;  // of the part
        double along = 0;
    };
    // A crossing on a part, with what is open on its left.
    struct Cut {
        std::uint32_t from = 0;  // vertices that were made
        std::uint32_t to = 0;
        const FacetCrossing* line = nullptr;
    };
    using Side = VertexSides::Side;

    void start(const OutlinedSolid& first, const OutlinedSolid& second);
    void find_near(std::size_t solid);
    [[nodiscard]] bool find_cuts(EvaluateStats& stats);
    void reserve();
    [[nodiscard]] bool keeps_most_vertices() const;
    void take_vertices(OutlinedSolid& first);
    void add_vertices_of_second();
    void stay_in(OutlinedSolid& first);
    void keep_where_they_are();
    void add_cut(const std::array<std::uint32_t, 2>& places, const CommonSegment& segment,
                 const FacetCrossing& line);
    [[nodiscard]] std::uint32_t vertex_at(const CommonSegment::End& end,
                                          const std::array<std::uint32_t, 2>& places);
    // To the facet of the other solid that it crosses.
    [[nodiscard]] bool is_open_below(std::size_t solid,
                                     const std::array<std::uint32_t, 2>& places) const {
        const auto slot = [&](std::size_t i) { return solids_[i]->facets[places[i]].slot; };
        return meshes_.is_open_below(slot(solid), slot(1 - solid));
    }
    [[nodiscard]] bool find_sides(std::size_t solid);
    [[nodiscard]] bool sort_stops(const OutlinedSolid::Edge& edge, std::uint32_t facet,
                                  const OutlinedSolid& solid, std::span<Stop> stops) const;
    [[nodiscard]] int order_of_stops(const OutlinedSolid::Edge& edge, std::uint32_t facet,
                                     const Stop& a, const Stop& b) const;
    [[nodiscard]] std::optional<bool> side_of_part(std::size_t solid, std::uint32_t root);
    void list_vertices(std::size_t solid);
    [[nodiscard]] bool mark_ends(std::size_t solid);
    void mark_beyond(std::size_t solid);
    void keep_parts(std::size_t solid);
    [[nodiscard]] bool is_untouched(std::size_t solid, std::uint32_t place) const;
    [[nodiscard]] bool is_all_open(std::size_t solid, const OutlinedSolid::Facet& f) const;
    void keep_all(std::size_t solid, std::uint32_t place);
    void keep_cut(std::size_t solid, std::uint32_t place);
    [[nodiscard]] std::uint32_t add_edges_of_cut(std::size_t solid, std::uint32_t place);
    [[nodiscard]] OutlineBox box_of_edges(std::uint32_t first) const;
    [[nodiscard]] std::uint32_t kept_vertex(std::size_t solid, std::uint32_t v);
    [[nodiscard]] std::uint32_t kept_made(std::uint32_t v);
    // Of a vertex of a facet that is near.
    [[nodiscard]] bool is_open(std::size_t solid, std::uint32_t v) const {
        return sides_[solid].of(v) == Side::Open;
    }
    // What is far out of the other solid.
    [[nodiscard]] bool is_far_open(std::size_t solid) const { return open_far_out_[1 - solid]; }

    const ManyMeshes& meshes_;
    SpecialPosition special_;
    ShiftedPoints exact_;
    std::array<const OutlinedSolid*, 2> solids_{};
    std::array<bool, 2> open_far_out_{};
    CrossedFacetsFinder finder_;
    CommonSegments segments_;
    std::unique_ptr<OutlinedSolid::Lines> lines_;
    std::vector<OutlineVertex> made_;
    FlatMap made_by_name_;
    std::array<Buckets<Stop>, 2> stops_;              // by edge
    std::array<std::vector<std::uint32_t>, 2> near_;  // places whose boxes meet the other solid's
    std::array<Buckets<Cut>, 2> cuts_;                // by place
    std::array<VertexSides, 2> sides_;                // of vertices of facets that are near
    std::array<std::vector<std::uint32_t>, 2> kept_;  // by vertex: its number in the result
    std::vector<std::uint32_t> kept_made_;
    // Added to a vertex's number, where all keep theirs.
    bool keeps_numbers_ = false;
    std::array<std::uint32_t, 2> added_{};
    OutlinedSolid out_;
    SpareOutlines spare_;
};

void CommonPart::Steps::start(const OutlinedSolid& first, const OutlinedSolid& second) {
    solids_ = {&first, &second};
    open_far_out_ = {first.open_far_out, second.open_far_out};
    segments_.start(first, second);
    made_.clear();
    made_by_name_.clear();
    kept_made_.clear();
    for (std::size_t i = 0; i < 2; ++i) {
        stops_[i].clear();
        cuts_[i].clear();
        find_near(i);
    }
    out_ = {};
}

void CommonPart::Steps::find_near(std::size_t solid) {
    near_[solid].clear();
    const std::vector<OutlineBox>& boxes = solids_[solid]->boxes;
    for (std::uint32_t f = 0; f < boxes.size(); ++f)
        if (boxes[f].meets(solids_[1 - solid]->box)) near_[solid].push_back(f);
}

bool CommonPart::Steps::find_cuts(EvaluateStats& stats) {
    if (!finder_.find(*solids_[0], *solids_[1], {near_[0], near_[1]}, stats)) return false;
    lines_ = std::make_unique<OutlinedSolid::Lines>();
    lines_->reserve(finder_.pairs().size());  // lines stay where they are
    for (const CrossedFacets& c : finder_.pairs()) {
        if (!segments_.find(c.places, c.crossing)) return false;
        if (segments_.segments().empty()) continue;
        const FacetCrossing& line = lines_->emplace_back(c.crossing);
        for (const CommonSegment& s : segments_.segments()) add_cut(c.places, s, line);
    }
    return true;
}

// On the first facet what lies below the second one is to the left of the crossing, on the second
// one what lies above the first.
void CommonPart::Steps::add_cut(const std::array<std::uint32_t, 2>& places,
                                const CommonSegment& segment, const FacetCrossing& line) {
    const std::array<bool, 2> along{is_open_below(1, places), !is_open_below(0, places)};
    std::array<std::uint32_t, 2> ends{};
    for (std::size_t k = 0; k < 2; ++k) {
        const CommonSegment::End& end = segment.ends[k];
        ends[k] = vertex_at(end, places);
        const std::size_t owner = end.of_second ? 1 : 0;
        // Walking on along the edge one comes to the left of what ends there.
        const std::uint32_t cutter = solids_[1 - owner]->facets[places[1 - owner]].number;
        stops_[owner].add(end.edge, {ends[k], (k == 1) == along[owner], cutter, places[owner]});
    }
    for (std::size_t i = 0; i < 2; ++i)
        cuts_[i].add(places[i], {ends[along[i] ? 0 : 1], ends[along[i] ? 1 : 0], &line});
}

// Two facets share the edge.
std::uint32_t CommonPart::Steps::vertex_at(const CommonSegment::End& end,
                                           const std::array<std::uint32_t, 2>& places) {
    const std::size_t owner = end.of_second ? 1 : 0;
    const OutlinedSolid::Edge& e = solids_[owner]->edges[end.edge];
    const auto [low, high] = std::minmax(e.from, e.to);
    const Key128 name{std::uint64_t{low} << 32 | high,
                      std::uint64_t{places[1 - owner]} << 1 | owner};
    const auto [number, is_new] =
        made_by_name_.insert(name, static_cast<std::int32_t>(made_.size()));
    if (!is_new) return static_cast<std::uint32_t>(number);
    OutlineVertex& v = made_.emplace_back();
    v.at = end.at;
    const std::uint32_t own = solids_[owner]->facets[places[owner]].number;
    const std::uint32_t other = solids_[1 - owner]->facets[places[1 - owner]].number;
    if (const FacetCrossing* line = e.origin.line(); line == nullptr) {
        v.kind = OutlineVertex::Kind::Pierce;
        v.which = e.origin.own();
        v.facets = {own, other, 0};
    } else {
        v.kind = OutlineVertex::Kind::Meeting;
        v.facets = {line->facets[0], line->facets[1], other};
    }
    return static_cast<std::uint32_t>(number);
}

bool CommonPart::Steps::sort_stops(const OutlinedSolid::Edge& edge, std::uint32_t facet,
                                   const OutlinedSolid& solid, std::span<Stop> stops) const {
    if (stops.size() < 2) return true;
    const Approximation& a = solid.vertices[edge.from].at;
    const Approximation& b = solid.vertices[edge.to].at;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(b.c[k] - a.c[k]) > std::fabs(b.c[axis] - a.c[axis])) axis = k;
    const double length = b.c[axis] - a.c[axis];
    const bool has_way = std::fabs(length) > bound_slack * (a.error + b.error);
    const double way = length > 0 ? 1 : -1;
    for (Stop& s : stops) s.along = way * made_[s.vertex].at.c[axis];
    bool known = true;
    // Stable sorting stays within its range, whatever the answers.
    std::ranges::stable_sort(stops, [&](const Stop& s, const Stop& t) {
        const double error = bound_slack * (made_[s.vertex].at.error + made_[t.vertex].at.error);
        if (has_way && std::fabs(t.along - s.along) > error) return s.along < t.along;
        if (s.vertex == t.vertex) return false;
        const int order = order_of_stops(edge, facet, s, t);
        known = known && order != 0;
        return order < 0;
    });
    return known;
}

// Exactly: -1 where the first one comes before the other one. An edge in a segment goes along its
// line where that has what is open on its left (add_cut).
int CommonPart::Steps::order_of_stops(const OutlinedSolid::Edge& edge, std::uint32_t facet,
                                      const Stop& a, const Stop& b) const {
    const FacetCrossing* crossing = edge.origin.line();
    if (crossing == nullptr)
        return exact_.order_on_edge(facet, edge.origin.own(), a.cutter, b.cutter);
    const std::array<std::uint32_t, 2>& line = crossing->facets;
    const std::size_t own = line[0] == facet ? 0 : 1;
    const bool open_below =
        meshes_.is_open_below(meshes_.slot_of(line[1 - own]), meshes_.slot_of(facet));
    const bool along = open_below == (own == 0);
    return (along ? 1 : -1) * exact_.order_on_line(line, a.cutter, b.cutter);
}

// Of facets that are near. Each is where an edge begins.
void CommonPart::Steps::list_vertices(std::size_t solid) {
    const OutlinedSolid& s = *solids_[solid];
    VertexSides& sides = sides_[solid];
    const Buckets<Stop>& stops = stops_[solid];
    sides.start(s.vertices.size());
    for (const std::uint32_t f : near_[solid]) {
        const OutlinedSolid::Facet& facet = s.facets[f];
        const std::uint32_t end = facet.first + facet.count;
        for (std::uint32_t e = facet.first; e < end; ++e) sides.list(s.edges[e].from);
        for (std::uint32_t e = facet.first; e < end; ++e)
            if (!stops.has(e)) sides.join(s.edges[e].from, s.edges[e].to);
    }
}

// Of the edges that are pierced.
bool CommonPart::Steps::mark_ends(std::size_t solid) {
    const OutlinedSolid& s = *solids_[solid];
    VertexSides& sides = sides_[solid];
    for (const Buckets<Stop>::Bucket& b : stops_[solid].buckets()) {
        const OutlinedSolid::Edge& edge = s.edges[b.key];
        const std::span<Stop> stops = stops_[solid].of(b);
        if (!sort_stops(edge, s.facets[stops.front().place].number, s, stops)) return false;
        for (std::size_t i = 1; i < stops.size(); ++i)
            if (stops[i].opens == stops[i - 1].opens) return false;
        if (!sides.mark(edge.from, stops.front().opens ? Side::Closed : Side::Open) ||
            !sides.mark(edge.to, stops.back().opens ? Side::Open : Side::Closed))
            return false;
    }
    return true;
}

// What is surely beyond the other solid's box is far out.
void CommonPart::Steps::mark_beyond(std::size_t solid) {
    const OutlinedSolid& s = *solids_[solid];
    const OutlineBox& other = solids_[1 - solid]->box;
    const Side far = is_far_open(solid) ? Side::Open : Side::Closed;
    VertexSides& sides = sides_[solid];
    for (const std::uint32_t v : sides.listed())
        if (sides.of(v) == Side::Unknown && other.is_beside(s.vertices[v].at)) sides.of(v) = far;
}

bool CommonPart::Steps::find_sides(std::size_t solid) {
    VertexSides& sides = sides_[solid];
    list_vertices(solid);
    if (!mark_ends(solid)) return false;
    mark_beyond(solid);
    for (const std::uint32_t v : sides.listed())
        if (const Side side = sides.of(v);
            side != Side::Unknown && !sides.mark(sides.root(v), side))
            return false;
    for (const std::uint32_t v : sides.listed()) {
        const std::uint32_t root = sides.root(v);
        if (sides.of(root) == Side::Unknown) {
            const auto open = side_of_part(solid, root);
            if (!open) return false;
            sides.of(root) = *open ? Side::Open : Side::Closed;
        }
        if (!sides.mark(v, sides.of(root))) return false;
    }
    return true;
}

// Of vertices that hang together and that nothing separates from the other solid.
std::optional<bool> CommonPart::Steps::side_of_part(std::size_t solid, std::uint32_t root) {
    const OutlinedSolid& s = *solids_[solid];
    const OutlinedSolid& other = *solids_[1 - solid];
    VertexSides& sides = sides_[solid];
    if (const auto open = is_open_at(s.vertices[root].at, other, segments_, 1 - solid)) return open;
    for (const std::uint32_t v : sides.listed())
        if (s.vertices[v].kind == OutlineVertex::Kind::Corner && sides.root(v) == root)
            return is_open_at_corner(s.vertices[v], other, exact_);
    // None is left of them. Another vertex may be clear of the other solid's boundary.
    for (const std::uint32_t v : sides.listed())
        if (v != root && sides.root(v) == root)
            if (const auto open = is_open_at(s.vertices[v].at, other, segments_, 1 - solid))
                return open;
    return std::nullopt;
}

void CommonPart::Steps::reserve() {
    const auto both = [&](auto size) { return size(*solids_[0]) + size(*solids_[1]); };
    const std::size_t facets = both([](const OutlinedSolid& s) { return s.facets.size(); });
    out_ = spare_.take(
        facets, both([](const OutlinedSolid& s) { return s.edges.size(); }) + 4 * made_.size(),
        both([](const OutlinedSolid& s) { return s.vertices.size(); }) + made_.size());
}

// Whether vertices keep their numbers: where most are kept, and few before were not.
bool CommonPart::Steps::keeps_most_vertices() const {
    std::size_t facets = 0;
    std::size_t vertices = 0;
    std::size_t edges = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        const OutlinedSolid& s = *solids_[i];
        facets += s.facets.size();
        vertices += s.vertices.size();
        edges += s.edges.size() - s.unused_edges;
        if (is_far_open(i)) kept += s.facets.size() - near_[i].size();
        for (const std::uint32_t f : near_[i])
            kept += is_open(i, s.edges[s.facets[f].first].from) ? 1 : 0;
    }
    return 2 * kept > facets && 3 * vertices <= 2 * edges;
}

// Into whichever has room for all.
void CommonPart::Steps::take_vertices(OutlinedSolid& first) {
    const std::size_t all = first.vertices.size() + solids_[1]->vertices.size() + made_.size();
    added_ = {0, static_cast<std::uint32_t>(first.vertices.size())};
    if (first.vertices.capacity() >= all)
        std::swap(out_.vertices, first.vertices);
    else
        out_.vertices.assign(first.vertices.begin(), first.vertices.end());
    add_vertices_of_second();
}

void CommonPart::Steps::add_vertices_of_second() {
    const std::vector<OutlineVertex>& more = solids_[1]->vertices;
    out_.vertices.insert(out_.vertices.end(), more.begin(), more.end());
}

// What is kept of the first solid stays where it is, the second one's is added.
void CommonPart::Steps::stay_in(OutlinedSolid& first) {
    added_ = {0, static_cast<std::uint32_t>(first.vertices.size())};
    out_ = std::move(first);
    solids_[0] = &out_;
    const OutlinedSolid& second = *solids_[1];
    spare_.make_room(out_, second.facets.size(), second.edges.size() + 4 * made_.size(),
                     second.vertices.size() + made_.size());
    add_vertices_of_second();
    keep_where_they_are();
}

// Facets move to the front. What is cut gets edges behind all others.
void CommonPart::Steps::keep_where_they_are() {
    kept_made_.resize(made_.size(), none);
    out_.box = OutlineBox::none();
    std::uint32_t kept = 0;
    auto near = near_[0].begin();
    for (std::uint32_t f = 0; f < out_.facets.size(); ++f) {
        OutlinedSolid::Facet facet = out_.facets[f];
        const bool is_near = near != near_[0].end() && *near == f;
        if (is_near) ++near;
        const bool untouched = !is_near || is_untouched(0, f);
        if (!untouched || (is_near && !is_all_open(0, facet))) {
            out_.unused_edges += facet.count;
            if (untouched && facet.whole) continue;
            facet.first = add_edges_of_cut(0, f);
            facet.count = static_cast<std::uint32_t>(out_.edges.size()) - facet.first;
            facet.whole = false;
            if (facet.count == 0) continue;
            out_.boxes[f] = box_of_edges(facet.first);
        } else if (!is_near && !is_far_open(0)) {
            out_.unused_edges += facet.count;
            continue;
        }
        out_.facets[kept] = facet;
        out_.boxes[kept] = out_.boxes[f];
        out_.box.add(out_.boxes[kept]);
        ++kept;
    }
    out_.facets.resize(kept);
    out_.boxes.resize(kept);
}

std::uint32_t CommonPart::Steps::kept_vertex(std::size_t solid, std::uint32_t v) {
    if (keeps_numbers_) return added_[solid] + v;
    std::uint32_t& number = kept_[solid][v];
    if (number != none) return number;
    number = static_cast<std::uint32_t>(out_.vertices.size());
    out_.vertices.push_back(solids_[solid]->vertices[v]);
    return number;
}

std::uint32_t CommonPart::Steps::kept_made(std::uint32_t v) {
    std::uint32_t& number = kept_made_[v];
    if (number != none) return number;
    number = static_cast<std::uint32_t>(out_.vertices.size());
    out_.vertices.push_back(made_[v]);
    return number;
}

// Those from an edge on, which are one facet's.
OutlineBox CommonPart::Steps::box_of_edges(std::uint32_t first) const {
    OutlineBox box = OutlineBox::none();
    for (std::size_t e = first; e < out_.edges.size(); ++e)
        box.add(out_.vertices[out_.edges[e].from].at);
    return box;
}

// A facet, or what there is of it.
void CommonPart::Steps::keep_all(std::size_t solid, std::uint32_t place) {
    const OutlinedSolid& s = *solids_[solid];
    const OutlinedSolid::Facet& f = s.facets[place];
    const auto first = static_cast<std::uint32_t>(out_.edges.size());
    if (keeps_numbers_) {
        const std::uint32_t added = added_[solid];
        for (const OutlinedSolid::Edge& e : s.edges_of(f))
            out_.edges.push_back({added + e.from, added + e.to, e.origin});
    } else {
        for (const OutlinedSolid::Edge& e : s.edges_of(f))
            out_.edges.push_back({kept_vertex(solid, e.from), kept_vertex(solid, e.to), e.origin});
    }
    out_.facets.push_back({f.number, f.slot, first, f.count, f.whole});
    out_.boxes.push_back(s.boxes[place]);
    out_.box.add(s.boxes[place]);
}

bool CommonPart::Steps::is_untouched(std::size_t solid, std::uint32_t place) const {
    if (cuts_[solid].has(place)) return false;
    const OutlinedSolid::Facet& f = solids_[solid]->facets[place];
    for (std::uint32_t e = f.first; !f.whole && e < f.first + f.count; ++e)
        if (stops_[solid].has(e)) return false;
    return true;
}

// Of one that nothing touches, which a facet is as a whole.
bool CommonPart::Steps::is_all_open(std::size_t solid, const OutlinedSolid::Facet& f) const {
    const auto edges = solids_[solid]->edges_of(f).first(f.whole ? 1 : f.count);
    return std::ranges::all_of(
        edges, [&](const OutlinedSolid::Edge& e) { return is_open(solid, e.from); });
}

void CommonPart::Steps::keep_cut(std::size_t solid, std::uint32_t place) {
    const OutlinedSolid::Facet& f = solids_[solid]->facets[place];
    const std::uint32_t first = add_edges_of_cut(solid, place);
    const auto count = static_cast<std::uint32_t>(out_.edges.size()) - first;
    if (count == 0) return;
    out_.facets.push_back({f.number, f.slot, first, count, false});
    out_.boxes.push_back(box_of_edges(first));
    out_.box.add(out_.boxes.back());
}

// The first of them. The solid may be the one that they are added to.
std::uint32_t CommonPart::Steps::add_edges_of_cut(std::size_t solid, std::uint32_t place) {
    const OutlinedSolid& s = *solids_[solid];
    const OutlinedSolid::Facet f = s.facets[place];
    const auto first = static_cast<std::uint32_t>(out_.edges.size());
    for (std::uint32_t e = f.first; e < f.first + f.count; ++e) {
        const OutlinedSolid::Edge edge = s.edges[e];
        bool open = is_open(solid, edge.from);
        std::uint32_t at = open ? kept_vertex(solid, edge.from) : none;
        for (const Stop& stop : stops_[solid].of(e)) {
            const std::uint32_t next = kept_made(stop.vertex);
            if (open) out_.edges.push_back({at, next, edge.origin});
            at = next;
            open = stop.opens;
        }
        if (open) out_.edges.push_back({at, kept_vertex(solid, edge.to), edge.origin});
    }
    for (const Cut& c : cuts_[solid].of(place))
        out_.edges.push_back({kept_made(c.from), kept_made(c.to), EdgeOrigin(c.line)});
    return first;
}

void CommonPart::Steps::keep_parts(std::size_t solid) {
    const OutlinedSolid& s = *solids_[solid];
    if (!keeps_numbers_) kept_[solid].assign(s.vertices.size(), none);
    kept_made_.resize(made_.size(), none);
    auto near = near_[solid].begin();
    for (std::uint32_t f = 0; f < s.facets.size(); ++f) {
        if (near == near_[solid].end() || *near != f) {
            if (is_far_open(solid)) keep_all(solid, f);
            continue;
        }
        ++near;
        const bool untouched = is_untouched(solid, f);
        if (untouched && is_all_open(solid, s.facets[f])) {
            keep_all(solid, f);
        } else if (!untouched || !s.facets[f].whole) {
            keep_cut(solid, f);
        }
    }
}

namespace {

// Each is far out of the other one. Takes what either has.
OutlinedSolid common_of_apart(OutlinedSolid& first, OutlinedSolid& second, SpareOutlines& spare) {
    if (first.open_far_out && second.open_far_out) {
        spare.make_room(first, second.facets.size(), second.edges.size(), second.vertices.size());
        add_apart(second, first);
        return std::move(first);
    }
    OutlinedSolid out;
    if (first.open_far_out)
        std::swap(out, second);
    else if (second.open_far_out)
        std::swap(out, first);
    out.open_far_out = false;
    return out;
}

}  // namespace

CommonPart::CommonPart(const ManyMeshes& meshes, const EvaluateSettings& options)
    : steps_(std::make_unique<Steps>(meshes, options)) {}

CommonPart::~CommonPart() = default;

const SpecialPosition& CommonPart::special() const { return steps_->special(); }

SpareOutlines& CommonPart::spare() { return steps_->spare(); }

std::optional<OutlinedSolid> CommonPart::of(OutlinedSolid first, OutlinedSolid second,
                                            EvaluateStats& stats) {
    OutlinedSolid out;
    if (first.box.meets(second.box)) {
        if (!steps_->run(first, second, stats)) return std::nullopt;
        out = steps_->result();
        for (OutlinedSolid* s : {&first, &second})
            for (auto& lines : s->lines) out.lines.push_back(std::move(lines));
    } else {
        out = common_of_apart(first, second, steps_->spare());
    }
    steps_->spare().give_back(std::move(first));
    steps_->spare().give_back(std::move(second));
    return out;
}

}  // namespace trisect::detail
