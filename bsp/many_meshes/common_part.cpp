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
// are, or not at all. Mostly these are many more than the others. So nothing of what is kept moves
// but facets, to the front; what is cut gets new edges behind all others.

#include <trisect/bsp/many_meshes/common_part.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/many_meshes/buckets.h>
#include <trisect/bsp/many_meshes/common_segments.h>
#include <trisect/bsp/many_meshes/crossed_facets.h>
#include <trisect/bsp/many_meshes/outlines/box_sum.h>
#include <trisect/bsp/many_meshes/outlines/small_map.h>
#include <trisect/bsp/many_meshes/point_side.h>
#include <trisect/bsp/many_meshes/stops_in_order.h>
#include <trisect/bsp/many_meshes/vertex_sides.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/task_group.h>
#include <trisect/kernel/support/touched_room.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

// Segments of fewer pairs are found on one thread.
constexpr std::size_t least_pairs_in_parts = 1024;

// Fewer stops are sorted sooner than another thread begins.
constexpr std::size_t least_sorted_at_once = std::size_t{1} << 16;

}  // namespace

class CommonPart::Steps {
public:
    using Solid = OutlineStore::Solid;
    using Facet = OutlinedSolid::Facet;

    Steps(const ManyMeshes& meshes, const EvaluateSettings& options)
        : meshes_(meshes),
          special_(meshes.facet_count()),
          exact_(meshes, special_),
          finder_(meshes, options, special_),
          segments_(meshes, exact_) {}

    [[nodiscard]] std::optional<Solid> of(const Solid& first, const Solid& second,
                                          EvaluateStats& stats, const How& how) {
        start(first, second);
        known_ = how.known;
        threads_ = how.threads;
        first_known_ = second.vertices;
        if (!find_cuts(stats)) return std::nullopt;
        sort_all();
        for (std::size_t i = 0; i < 2; ++i)
            if (!find_sides(i)) return std::nullopt;
        Solid out = keep(first, second);
        // Where sides were known beforehand nothing is compared any more.
        if (known_.empty()) store_.tidy(out);
        return out;
    }
    [[nodiscard]] OutlineStore& store() {
        store_.reserve(meshes_);
        return store_;
    }
    [[nodiscard]] bool is_open_at_corner(const OutlineVertex& corner,
                                         const OutlinedSolid& solid) const {
        return detail::is_open_at_corner(corner, solid, exact_);
    }
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
        EdgeOrigin line;
    };
    using Side = VertexSides::Side;

    void start(const Solid& first, const Solid& second);
    void find_near(std::size_t solid);
    [[nodiscard]] std::span<const std::uint32_t> near(std::size_t solid) const {
        return std::span(near_[solid]).first(near_count_[solid]);
    }
    [[nodiscard]] bool find_cuts(EvaluateStats& stats);
    void reserve_for(std::size_t pairs);
    void sort_all();
    [[nodiscard]] bool add_cuts_of(std::span<const CrossedFacets> pairs);
    void add_cuts(const CrossedFacets& pair, std::span<const CommonSegment> segments);
    void add_cut(const std::array<std::uint32_t, 2>& places, const CommonSegment& segment,
                 const EdgeOrigin& line);
    [[nodiscard]] std::uint32_t vertex_at(const CommonSegment::End& end,
                                          const std::array<std::uint32_t, 2>& places);
    // To the facet of the other solid that it crosses.
    [[nodiscard]] bool is_open_below(std::size_t solid,
                                     const std::array<std::uint32_t, 2>& places) const {
        const auto slot = [&](std::size_t i) { return solids_[i].facets[places[i]].slot; };
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
    [[nodiscard]] bool mark_known(std::size_t solid);
    void mark_beyond(std::size_t solid);
    [[nodiscard]] Solid keep(const Solid& first, const Solid& second);
    void keep_parts(std::size_t solid, Solid& out, std::size_t& kept);
    [[nodiscard]] bool keep_near(std::size_t solid, std::uint32_t place, Solid& out, Facet& facet,
                                 OutlineBox& box);
    [[nodiscard]] bool is_untouched(std::size_t solid, std::uint32_t place,
                                    const Facet& facet) const;
    [[nodiscard]] bool is_all_open(const Facet& f) const;
    [[nodiscard]] std::uint32_t add_edges_of_cut(std::size_t solid, std::uint32_t place,
                                                 const Facet& facet);
    [[nodiscard]] std::span<Cut> add_cuts_from(std::uint32_t vertex, std::span<Cut> cuts);
    [[nodiscard]] OutlineBox box_of_edges(std::uint32_t first) const;
    [[nodiscard]] std::uint32_t kept_made(std::uint32_t v);
    // Of a vertex of a facet that is near.
    [[nodiscard]] bool is_open(std::uint32_t v) const { return sides_.of(v) == Side::Open; }
    // What is far out of the other solid.
    [[nodiscard]] bool is_far_open(std::size_t solid) const {
        return solids_[1 - solid].open_far_out;
    }

    const ManyMeshes& meshes_;
    std::uint32_t threads_ = 1;  // as for ParallelParts
    SpecialPosition special_;
    ShiftedPoints exact_;
    OutlineStore store_;
    std::array<OutlinedSolid, 2> solids_;  // until something is kept
    std::array<std::size_t, 3> firsts_{};  // of their facets, and where these end
    std::array<std::size_t, 3> edges_{};   // of their edges
    std::array<std::size_t, 3> vertices_{};
    CrossedFacetsFinder finder_;
    CommonSegments segments_;
    PoolVector<OutlineVertex> made_;
    FlatMap made_by_name_;
    Buckets<Stop> stops_;                            // by edge
    std::array<PoolVector<std::uint32_t>, 2> near_;  // places whose boxes meet the other solid's
    std::array<std::size_t, 2> near_count_{};        // of these
    std::array<Buckets<Cut>, 2> cuts_;               // by place
    VertexSides sides_;  // of vertices of facets that are near: of the other solid
    Known known_;
    std::size_t first_known_ = 0;  // that vertex of the store
    PoolVector<std::uint32_t> kept_made_;
};

