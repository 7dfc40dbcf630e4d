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

#include <trisect/bsp/leaf/prism/prism_arrangement.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/leaf/prism/crossed_ways.h>
#include <trisect/bsp/leaf/straight_crossings.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

std::optional<LeafResult> PrismArrangement::try_to_arrange(const LeafProblem& problem,
                                                           LeafFindings& findings) {
    EvaluateStats& stats = findings.stats;
    cap_edges_.clear();
    outlines_ = {};
    if (!facets_.list(problem, true) || !crossings_.find(problem, facets_.side_faces(), stats))
        return std::nullopt;
    if (may_have_straight_crossings(problem) && crossings_.any_coincide()) return std::nullopt;
    if (!has_few_layers() || !components_.list(problem, facets_)) return std::nullopt;
    formula_.start(problem);
    row_size_ = formula_.row_size();
    const std::size_t layers = facets_.positions().size() + 1;
    rows_.assign(layers * row_size_, 0);
    for (std::size_t layer = 0; layer < layers; ++layer) {
        std::ranges::copy(facets_.outside(), row(layer).begin());
        formula_.fill(row(layer));
    }
    changed_.clear();
    is_changed_.assign(problem.operands.size(), false);
    odd_.assign(components_.size(), 0);
    find_chains();
    if (!walk_chains(problem, stats)) return std::nullopt;
    finish_caps();
    return LeafOutlines{listed(), std::move(outlines_)};
}

// Every side face is looked at in each of its layers, and every crossing turns over as many.
bool PrismArrangement::has_few_layers() const {
    constexpr std::size_t few = 16;
    std::size_t looked_at = 0;
    std::size_t all = 0;
    for (LeafIndex i = 0; as_index(i) < facets_.side_faces().size(); ++i) {
        const std::size_t places = 1 + crossings_.of(i).size();
        looked_at += places * (side_face(i).end_layer - side_face(i).first_layer);
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
        for (Step step{i, false}; step.side_face >= 0;) {
            steps_.push_back(step);
            walked[as_index(step.side_face)] = true;
            std::int32_t end = first[components_.edge_at(step.side_face, step.backwards ? 0 : 1)];
            while (end >= 0 && walked[as_index(end / 2)]) end = next[as_index(end)];
            step = end < 0 ? Step{-1, false} : Step{end / 2, end % 2 == 1};
        }
    }
    chain_begin_.push_back(steps_.size());
}

// False where too many side faces lie across the lines of chains, as in PrismCrossings.
bool PrismArrangement::walk_chains(const LeafProblem& problem, EvaluateStats& stats) {
    const auto low = [&](LeafIndex i) { return std::min(side_face(i).from.v, side_face(i).to.v); };
    const auto high = [&](LeafIndex i) { return std::max(side_face(i).from.v, side_face(i).to.v); };
    std::vector<std::pair<Coordinate, LeafIndex>> side_faces;  // by their lower ends
    for (LeafIndex i = 0; as_index(i) < facets_.side_faces().size(); ++i)
        if (low(i) != high(i)) side_faces.emplace_back(low(i), i);
    std::ranges::sort(side_faces);
    const auto start = [&](std::size_t chain) -> const FlatCorner& {
        return side_face(steps_[chain_begin_[chain]].side_face).from;
    };
    std::vector<std::pair<Coordinate, std::size_t>> chains;
    for (std::size_t c = 0; c + 1 < chain_begin_.size(); ++c) chains.emplace_back(start(c).v, c);
    std::ranges::sort(chains);
    std::vector<std::pair<Coordinate, LeafIndex>> across;  // the line of the start: upper ends
    std::vector<LeafIndex> crossed;
    auto next = side_faces.begin();
    std::size_t looked_at = 0;
    for (const auto& [v, chain] : chains) {
        check_budget(*problem.options, stats);
        if (looked_at > PrismCrossings::most_per_side_face * side_faces.size()) return false;
        for (; next != side_faces.end() && next->first <= v; ++next)
            across.emplace_back(high(next->second), next->second);
        std::erase_if(across, [v = v](const auto& w) { return w.first <= v; });
        crossed.clear();
        looked_at += across.size();
        for (const auto& w : across)
            if (crosses_way(side_face(w.second), start(chain))) crossed.push_back(w.second);
        const std::size_t begin = chain_begin_[chain];
        walk_chain(std::span(steps_).subspan(begin, chain_begin_[chain + 1] - begin), crossed);
        ++stats.traces;
    }
    return true;
}

