// SPDX-License-Identifier: Apache-2.0
//
// A plate with ten thousand engraved stars is one arrangement of segments in a plane for each layer
// between two caps' positions. Cut into cells it is thousands of small arrangements in which
// nothing is whole any more: the plate's upper side becomes half a million convex pieces, only to
// be put together again.
//
// Side faces that end in a common edge make outlines, and outlines are walked along. What is inside
// beside a side face changes where another side face crosses it and nowhere else, so it is looked
// up once for each outline: one sweep over all of them counts the side faces that a straight way
// out of the figure crosses. From then on it is a matter of turning over one operand at each
// crossing.
//
// What bounds the result can be read off beside the side faces. In the plane of a cap it is bounded
// where the layers below and above differ, so the region's outline is made of the intervals of side
// faces with a difference on one side only; what is in the middle of it need not be known.
// Connected components of caps of one operand come out whole if all that bounds them bounds the
// region in the same way and no outline of the region lies within; for that the walk keeps which
// components are around it. Of side faces that bound the result as a whole nothing is written
// either.
//
// All vertices on a side face at a position are where what is on its two sides, below and above,
// changes. All four faces that meet there are divided in the same places.
//
// Outlines are walked around by several threads, in parts of the order in which the sweep comes to
// them. What they find is put together in that order.

#include <trisect/bsp/leaf/prism/prism_arrangement.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/leaf/prism/crossed_ways.h>
#include <trisect/bsp/leaf/straight_crossings.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/parallel_sort.h>
#include <trisect/kernel/support/ready_memory.h>
#include <trisect/kernel/support/task_group.h>