void CommonPart::Steps::start(const Solid& first, const Solid& second) {
    solids_ = {store_.view(first, second), store_.view(second)};
    firsts_ = {first.facets, second.facets, store_.facets().size()};
    edges_ = {first.edges, second.edges, store_.edges().size()};
    vertices_ = {first.vertices, second.vertices, store_.vertices().size()};
    segments_.start(solids_[0], solids_[1]);
    made_.clear();
    empty(made_by_name_);
    stops_.clear();
    for (std::size_t i = 0; i < 2; ++i) {
        cuts_[i].clear();
        find_near(i);
    }
    sides_.start(store_.vertices().size());
}

void CommonPart::Steps::find_near(std::size_t solid) {
    PoolVector<std::uint32_t>& near = near_[solid];
    const std::span<const OutlineBox> boxes = solids_[solid].boxes;
    if (near.size() < boxes.size()) near.resize(boxes.size());
    const BoxProbe other(solids_[1 - solid].box);
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < boxes.size(); ++f) {
        near[count] = f;
        count += other.meets(boxes[f]) ? 1 : 0;
    }
    near_count_[solid] = count;
}

// Lines are looked at while others are added, so they stay where they are.
void CommonPart::Steps::reserve_for(std::size_t pairs) {
    constexpr std::size_t many_pairs = 4096;
    PoolVector<FacetCrossing>& lines = store_.lines();
    if (const std::size_t wanted = lines.size() + pairs; wanted > lines.capacity())
        lines.reserve(wanted + wanted / 2);
    if (pairs > many_pairs) {
        reserve_touched(lines, pairs, threads_);
        made_by_name_.reserve(pairs);
        reserve_touched(made_, pairs, threads_);
        stops_.reserve(2 * pairs, threads_);
        for (auto& cuts : cuts_) cuts.reserve(pairs, threads_);
    }
    for (OutlinedSolid& s : solids_) s.lines = lines;
}

void CommonPart::Steps::sort_all() {
    const auto sort_stops = [&] { stops_.sort(store_.edges().size()); };
    const auto sort_cuts = [&] {
        for (std::size_t i = 0; i < 2; ++i) cuts_[i].sort(solids_[i].facets.size());
    };
    if (threads_ != 1 && stops_.size() >= least_sorted_at_once) {
        both_at_once(sort_stops, sort_cuts);
    } else {
        sort_stops();
        sort_cuts();
    }
}