// All side faces of a chain are in the same layers, and bound the same two components.
void PrismArrangement::walk_chain(Chain chain, std::span<const LeafIndex> crossed) {
    const PrismSideFace& w = side_face(chain[0].side_face);
    layers_here_ = w.end_layer - w.first_layer + 2;
    const std::array<std::int32_t, 2> own = components_.of_side_face(chain[0].side_face);
    around_.clear();
    met_.clear();
    for (const LeafIndex c : crossed) {
        for (const std::int32_t component : components_.of_side_face(c)) {
            odd_[as_index(component)] ^= 1U;
            met_.push_back(component);
        }
        turn_over(side_face(c), w);
    }
    for (const std::int32_t component : met_) {
        if (odd_[as_index(component)] != 0 && component != own[0] && component != own[1])
            enter_component(component);
        odd_[as_index(component)] = 0;
    }
    for (const Step& step : chain) {
        walk_side_face(step);
        judge_side_face(step.side_face);
    }
    for (const LeafIndex operand : changed_) {
        for (std::size_t i = 0; i < layers_here_; ++i)
            formula_.set(row(w.first_layer - 1 + i), as_index(operand),
                         facets_.outside()[as_index(operand)]);
        is_changed_[as_index(operand)] = false;
    }
    changed_.clear();
}

// Components in the planes of other layers do no harm: they are not used.
void PrismArrangement::enter_component(std::int32_t component) {
    const auto at = std::ranges::find(around_, component);
    if (at == around_.end()) {
        around_.push_back(component);
    } else {
        *at = around_.back();
        around_.pop_back();
    }
}

void PrismArrangement::set_row(std::size_t layer, LeafIndex operand, bool in) {
    formula_.set(row(layer), as_index(operand), in ? 1 : 0);
    if (is_changed_[as_index(operand)]) return;
    is_changed_[as_index(operand)] = true;
    changed_.push_back(operand);
}

// What a side face's operand is on its other side, in the layers of another side face and next to
// them.
void PrismArrangement::turn_over(const PrismSideFace& crossed, const PrismSideFace& by) {
    const std::size_t first = std::max(crossed.first_layer, by.first_layer - 1);
    const std::size_t end = std::min(crossed.end_layer, by.end_layer + 1);
    for (std::size_t layer = first; layer < end; ++layer)
        set_row(layer, crossed.operand, row(layer)[as_index(crossed.operand)] == 0);
}

// --- Along a side face.

void PrismArrangement::walk_side_face(const Step& step) {
    const PrismSideFace& w = side_face(step.side_face);
    begins_.clear();
    insides_.clear();
    for (std::size_t end = 0; end < 2; ++end) {
        const bool beyond =
            row(end == 0 ? w.first_layer - 1 : w.end_layer)[as_index(w.operand)] != 0;
        cap_is_left_[end] = beyond != w.inside_is_left;
    }
    look(w, step.backwards ? at_to : at_from);
    const auto all = crossings_.of(step.side_face);
    const auto place = [&](std::size_t i) -> const PrismCrossing& {
        return all[step.backwards ? all.size() - 1 - i : i];
    };
    for (std::size_t i = 0; i < all.size();) {
        const std::size_t first = i;
        Bound name = place(i).side_face;
        do {
            const LeafIndex other = place(i).side_face;
            name = std::min(name, other);
            turn_over(side_face(other), w);
            for (const std::int32_t component : components_.of_side_face(other))
                enter_component(component);
            ++i;
        } while (i < all.size() && crossings_.compare(place(first), place(i)) == 0);
        look(w, name);
    }
    if (step.backwards) turn_intervals();
}