namespace trisect::detail {

std::optional<LeafResult> PrismArrangement::try_to_arrange(const LeafProblem& problem,
                                                           LeafFindings& findings) {
    EvaluateStats& stats = findings.stats;
    threads_ = problem.options->threads;
    outlines_ = {};
    if (!facets_.list(problem, true, threads_) || !find_crossings_and_chains(problem, stats))
        return std::nullopt;
    if (may_have_straight_crossings(problem) && crossings_.any_coincide()) return std::nullopt;
    if (!has_few_layers()) return std::nullopt;
    formula_.start(problem);
    if (!walk_chains(problem, stats)) return std::nullopt;
    LeafOutlines out;
    out.whole = list_whole();
    put_outlines_together();
    out.outlines = std::move(outlines_);
    return out;
}

// Neither needs the other.
bool PrismArrangement::find_crossings_and_chains(const LeafProblem& problem, EvaluateStats& stats) {
    bool has_chains = false;
    bool has_crossings = false;
    const auto chains = [&] {
        has_chains = components_.list(problem, facets_);
        if (!has_chains) return;
        find_chains();
        find_sweep();
    };
    const auto crossings = [&] {
        has_crossings = crossings_.find(problem, facets_.side_faces(), stats, threads_);
    };
    if (threads_ == 1) {
        crossings();
        if (has_crossings) chains();
    } else {
        both_at_once(chains, crossings);
    }
    return has_chains && has_crossings;
}

// Every side face is looked at in each of its layers, and every crossing turns over as many.
bool PrismArrangement::has_few_layers() const {
    constexpr std::size_t few = 80;
    std::size_t looked_at = 0;
    std::size_t all = 0;
    for (LeafIndex i = 0; as_index(i) < facets_.side_faces().size(); ++i) {
        const std::size_t places = 1 + crossings_.of(i).size();
        looked_at += places * (names_.side_face(i).end_layer - names_.side_face(i).first_layer);
        all += places;
    }
    return looked_at <= few * all &&
           facets_.positions().size() <= few * facets_.side_faces().size();
}

// --- Outlines.

void PrismArrangement::find_chains() {
    const auto side_faces = static_cast<LeafIndex>(facets_.side_faces().size());
    // Ends of side faces by their edges along the axis, as lists.
    std::vector<std::int32_t> first(components_.edge_count(), -1);
    std::vector<std::int32_t> next(2 * facets_.side_faces().size());
    for (std::int32_t end = 2 * side_faces; end-- > 0;) {
        std::int32_t& head = first[components_.edge_at(end / 2, as_index(end) % 2)];
        next[as_index(end)] = head;
        head = end;
    }
    std::vector<bool> walked(facets_.side_faces().size(), false);
    steps_.clear();
    chain_begin_.clear();
    for (LeafIndex i = 0; i < side_faces; ++i) {
        if (walked[as_index(i)]) continue;
        chain_begin_.push_back(steps_.size());
        for (PrismWalk::Step step{i, false}; step.side_face >= 0;) {
            steps_.push_back(step);
            walked[as_index(step.side_face)] = true;
            std::int32_t end = first[components_.edge_at(step.side_face, step.backwards ? 0 : 1)];
            while (end >= 0 && walked[as_index(end / 2)]) end = next[as_index(end)];
            step = end < 0 ? PrismWalk::Step{-1, false} : PrismWalk::Step{end / 2, end % 2 == 1};
        }
    }
    chain_begin_.push_back(steps_.size());
}

void PrismArrangement::find_sweep() {
    sweep_.side_faces.clear();
    sweep_.side_faces.reserve(facets_.side_faces().size());
    for (LeafIndex i = 0; as_index(i) < facets_.side_faces().size(); ++i) {
        const PrismSideFace& w = names_.side_face(i);
        const auto [low, high] = std::minmax(w.from.v, w.to.v);
        if (low != high) sweep_.side_faces.push_back({low, high, i});
    }
    sort_in_parts(sweep_.side_faces, threads_);
    sweep_.chains.clear();
    for (std::size_t c = 0; c + 1 < chain_begin_.size(); ++c)
        sweep_.chains.emplace_back(start_of(c).v, c);
    std::ranges::sort(sweep_.chains);
    sweep_.steps_before.clear();
    std::size_t steps = 0;
    for (const auto& [v, chain] : sweep_.chains) {
        sweep_.steps_before.push_back(steps);
        steps += chain_begin_[chain + 1] - chain_begin_[chain];
    }
}

// False where too many side faces lie across the lines of chains, as in PrismCrossings.
bool PrismArrangement::walk_chains(const LeafProblem& problem, EvaluateStats& stats) {
    // A part begins with a look at all side faces, and has the formula to itself.
    const std::size_t slots = threads_ != 0 ? threads_ : threads_here();
    const std::size_t least_steps =
        std::max(4096 + 64 * problem.operands.size(), steps_.size() / (4 * slots));
    const ParallelParts parts(steps_.size(), threads_, least_steps);
    found_.clear();
    found_.resize(parts.count());
    std::vector<std::size_t> looked_at(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        const auto chain_at = [&](std::size_t step) {
            return static_cast<std::size_t>(std::ranges::lower_bound(sweep_.steps_before, step) -
                                            sweep_.steps_before.begin());
        };
        PrismWalk walk(facets_, crossings_, components_, formula_);
        looked_at[part] = walk_part(problem, {chain_at(begin), chain_at(end)}, walk);
        found_[part] = std::move(walk.found());
    });
    stats.traces += sweep_.chains.size();
    return std::accumulate(looked_at.begin(), looked_at.end(), std::size_t{0}) <= most_looked_at();
}

std::size_t PrismArrangement::most_looked_at() const {
    return PrismCrossings::most_per_side_face * sweep_.side_faces.size();
}

// Some chains of the order. Returns how many side faces it looked at.
std::size_t PrismArrangement::walk_part(const LeafProblem& problem,
                                        const std::array<std::size_t, 2>& chains,
                                        PrismWalk& walk) const {
    // Of side faces across the line of the start.
    struct Across {
        Coordinate high;
        Coordinate from_u;
        Coordinate to_u;
        LeafIndex side_face = 0;
    };
    std::vector<Across> across;
    std::vector<LeafIndex> crossed;
    auto next = sweep_.side_faces.begin();
    std::size_t looked_at = 0;
    for (std::size_t c = chains[0]; c < chains[1]; ++c) {
        const auto [v, chain] = sweep_.chains[c];
        check_flags(problem.options->scope);
        if (looked_at > most_looked_at()) break;
        for (; next != sweep_.side_faces.end() && next->low <= v; ++next) {
            if (next->high <= v) continue;
            const PrismSideFace& w = names_.side_face(next->side_face);
            across.push_back({next->high, w.from.u, w.to.u, next->side_face});
        }
        std::erase_if(across, [v = v](const Across& w) { return w.high <= v; });
        crossed.clear();
        looked_at += across.size();
        const FlatCorner& start = start_of(chain);
        // The way goes towards greater coordinates.
        for (const Across& w : across)
            if (w.to_u >= start.u &&
                (w.from_u > start.u || crosses_way(names_.side_face(w.side_face), start)))
                crossed.push_back(w.side_face);
        const std::size_t begin = chain_begin_[chain];
        walk.run(std::span(steps_).subspan(begin, chain_begin_[chain + 1] - begin), crossed);
    }
    return looked_at;
}