bool CommonPart::Steps::find_cuts(EvaluateStats& stats) {
    if (!finder_.find(solids_[0], solids_[1], {near(0), near(1)}, threads_, stats)) return false;
    reserve_for(finder_.pair_count());
    for (const CrossedFacetsFinder::Pairs& pairs : finder_.pairs()) {
        if (threads_ != 1 && pairs.size() >= least_pairs_in_parts) {
            if (!add_cuts_of(pairs)) return false;
            continue;
        }
        for (const CrossedFacets& c : pairs) {
            if (!segments_.find(c.places, c.crossing)) return false;
            add_cuts(c, segments_.segments());
        }
    }
    return true;
}

// Segments are found on several threads, and added in the order of their pairs.
bool CommonPart::Steps::add_cuts_of(std::span<const CrossedFacets> pairs) {
    struct Found {
        PoolVector<CommonSegment> segments;
        PoolVector<std::uint32_t> counts;  // by pair
        bool is_known = true;
    };
    struct Finder {
        explicit Finder(const ManyMeshes& meshes)
            : special(meshes.facet_count()), exact(meshes, special), segments(meshes, exact) {}
        SpecialPosition special;
        ShiftedPoints exact;
        CommonSegments segments;
    };
    const ParallelParts parts(pairs.size(), threads_, least_pairs_in_parts / 4);
    std::vector<Found> found(parts.count());
    PerThread<Finder> finders;
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        Finder& finder = finders.local([&] {
            auto made = std::make_unique<Finder>(meshes_);
            made->segments.start(solids_[0], solids_[1]);
            return made;
        });
        Found& here = found[part];
        here.segments.reserve(end - begin);
        here.counts.reserve(end - begin);
        for (const CrossedFacets& c : pairs.subspan(begin, end - begin)) {
            here.is_known = finder.segments.find(c.places, c.crossing);
            if (!here.is_known) return;
            const auto segments = finder.segments.segments();
            here.segments.insert(here.segments.end(), segments.begin(), segments.end());
            here.counts.push_back(static_cast<std::uint32_t>(segments.size()));
        }
    });
    finders.for_each([&](const Finder& f) { special_.add(f.special); });
    if (!std::ranges::all_of(found, &Found::is_known)) return false;
    auto pair = pairs.begin();
    for (const Found& f : found) {
        std::span<const CommonSegment> segments(f.segments);
        for (const std::uint32_t count : f.counts) {
            add_cuts(*pair++, segments.first(count));
            segments = segments.subspan(count);
        }
    }
    return true;
}

void CommonPart::Steps::add_cuts(const CrossedFacets& pair,
                                 std::span<const CommonSegment> segments) {
    if (segments.empty()) return;
    const EdgeOrigin line = EdgeOrigin::of_line(store_.lines().size());
    store_.lines().push_back(pair.crossing);
    for (const CommonSegment& s : segments) add_cut(pair.places, s, line);
}

// On the first facet what lies below the second one is to the left of the crossing, on the second
// one what lies above the first.
void CommonPart::Steps::add_cut(const std::array<std::uint32_t, 2>& places,
                                const CommonSegment& segment, const EdgeOrigin& line) {
    const std::array<bool, 2> along{is_open_below(1, places), !is_open_below(0, places)};
    std::array<std::uint32_t, 2> ends{};
    for (std::size_t k = 0; k < 2; ++k) {
        const CommonSegment::End& end = segment.ends[k];
        ends[k] = vertex_at(end, places);
        const std::size_t owner = end.of_second ? 1 : 0;
        // Walking on along the edge one comes to the left of what ends there.
        const std::uint32_t cutter = solids_[1 - owner].facets[places[1 - owner]].number;
        stops_.add(end.edge, {ends[k], (k == 1) == along[owner], cutter, places[owner]});
    }
    for (std::size_t i = 0; i < 2; ++i)
        cuts_[i].add(places[i], {ends[along[i] ? 0 : 1], ends[along[i] ? 1 : 0], line});
}