// Begins an interval, unless all is as it was before.
void PrismArrangement::look(const PrismSideFace& w, Bound begin) {
    const std::size_t first = w.first_layer - 1;
    const std::size_t before = insides_.size();
    for (std::size_t i = 0; i < layers_here_; ++i) {
        const auto value = [&] { return formula_.value(row(first + i)) == 1; };
        Inside here;
        if (w.is_in(first + i)) {
            set_row(first + i, w.operand, w.inside_is_left);
            here.left = value();
            set_row(first + i, w.operand, !w.inside_is_left);
            here.right = value();
        } else {
            here.left = here.right = value();
        }
        insides_.push_back(here);
    }
    const auto here = std::span(insides_).subspan(before);
    for (const std::int32_t s : around_) {
        PrismComponents::Component& component = components_[s];
        if (component.position < first || component.position >= w.end_layer) continue;
        const auto [left, right] = bounds(here, component.position - first);
        component.whole = component.whole && left == right;
    }
    if (!begins_.empty() && std::ranges::equal(here, interval(begins_.size() - 1))) {
        insides_.resize(before);
    } else {
        begins_.push_back(begin);
    }
}

// What begins where the walk began ends there.
void PrismArrangement::turn_intervals() {
    const std::size_t n = begins_.size();
    std::reverse(begins_.begin() + 1, begins_.end());
    begins_[0] = at_from;
    for (std::size_t i = 0; i < n / 2; ++i)
        std::swap_ranges(
            insides_.begin() + static_cast<std::ptrdiff_t>(i * layers_here_),
            insides_.begin() + static_cast<std::ptrdiff_t>((i + 1) * layers_here_),
            insides_.begin() + static_cast<std::ptrdiff_t>((n - 1 - i) * layers_here_));
}

// On both sides: 1 where only the layer below position i (of those here) is inside, -1 where only
// the one above it is.
std::array<int, 2> PrismArrangement::bounds(std::span<const Inside> layers, std::size_t i) {
    const auto sign = [](bool below, bool above) { return (below ? 1 : 0) - (above ? 1 : 0); };
    return {sign(layers[i].left, layers[i + 1].left), sign(layers[i].right, layers[i + 1].right)};
}

// --- What bounds the result.

void PrismArrangement::judge_side_face(LeafIndex i) {
    const SideFaceState state = state_of(i);
    faces_here_ = {-1, -1};
    add_whole(side_face(i), state);
    add_horizontal_edges(i, state);
    if (state.outlined == both_halves) {
        add_vertical_edges(i, state);
    } else if (state.outlined != 0) {
        add_half(i, state);
    }
}

PrismArrangement::SideFaceState PrismArrangement::state_of(LeafIndex i) const {
    const PrismSideFace& w = side_face(i);
    SideFaceState out;
    out.facing = facing(insides_[1]);
    for (std::size_t s = 0; s < begins_.size(); ++s)
        for (const Inside& in : interval(s).subspan(1, layers_here_ - 2))
            if (facing(in) != out.facing) return {0, both_halves, Facing::None};
    if (out.facing == Facing::None) return out;
    if (w.wall >= 0) {
        const bool unbroken = is_unbroken(0) && is_unbroken(layers_here_ - 2);
        (unbroken ? out.whole : out.outlined) = both_halves;
        return out;
    }
    for (std::size_t half = 0; half < 2; ++half)
        (is_unbroken(is_low(w, half) ? 0 : layers_here_ - 2) ? out.whole : out.outlined) |= 1U
                                                                                            << half;
    return out;
}

// Whether a half of a side face has its edge perpendicular to the axis at the lower end.
bool PrismArrangement::is_low(const PrismSideFace& w, std::size_t half) const {
    const PolygonRef& f = w.facets[half];
    const int third = (w.upright[half].edge + 2) % 3;
    return f.source->corner(f.facet, third)[static_cast<int>(facets_.axis())] == w.lo;
}

bool PrismArrangement::is_unbroken(std::size_t position) const {
    for (std::size_t s = 1; s < begins_.size(); ++s)
        if (!is_same_beside(position, 0, s)) return false;
    return true;
}