// --- What passes through.

// Of side faces in the order of the walks, then of caps.
std::vector<PolygonRef> PrismArrangement::list_whole() {
    constexpr std::size_t least_caps = 4096;
    const auto caps = facets_.caps();
    const ParallelParts of_caps(caps.size(), threads_, least_caps);
    std::vector<std::size_t> first(of_caps.count() + 1);
    of_caps.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            first[part + 1] += components_.is_whole(components_.of_cap(c)) ? 1 : 0;
    });
    std::vector<std::size_t> first_of_walk;
    std::size_t count = 0;
    for (const PrismWalk::Found& found : found_)
        first_of_walk.push_back(std::exchange(count, count + found.whole.size()));
    first[0] = count;
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<PolygonRef> out;
    resize_ready(out, first.back());
    for_each_walk([&](std::size_t i) {
        std::ranges::copy(found_[i].whole, out.data() + first_of_walk[i]);
        found_[i].whole = {};
    });
    of_caps.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        std::size_t n = first[part];
        for (std::size_t c = begin; c < end; ++c) {
            const std::int32_t component = components_.of_cap(c);
            if (!components_.is_whole(component)) continue;
            out[n] = caps[c].ref;
            out[n++].flipped = components_.is_below(component) != facets_.faces_up(caps[c].ref);
        }
    });
    return out;
}

// --- Caps that do not.

namespace {

bool are_of_one_face(const PolygonRef& a, const PolygonRef& b) {
    return a.source == b.source && a.source->face_of(a.facet) == b.source->face_of(b.facet);
}

}  // namespace

// Caps come plane by plane.
void PrismArrangement::look_at_cap_planes() {
    constexpr std::size_t least_caps = 4096;
    cap_planes_.assign(facets_.positions().size(), {});
    const auto caps = facets_.caps();
    const auto is_whole = [&](std::size_t c) {
        return components_.is_whole(components_.of_cap(c));
    };
    const ParallelParts parts(caps.size(), threads_, least_caps);
    parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            if (is_whole(c)) continue;
            const std::atomic_ref first(cap_planes_[caps[c].position].first);
            std::size_t known = first.load(std::memory_order_relaxed);
            while (c < known && !first.compare_exchange_weak(known, c, std::memory_order_relaxed)) {
            }
        }
    });
    parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const PolygonRef& ref = caps[c].ref;
            CapPlane& plane = cap_planes_[caps[c].position];
            if (c != 0 && caps[c - 1].position == caps[c].position &&
                caps[c - 1].ref.source != ref.source)
                plane.note(CapPlane::Mixed);
            if (is_whole(c)) continue;
            const PolygonRef& first = caps[plane.first].ref;
            if (!are_of_one_face(first, ref)) plane.note(CapPlane::Several);
            if (first.facet > ref.facet) plane.note(CapPlane::Mixed);
        }
    });
}

void PrismArrangement::CapPlane::note(Sign sign) {
    const std::atomic_ref all(signs);
    if ((all.load(std::memory_order_relaxed) & sign) == 0)
        all.fetch_or(sign, std::memory_order_relaxed);
}

// Where the edges of a walk go.
struct PrismArrangement::WalkEdges {
    std::size_t first = 0;          // of those that it outlined itself
    std::size_t first_of_caps = 0;  // and of those in the planes of caps
    std::size_t count_of_caps = 0;
    std::size_t first_face = 0;               // of those that it named itself
    PoolVector<std::uint32_t> faces_of_caps;  // in the order in which edges come to them
};