// Two facets share the edge. With the map compiled in, so that names stay in registers.
[[gnu::flatten]] std::uint32_t CommonPart::Steps::vertex_at(
    const CommonSegment::End& end, const std::array<std::uint32_t, 2>& places) {
    const std::size_t owner = end.of_second ? 1 : 0;
    const OutlinedSolid::Edge& e = solids_[owner].edges[end.edge];
    const auto [low, high] = std::minmax(e.from, e.to);
    const Key128 name{std::uint64_t{low} << 32 | high,
                      std::uint64_t{places[1 - owner]} << 1 | owner};
    const auto [number, is_new] =
        made_by_name_.insert(name, static_cast<std::int32_t>(made_.size()));
    if (!is_new) return static_cast<std::uint32_t>(number);
    OutlineVertex& v = made_.emplace_back();
    v.at = end.at;
    const std::uint32_t own = solids_[owner].facets[places[owner]].number;
    const std::uint32_t other = solids_[1 - owner].facets[places[1 - owner]].number;
    if (const FacetCrossing* line = solids_[owner].line_of(e); line == nullptr) {
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
    return sort_along(
        stops, solid.vertices[edge.from].at, solid.vertices[edge.to].at, made_,
        [&](const Stop& s, const Stop& t) { return order_of_stops(edge, facet, s, t); });
}

// Exactly: -1 where the first one comes before the other one. An edge in a segment goes along its
// line where that has what is open on its left (add_cut).
int CommonPart::Steps::order_of_stops(const OutlinedSolid::Edge& edge, std::uint32_t facet,
                                      const Stop& a, const Stop& b) const {
    const FacetCrossing* crossing = solids_[0].line_of(edge);
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
    const OutlinedSolid& s = solids_[solid];
    sides_.start_list(vertices_[solid], vertices_[solid + 1]);
    for (const std::uint32_t f : near(solid)) {
        const OutlinedSolid::Facet& facet = s.facets[f];
        const OutlinedSolid::Edge* const edges = s.edges.data() + facet.first;
        if (!facet.whole) {  // it may have several outlines
            for (std::uint32_t i = 0; i < facet.count; ++i) {
                sides_.use(edges[i].from);
                if (!stops_.has(facet.first + i)) sides_.join(edges[i].from, edges[i].to);
            }
            continue;
        }
        const std::array<std::uint32_t, 3> corners{edges[0].from, edges[1].from, edges[2].from};
        for (const std::uint32_t v : corners) sides_.use(v);
        if (sides_.are_joined(corners[0], corners[1]) && sides_.are_joined(corners[1], corners[2]))
            continue;
        const bool is_pierced = stops_.has(facet.first);
        const bool is_next_pierced = stops_.has(facet.first + 1);
        if (!is_pierced) sides_.join(corners[0], corners[1]);
        if (!is_next_pierced) sides_.join(corners[1], corners[2]);
        // Else these have joined all.
        if ((is_pierced || is_next_pierced) && !stops_.has(facet.first + 2))
            sides_.join(corners[2], corners[0]);
    }
    sides_.list();
}

// Of the edges that are pierced.
bool CommonPart::Steps::mark_ends(std::size_t solid) {
    const OutlinedSolid& s = solids_[solid];
    for (const Buckets<Stop>::Bucket& b : stops_.buckets()) {
        if (b.key < edges_[solid] || b.key >= edges_[solid + 1]) continue;
        const OutlinedSolid::Edge& edge = s.edges[b.key];
        const std::span<Stop> stops = stops_.of(b);
        if (!sort_stops(edge, s.facets[stops.front().place].number, s, stops)) return false;
        for (std::size_t i = 1; i < stops.size(); ++i)
            if (stops[i].opens == stops[i - 1].opens) return false;
        if (!sides_.mark(edge.from, stops.front().opens ? Side::Closed : Side::Open) ||
            !sides_.mark(edge.to, stops.back().opens ? Side::Open : Side::Closed))
            return false;
    }
    return true;
}

// Of the second solid.
bool CommonPart::Steps::mark_known(std::size_t solid) {
    if (solid == 0 || known_.empty()) return true;
    for (const std::uint32_t v : sides_.listed())
        if (const Side side = known_[v - first_known_];
            side != Side::Unknown && !sides_.mark(v, side))
            return false;
    return true;
}

// What is surely beyond the other solid's box is far out. It is looked at where nothing of what
// hangs together has a side yet: then one vertex says it for all.
void CommonPart::Steps::mark_beyond(std::size_t solid) {
    const OutlinedSolid& s = solids_[solid];
    const OutlineBox& other = solids_[1 - solid].box;
    const Side far = is_far_open(solid) ? Side::Open : Side::Closed;
    for (const std::uint32_t v : sides_.listed()) {
        Side& side = sides_.of(sides_.root_of(v));
        if (side == Side::Unknown && other.is_beside(s.vertices[v].at)) side = far;
    }
}

bool CommonPart::Steps::find_sides(std::size_t solid) {
    list_vertices(solid);
    if (!mark_ends(solid) || !mark_known(solid)) return false;
    for (const std::uint32_t v : sides_.listed())
        if (const Side side = sides_.of(v);
            side != Side::Unknown && !sides_.mark(sides_.root_of(v), side))
            return false;
    mark_beyond(solid);
    for (const std::uint32_t v : sides_.listed()) {
        const std::uint32_t root = sides_.root_of(v);
        if (sides_.of(root) == Side::Unknown) {
            const auto open = side_of_part(solid, root);
            if (!open) return false;
            sides_.of(root) = *open ? Side::Open : Side::Closed;
        }
        sides_.of(v) = sides_.of(root);
    }
    return true;
}

// Of vertices that hang together and that nothing separates from the other solid.
std::optional<bool> CommonPart::Steps::side_of_part(std::size_t solid, std::uint32_t root) {
    const OutlinedSolid& s = solids_[solid];
    const OutlinedSolid& other = solids_[1 - solid];
    if (const auto open = is_open_at(s.vertices[root].at, other, segments_, 1 - solid)) return open;
    for (const std::uint32_t v : sides_.listed())
        if (s.vertices[v].kind == OutlineVertex::Kind::Corner && sides_.root_of(v) == root)
            return is_open_at_corner(s.vertices[v], other);
    // None is left of them. Another vertex may be clear of the other solid's boundary.
    for (const std::uint32_t v : sides_.listed())
        if (v != root && sides_.root_of(v) == root)
            if (const auto open = is_open_at(s.vertices[v].at, other, segments_, 1 - solid))
                return open;
    return std::nullopt;
}

std::uint32_t CommonPart::Steps::kept_made(std::uint32_t v) {
    std::uint32_t& number = kept_made_[v];
    if (number != none) return number;
    number = static_cast<std::uint32_t>(store_.vertices().size());
    store_.vertices().push_back(made_[v]);
    return number;
}

// Those from an edge on, which are one facet's.
OutlineBox CommonPart::Steps::box_of_edges(std::uint32_t first) const {
    BoxSum box;
    const OutlinedSolid all = store_.view({});
    for (const OutlinedSolid::Edge& e : all.edges.subspan(first)) box.add(all.vertices[e.from].at);
    return box.box();
}

bool CommonPart::Steps::is_untouched(std::size_t solid, std::uint32_t place,
                                     const Facet& facet) const {
    if (cuts_[solid].has(place)) return false;
    for (std::uint32_t e = facet.first; !facet.whole && e < facet.first + facet.count; ++e)
        if (stops_.has(e)) return false;
    return true;
}

// Of one that nothing touches, which a facet is as a whole.
bool CommonPart::Steps::is_all_open(const Facet& f) const {
    for (std::uint32_t e = f.first; e < f.first + (f.whole ? 1 : f.count); ++e)
        if (!is_open(store_.edge(e).from)) return false;
    return true;
}

// The first of them. Behind a part of an edge come the crossings that go on from its end: of edges
// one behind the other each vertex is looked at once.
std::uint32_t CommonPart::Steps::add_edges_of_cut(std::size_t solid, std::uint32_t place,
                                                  const Facet& facet) {
    PoolVector<OutlinedSolid::Edge>& edges = store_.edges();
    const auto first = static_cast<std::uint32_t>(edges.size());
    std::span<Cut> cuts = cuts_[solid].of(place);
    for (std::uint32_t e = facet.first; e < facet.first + facet.count; ++e) {
        const OutlinedSolid::Edge edge = edges[e];
        bool open = is_open(edge.from);
        std::uint32_t at = edge.from;
        for (const Stop& stop : stops_.of(e)) {
            const std::uint32_t next = kept_made(stop.vertex);
            if (open) edges.push_back({at, next, edge.origin});
            if (open && !stop.opens) cuts = add_cuts_from(stop.vertex, cuts);
            at = next;
            open = stop.opens;
        }
        if (open) edges.push_back({at, edge.to, edge.origin});
    }
    while (!cuts.empty()) cuts = add_cuts_from(cuts.front().from, cuts);
    return first;
}

// One behind the other, as far as they go on from there. Returns the others.
std::span<CommonPart::Steps::Cut> CommonPart::Steps::add_cuts_from(std::uint32_t vertex,
                                                                   std::span<Cut> cuts) {
    constexpr std::size_t most_looked_at = 32;
    for (;;) {
        const std::span<Cut> some = cuts.first(std::min(cuts.size(), most_looked_at));
        const auto next = std::ranges::find(some, vertex, &Cut::from);
        if (next == some.end()) return cuts;
        store_.edges().push_back({kept_made(next->from), kept_made(next->to), next->line});
        vertex = next->to;
        *next = cuts.front();
        cuts = cuts.subspan(1);
    }
}

// False where nothing is left of it.
bool CommonPart::Steps::keep_near(std::size_t solid, std::uint32_t place, Solid& out, Facet& facet,
                                  OutlineBox& box) {
    const bool untouched = is_untouched(solid, place, facet);
    if (untouched && is_all_open(facet)) return true;
    out.unused_edges += facet.count;
    if (untouched && facet.whole) return false;
    facet.first = add_edges_of_cut(solid, place, facet);
    facet.count = static_cast<std::uint32_t>(store_.edges().size()) - facet.first;
    facet.whole = false;
    if (facet.count == 0) return false;
    box = box_of_edges(facet.first);
    return true;
}

// Facets move to the front.
void CommonPart::Steps::keep_parts(std::size_t solid, Solid& out, std::size_t& kept) {
    PoolVector<Facet>& facets = store_.facets();
    PoolVector<OutlineBox>& boxes = store_.boxes();
    BoxSum all(out.box);
    std::size_t i = firsts_[solid];
    // What is far comes in runs.
    const auto keep_far = [&](std::size_t end) {
        if (!is_far_open(solid)) {
            for (; i < end; ++i) out.unused_edges += facets[i].count;
            return;
        }
        for (; i < end; ++i, ++kept) {
            all.add(boxes[i]);
            if (kept == i) continue;
            facets[kept] = facets[i];
            boxes[kept] = boxes[i];
        }
    };
    for (const std::uint32_t place : near(solid)) {
        keep_far(firsts_[solid] + place);
        Facet facet = facets[i];
        OutlineBox box = boxes[i++];
        if (!keep_near(solid, place, out, facet, box)) continue;
        all.add(box);
        facets[kept] = facet;
        boxes[kept++] = box;
    }
    keep_far(firsts_[solid + 1]);
    out.box = all.box();
}

OutlineStore::Solid CommonPart::Steps::keep(const Solid& first, const Solid& second) {
    kept_made_.assign(made_.size(), none);
    Solid out = first;
    out.unused_edges += second.unused_edges;
    out.box = OutlineBox::none();
    out.open_far_out = first.open_far_out && second.open_far_out;
    std::size_t kept = firsts_[0];
    for (std::size_t i = 0; i < 2; ++i) keep_parts(i, out, kept);
    store_.facets().resize(kept);
    store_.boxes().resize(kept);
    return out;
}

CommonPart::CommonPart(const ManyMeshes& meshes, const EvaluateSettings& options)
    : steps_(std::make_unique<Steps>(meshes, options)) {}

CommonPart::~CommonPart() = default;

const SpecialPosition& CommonPart::special() const { return steps_->special(); }

bool CommonPart::is_open_at_corner(const OutlineVertex& corner, const OutlinedSolid& solid) const {
    return steps_->is_open_at_corner(corner, solid);
}

OutlineStore& CommonPart::store() { return steps_->store(); }

std::optional<OutlineStore::Solid> CommonPart::of(const Solid& first, const Solid& second,
                                                  EvaluateStats& stats, const How& how) {
    if (first.box.meets(second.box)) {
        std::optional<Solid> out = steps_->of(first, second, stats, how);
        if (out) out->united = {};
        return out;
    }
    // Each is far out of the other one.
    OutlineStore& store = steps_->store();
    Solid out;
    if (first.open_far_out && second.open_far_out) {
        out = store.united_apart(first, second);
    } else if (first.open_far_out) {
        out = store.second_only(first, second);
    } else {
        out = store.first_only(first, second);
        if (!second.open_far_out) out = store.none_of(out);
    }
    out.open_far_out = first.open_far_out && second.open_far_out;
    out.united = {};
    return out;
}

}  // namespace trisect::detail