// Whether two intervals have the same on all four sides of a position (of those here).
bool PrismArrangement::is_same_beside(std::size_t position, std::size_t s, std::size_t t) const {
    return std::ranges::equal(interval(s).subspan(position, 2), interval(t).subspan(position, 2));
}

void PrismArrangement::add_whole(const PrismSideFace& w, const SideFaceState& state) {
    if (w.wall < 0) return add_whole_halves(w, state);
    if (state.whole == 0) return;
    for (PolygonRef ref : facets_.walls().facets(w.wall)) {
        ref.flipped = (state.facing == Facing::InsideLeft) == w.above_is_left[0];
        out_.push_back(ref);
    }
}

void PrismArrangement::add_whole_halves(const PrismSideFace& w, const SideFaceState& state) {
    for (std::size_t half = 0; half < 2; ++half) {
        if ((state.whole >> half & 1U) == 0) continue;
        PolygonRef ref = w.facets[half];
        ref.flipped = (state.facing == Facing::InsideLeft) == w.above_is_left[half];
        out_.push_back(ref);
    }
}

// The parts of an edge between corners within it. `turned`: from its end to its beginning.
template <class Out>
void PrismArrangement::divide(const PrismSideFace& w, NamedOutlines::Edge edge,
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

void PrismArrangement::add_horizontal_edges(LeafIndex i, const SideFaceState& state) {
    const PrismSideFace& w = side_face(i);
    for (std::size_t p = 0; p + 1 < layers_here_; ++p) {
        const bool is_end = p == 0 || p + 2 == layers_here_;
        bool wanted = state.outlined == both_halves;
        for (std::size_t half = 0; half < 2; ++half)
            wanted = wanted || ((state.outlined >> half & 1U) != 0 &&
                                p == (is_low(w, half) ? 0 : layers_here_ - 2));
        const bool unbroken = is_unbroken(p);
        for (std::size_t s = 0; s < begins_.size();) {
            std::size_t t = s + 1;
            while (t < begins_.size() && is_same_beside(p, s, t)) ++t;
            if (is_end) note_component(i, p, bounds(interval(s), p), unbroken);
            add_cap_edges(i, p, s, t);
            if (wanted) add_side_face_edges(i, p, s, t, state);
            s = t;
        }
    }
}

void PrismArrangement::note_component(LeafIndex i, std::size_t p, std::array<int, 2> bounds,
                                      bool unbroken) {
    const std::size_t end = p == 0 ? 0 : 1;
    PrismComponents::Component& component = components_[components_.of_side_face(i)[end]];
    const std::size_t side = cap_is_left_[end] ? 0 : 1;
    const int here = bounds[side];
    component.whole = component.whole && unbroken && here != 0 && here != bounds[1 - side] &&
                      (component.bounds == 0 || component.bounds == here);
    component.bounds = here;
}

// Of the faces in the plane of the position, to the left and to the right of intervals [s, t).
void PrismArrangement::add_cap_edges(LeafIndex i, std::size_t p, std::size_t s, std::size_t t) {
    const PrismSideFace& w = side_face(i);
    const std::size_t position = w.first_layer - 1 + p;
    const auto beside = bounds(interval(s), p);
    if (beside[0] == beside[1]) return;
    for (std::size_t side = 0; side < 2; ++side) {
        if (beside[side] == 0) continue;
        const bool up = beside[side] > 0;
        const bool left = side == 0;
        CapEdge out;
        for (std::size_t end = 0; end < 2; ++end)
            if (p == (end == 0 ? 0 : layers_here_ - 2) && cap_is_left_[end] == left)
                out.component = components_.of_side_face(i)[end];
        out.side_face = i;
        out.from = begins_[s];
        out.to = end_of_interval(t - 1);
        out.face = static_cast<std::uint32_t>(2 * position + (up ? 1 : 0));
        out.left = left;
        out.all = is_all_at_end(p, s, t);
        cap_edges_.push_back(out);
    }
}

// Where intervals [s, t) of the side face begin or end to bound the result, along the axis.
void PrismArrangement::add_side_face_edges(LeafIndex i, std::size_t p, std::size_t s, std::size_t t,
                                           const SideFaceState& state) {
    const PrismSideFace& w = side_face(i);
    const std::size_t position = w.first_layer - 1 + p;
    const Facing below = facing(interval(s)[p]);
    const Facing above = facing(interval(s)[p + 1]);
    if (below == above) return;
    const bool upper_is_above = facets_.faces_up(facets_.cap_at(position));
    for (const Facing f : {below, above}) {
        if (f == Facing::None) continue;
        const bool is_above = f == above;
        NamedOutlines::Edge e;
        e.from = vertex(i, begins_[s], position);
        e.to = vertex(i, end_of_interval(t - 1), position);
        e.line = {plane_at(position), is_above == upper_is_above};
        e.face = face_of_side_face(i, f, state);
        divide(side_face(i), e, corners_between(i, position, is_all_at_end(p, s, t)),
               (f == Facing::InsideLeft) != is_above,
               [&](const NamedOutlines::Edge& part) { outlines_.edges.push_back(part); });
    }
}

void PrismArrangement::add_vertical_edges(LeafIndex i, const SideFaceState& state) {
    for (std::size_t layer = 1; layer + 1 < layers_here_; ++layer)
        for (std::size_t s = 0; s < begins_.size();) {
            const Facing f = facing(interval(s)[layer]);
            std::size_t t = s + 1;
            while (t < begins_.size() && facing(interval(t)[layer]) == f) ++t;
            if (f != Facing::None) {
                add_upright(i, begins_[s], true, layer, layer + 1, f, state);
                add_upright(i, end_of_interval(t - 1), false, layer, layer + 1, f, state);
            }
            s = t;
        }
}

// The edge in which a face of the side face begins (or ends, seen from `from` to `to`), in layers
// [first, end) of those here.
void PrismArrangement::add_upright(LeafIndex i, Bound b, bool begins, std::size_t first,
                                   std::size_t end, Facing f, const SideFaceState& state) {
    const std::size_t below =
        side_face(i).first_layer - 2;  // the position below layer 0 of those here
    NamedOutlines::Edge e;
    e.from = vertex(i, b, below + first);
    e.to = vertex(i, b, below + end);
    e.line = side_of_bound(i, b, begins);
    e.face = face_of_side_face(i, f, state);
    divide(side_face(i), e, corners_upright(i, b, below + first, below + end),
           (f == Facing::InsideLeft) == begins,
           [&](const NamedOutlines::Edge& part) { outlines_.edges.push_back(part); });
}

// One half of a side face that bounds the result as a whole: vertices lie in the edge that it ends
// with.
void PrismArrangement::add_half(LeafIndex i, const SideFaceState& state) {
    const PrismSideFace& w = side_face(i);
    const std::size_t half = state.outlined == 1 ? 0 : 1;
    add_upright(i, half == 0 ? at_from : at_to, half == 0, 1, layers_here_ - 1, state.facing,
                state);
    // From corner (k + 1) to corner (k + 2) or from there to corner k, the upright edge being from
    // corner k to the next one.
    const PolygonRef& f = w.facets[half];
    const UprightEdge& upright = w.upright[half];
    const bool third_is_low = is_low(w, half);
    const bool first_is_low = upright.edge == upright.low;
    const int k = first_is_low == third_is_low ? upright.edge + 1 : upright.edge + 2;
    NamedOutlines::Edge e;
    e.from = NamedOutlines::Vertex::corner_of(f.source, f.facet, k % 3);
    e.to = NamedOutlines::Vertex::corner_of(f.source, f.facet, (k + 1) % 3);
    if ((state.facing == Facing::InsideLeft) == w.above_is_left[half]) std::swap(e.from, e.to);
    e.line = {PlaneName::edge(f.source, f.facet, k % 3), false};
    e.face = face_of_side_face(i, state.facing, state);
    outlines_.edges.push_back(e);
}

// --- Corners of walls.
//
// Where a wall passes through as it is, all corners of its facets are vertices, and what is
// outlined beside it has them in its edges. Where nothing beside it is whole, assembly takes them
// out again.

// `all`: is_all_at_end().
std::span<const PrismCorner> PrismArrangement::corners_between(LeafIndex i, std::size_t position,
                                                               bool all) const {
    const PrismSideFace& w = side_face(i);
    if (w.wall < 0 || !all) return {};
    const bool is_low = position + 1 == w.first_layer;
    const auto side = facets_.walls().side(w.wall, is_low ? PrismWalls::Bottom : PrismWalls::Top);
    return side.subspan(1, side.size() - 2);
}

// Between two positions.
std::span<const PrismCorner> PrismArrangement::corners_upright(LeafIndex i, Bound b,
                                                               std::size_t below,
                                                               std::size_t above) const {
    const PrismSideFace& w = side_face(i);
    if (w.wall < 0 || b >= 0) return {};
    const auto side =
        facets_.walls().side(w.wall, b == at_from ? PrismWalls::AtFrom : PrismWalls::AtTo);
    const auto first = std::ranges::partition_point(
        side, [&](const PrismCorner& c) { return height_of(w, c) <= facets_.positions()[below]; });
    const auto end = std::ranges::partition_point(
        side, [&](const PrismCorner& c) { return height_of(w, c) < facets_.positions()[above]; });
    return {first, end};
}

std::uint32_t PrismArrangement::face_of_wall(const PrismSideFace& w, bool left) {
    const Source* const source = w.facets[0].source;
    const std::uint32_t facet = facets_.walls().first_facet(w.wall);
    outlines_.faces.push_back({source, facet, left == w.above_is_left[0]});
    if (facets_.walls().has_several_faces(w.wall))
        outlines_.first_facets.push_back({source, facet, false});
    return static_cast<std::uint32_t>(outlines_.faces.size() - 1);
}

// Named after the half that is outlined, or the first one.
std::uint32_t PrismArrangement::face_of_side_face(LeafIndex i, Facing f,
                                                  const SideFaceState& state) {
    const PrismSideFace& w = side_face(i);
    const bool left = f == Facing::InsideLeft;
    std::int32_t& face = faces_here_[left ? 0 : 1];
    if (face < 0 && w.wall >= 0) face = static_cast<std::int32_t>(face_of_wall(w, left));
    if (face < 0) {
        std::size_t half = w.facets[0].facet < w.facets[1].facet ? 0 : 1;
        if (state.outlined != both_halves) half = state.outlined == 1 ? 0 : 1;
        face = static_cast<std::int32_t>(outlines_.faces.size());
        outlines_.faces.push_back(
            {w.facets[half].source, w.facets[half].facet, left == w.above_is_left[half]});
    }
    return static_cast<std::uint32_t>(face);
}

NamedOutlines::Vertex PrismArrangement::vertex(LeafIndex i, Bound b, std::size_t position) const {
    using Vertex = NamedOutlines::Vertex;
    if (b >= 0) return Vertex::meet(support_of(i), support_of(b), plane_at(position));
    const PrismSideFace& w = side_face(i);
    const std::size_t end = b == at_from ? 0 : 1;
    const bool is_low = position + 1 == w.first_layer;
    if (is_low || position + 1 == w.end_layer)
        return vertex_of(w, facets_.corner_of(w, end, !is_low));
    if (w.wall >= 0)
        for (const PrismCorner& c :
             facets_.walls().side(w.wall, end == 0 ? PrismWalls::AtFrom : PrismWalls::AtTo))
            if (height_of(w, c) == facets_.positions()[position]) return vertex_of(w, c);
    const PolygonRef& f = w.facets[end];
    return Vertex::meet(support_of(i), PlaneName::edge(f.source, f.facet, w.upright[end].edge),
                        plane_at(position));
}

// The line of a face's upright edge at a bound. `keeps_to`: the face lies towards the side face's
// `to`.
EdgeName PrismArrangement::side_of_bound(LeafIndex i, Bound b, bool keeps_to) const {
    const PrismSideFace& w = side_face(i);
    if (b < 0) {
        const std::size_t end = b == at_from ? 0 : 1;
        const PolygonRef& f = w.facets[end];
        return {PlaneName::edge(f.source, f.facet, w.upright[end].edge), false};
    }
    const PrismSideFace& other = side_face(b);
    const bool left = turn(other.from, other.to, keeps_to ? w.to : w.from) > 0;
    return {support_of(b), left == other.above_is_left[0]};
}

// --- Caps.

namespace {

// The caps in one plane.
struct CapPlane {
    static constexpr std::size_t none = ~std::size_t{0};
    std::size_t any = none;    // the last one that was looked at
    std::size_t first = none;  // that is not whole
    bool several = false;      // faces of operands that are not whole
    bool mixed = false;        // sources, or the first one is not the first of its source
};

bool are_of_one_face(const PolygonRef& a, const PolygonRef& b) {
    return a.source == b.source && a.source->face_of(a.facet) == b.source->face_of(b.facet);
}

}  // namespace

void PrismArrangement::finish_caps() {
    std::vector<CapPlane> planes(facets_.positions().size());
    const auto caps = facets_.caps();
    for (std::size_t c = 0; c < caps.size(); ++c) {
        const PrismComponents::Component& component = components_[components_.of_cap(c)];
        CapPlane& plane = planes[component.position];
        plane.mixed = plane.mixed || caps[c].ref.source != caps[std::min(plane.any, c)].ref.source;
        plane.any = c;
        if (!component.whole) {
            plane.first = std::min(plane.first, c);
            const PolygonRef& first = caps[plane.first].ref;
            plane.several = plane.several || !are_of_one_face(first, caps[c].ref);
            plane.mixed = plane.mixed || first.facet > caps[c].ref.facet;
            continue;
        }
        PolygonRef ref = caps[c].ref;
        ref.flipped = (component.bounds > 0) != facets_.faces_up(ref);
        out_.push_back(ref);
    }
    const auto is_left_out = [&](const CapEdge& c) {
        return c.component >= 0 && components_[c.component].whole;
    };
    std::vector<std::int32_t> faces(2 * planes.size(), -1);
    std::size_t count = outlines_.edges.size();
    for (const CapEdge& c : cap_edges_)
        if (!is_left_out(c)) count += 1 + corners_between(c.side_face, c.face / 2, c.all).size();
    outlines_.edges.reserve(count);
    for (const CapEdge& c : cap_edges_) {
        if (is_left_out(c)) continue;
        std::int32_t& face = faces[c.face];
        if (face < 0) {
            const std::size_t first = planes[c.face / 2].first;
            TRISECT_EXPECTS(first != CapPlane::none, "an outline where all components are whole");
            const PolygonRef& ref = caps[first].ref;
            const bool up = c.face % 2 == 1;
            face = static_cast<std::int32_t>(outlines_.faces.size());
            outlines_.faces.push_back({ref.source, ref.facet, up != facets_.faces_up(ref)});
        }
        add_cap_edge(c, static_cast<std::uint32_t>(face));
    }
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const bool is_outlined = faces[2 * i] >= 0 || faces[2 * i + 1] >= 0;
        if (!planes[i].several || !is_outlined) continue;
        const PolygonRef& ref = caps[planes[i].first].ref;
        if (planes[i].mixed) {
            outlines_.names_hold_everywhere = false;
        } else {
            outlines_.first_facets.push_back({ref.source, ref.facet, false});
        }
    }
}

void PrismArrangement::add_cap_edge(const CapEdge& c, std::uint32_t face) {
    const PrismSideFace& w = side_face(c.side_face);
    const std::size_t position = c.face / 2;
    const bool up = c.face % 2 == 1;
    NamedOutlines::Edge e;
    e.from = vertex(c.side_face, c.from, position);
    e.to = vertex(c.side_face, c.to, position);
    e.line = {support_of(c.side_face), c.left == w.above_is_left[0]};
    e.face = face;
    divide(w, e, corners_between(c.side_face, position, c.all), c.left != up,
           [&](const NamedOutlines::Edge& part) { outlines_.edges.push_back(part); });
}

}  // namespace trisect::detail