void PrismArrangement::put_outlines_together() {
    look_at_cap_planes();
    std::vector<WalkEdges> places(found_.size());
    for_each_walk([&](std::size_t i) { count_cap_edges(found_[i], places[i]); });
    std::size_t edges = 0;
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const NamedOutlines& own = found_[i].outlines;
        places[i].first = std::exchange(edges, edges + own.edges.size());
        places[i].first_face = outlines_.faces.size();
        outlines_.faces.insert(outlines_.faces.end(), own.faces.begin(), own.faces.end());
        outlines_.first_facets.insert(outlines_.first_facets.end(), own.first_facets.begin(),
                                      own.first_facets.end());
    }
    faces_of_caps_.assign(2 * cap_planes_.size(), -1);
    for (WalkEdges& place : places) {
        place.first_of_caps = std::exchange(edges, edges + place.count_of_caps);
        for (const std::uint32_t face : place.faces_of_caps) name_cap_face(face);
    }
    resize_ready(outlines_.edges, edges);
    for_each_walk([&](std::size_t i) {
        put_edges(found_[i], places[i]);
        found_[i] = {};
    });
    name_cap_planes();
}

void PrismArrangement::count_cap_edges(const PrismWalk::Found& found, WalkEdges& place) const {
    std::vector<bool> seen(2 * cap_planes_.size(), false);
    for (const PrismWalk::CapEdge& c : found.cap_edges) {
        if (is_left_out(c)) continue;
        place.count_of_caps += 1 + names_.corners_between(c.side_face, c.face / 2, c.all).size();
        if (seen[c.face]) continue;
        seen[c.face] = true;
        place.faces_of_caps.push_back(c.face);
    }
}

void PrismArrangement::name_cap_face(std::uint32_t face) {
    if (faces_of_caps_[face] >= 0) return;
    const std::size_t first = cap_planes_[face / 2].first;
    TRISECT_EXPECTS(first != CapPlane::none, "an outline where all components are whole");
    const PolygonRef& ref = facets_.caps()[first].ref;
    const bool up = face % 2 == 1;
    faces_of_caps_[face] = static_cast<std::int32_t>(outlines_.faces.size());
    outlines_.faces.push_back({ref.source, ref.facet, up != facets_.faces_up(ref)});
}

void PrismArrangement::put_edges(const PrismWalk::Found& found, const WalkEdges& place) {
    NamedOutlines::Edge* out = outlines_.edges.data() + place.first;
    for (const NamedOutlines::Edge& e : found.outlines.edges) {
        *out = e;
        out++->face += static_cast<std::uint32_t>(place.first_face);
    }
    out = outlines_.edges.data() + place.first_of_caps;
    for (const PrismWalk::CapEdge& c : found.cap_edges)
        if (!is_left_out(c)) out = put_cap_edge(c, out);
}

NamedOutlines::Edge* PrismArrangement::put_cap_edge(const PrismWalk::CapEdge& c,
                                                    NamedOutlines::Edge* out) const {
    const PrismSideFace& w = names_.side_face(c.side_face);
    const std::size_t position = c.face / 2;
    const bool up = c.face % 2 == 1;
    NamedOutlines::Edge e;
    e.from = names_.vertex(c.side_face, c.from, position);
    e.to = names_.vertex(c.side_face, c.to, position);
    e.line = {names_.support_of(c.side_face), c.left == w.above_is_left[0]};
    e.face = static_cast<std::uint32_t>(faces_of_caps_[c.face]);
    PrismNames::divide(w, e, names_.corners_between(c.side_face, position, c.all), c.left != up,
                       [&](const NamedOutlines::Edge& part) { *out++ = part; });
    return out;
}

// Where faces of several are in one plane.
void PrismArrangement::name_cap_planes() {
    for (std::size_t i = 0; i < cap_planes_.size(); ++i) {
        const CapPlane& plane = cap_planes_[i];
        const bool is_outlined = faces_of_caps_[2 * i] >= 0 || faces_of_caps_[2 * i + 1] >= 0;
        if ((plane.signs & CapPlane::Several) == 0 || !is_outlined) continue;
        const PolygonRef& ref = facets_.caps()[plane.first].ref;
        if ((plane.signs & CapPlane::Mixed) != 0) {
            outlines_.names_hold_everywhere = false;
        } else {
            outlines_.first_facets.push_back({ref.source, ref.facet, false});
        }
    }
}

template <class Work>
void PrismArrangement::for_each_walk(const Work& work) {
    ParallelParts(found_.size(), found_.size() == 1 ? 1 : threads_, 1)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) work(i);
        });
}

}  // namespace trisect::detail
