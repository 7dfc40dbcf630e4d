// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/prism/prism_walk.h>

#include <algorithm>
#include <utility>

#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

PrismWalk::PrismWalk(const PrismFacets& facets, const PrismCrossings& crossings,
                     PrismComponents& components, const LeafFormula& formula)
    : facets_(&facets),
      crossings_(&crossings),
      components_(&components),
      names_(facets),
      formula_(formula),
      row_size_(formula.row_size()),
      is_changed_(facets.outside().size(), false),
      odd_(components.size(), 0) {
    const std::size_t layers = facets.positions().size() + 1;
    rows_.assign(layers * row_size_, 0);
    for (std::size_t layer = 0; layer < layers; ++layer) {
        std::ranges::copy(facets.outside(), row(layer).begin());
        formula_.fill(row(layer));
    }
}

// All side faces of a chain are in the same layers, and bound the same two components.
void PrismWalk::run(Chain chain, std::span<const LeafIndex> crossed) {
    const PrismSideFace& w = names_.side_face(chain[0].side_face);
    layers_here_ = w.end_layer - w.first_layer + 2;
    const std::array<std::int32_t, 2> own = components_->of_side_face(chain[0].side_face);
    around_.clear();
    met_.clear();
    for (const LeafIndex c : crossed) {
        for (const std::int32_t component : components_->of_side_face(c)) {
            odd_[as_index(component)] ^= 1U;
            met_.push_back(component);
        }
        turn_over(names_.side_face(c), w);
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
                         facets_->outside()[as_index(operand)]);
        is_changed_[as_index(operand)] = false;
    }
    changed_.clear();
}

// Components in the planes of other layers do no harm: they are not used.
void PrismWalk::enter_component(std::int32_t component) {
    const auto at = std::ranges::find(around_, component);
    if (at == around_.end()) {
        around_.push_back(component);
    } else {
        *at = around_.back();
        around_.pop_back();
    }
}

void PrismWalk::set_row(std::size_t layer, LeafIndex operand, bool in) {
    formula_.set(row(layer), as_index(operand), in ? 1 : 0);
    if (is_changed_[as_index(operand)]) return;
    is_changed_[as_index(operand)] = true;
    changed_.push_back(operand);
}

// What a side face's operand is on its other side, in the layers of another side face and next to
// them.
void PrismWalk::turn_over(const PrismSideFace& crossed, const PrismSideFace& by) {
    const std::size_t first = std::max(crossed.first_layer, by.first_layer - 1);
    const std::size_t end = std::min(crossed.end_layer, by.end_layer + 1);
    for (std::size_t layer = first; layer < end; ++layer)
        set_row(layer, crossed.operand, row(layer)[as_index(crossed.operand)] == 0);
}

// --- Along a side face.

void PrismWalk::walk_side_face(const Step& step) {
    const PrismSideFace& w = names_.side_face(step.side_face);
    begins_.clear();
    insides_.clear();
    for (std::size_t end = 0; end < 2; ++end) {
        const bool beyond =
            row(end == 0 ? w.first_layer - 1 : w.end_layer)[as_index(w.operand)] != 0;
        cap_is_left_[end] = beyond != w.inside_is_left;
    }
    look(w, step.backwards ? at_to : at_from);
    const auto all = crossings_->of(step.side_face);
    const auto place = [&](std::size_t i) -> const PrismCrossing& {
        return all[step.backwards ? all.size() - 1 - i : i];
    };
    for (std::size_t i = 0; i < all.size();) {
        const std::size_t first = i;
        Bound name = place(i).side_face;
        do {
            const LeafIndex other = place(i).side_face;
            name = std::min(name, other);
            turn_over(names_.side_face(other), w);
            for (const std::int32_t component : components_->of_side_face(other))
                enter_component(component);
            ++i;
        } while (i < all.size() && crossings_->compare(place(first), place(i)) == 0);
        look(w, name);
    }
    if (step.backwards) turn_intervals();
}

// Begins an interval, unless all is as it was before.
void PrismWalk::look(const PrismSideFace& w, Bound begin) {
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
        const std::size_t position = components_->position(s);
        if (position < first || position >= w.end_layer) continue;
        const auto [left, right] = bounds(here, position - first);
        if (left != right) components_->note(s, PrismComponents::Broken);
    }
    if (!begins_.empty() && std::ranges::equal(here, interval(begins_.size() - 1))) {
        insides_.resize(before);
    } else {
        begins_.push_back(begin);
    }
}

// What begins where the walk began ends there.
void PrismWalk::turn_intervals() {
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
std::array<int, 2> PrismWalk::bounds(std::span<const Inside> layers, std::size_t i) {
    const auto sign = [](bool below, bool above) { return (below ? 1 : 0) - (above ? 1 : 0); };
    return {sign(layers[i].left, layers[i + 1].left), sign(layers[i].right, layers[i + 1].right)};
}

// --- What bounds the result.

void PrismWalk::judge_side_face(LeafIndex i) {
    const SideFaceState state = state_of(i);
    faces_here_ = {-1, -1};
    add_whole(names_.side_face(i), state);
    add_horizontal_edges(i, state);
    if (state.outlined == both_halves) {
        add_vertical_edges(i, state);
    } else if (state.outlined != 0) {
        add_half(i, state);
    }
}

PrismWalk::SideFaceState PrismWalk::state_of(LeafIndex i) const {
    const PrismSideFace& w = names_.side_face(i);
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
bool PrismWalk::is_low(const PrismSideFace& w, std::size_t half) const {
    const PolygonRef& f = w.facets[half];
    const int third = (w.upright[half].edge + 2) % 3;
    return f.source->corner(f.facet, third)[static_cast<int>(facets_->axis())] == w.lo;
}

bool PrismWalk::is_unbroken(std::size_t position) const {
    for (std::size_t s = 1; s < begins_.size(); ++s)
        if (!is_same_beside(position, 0, s)) return false;
    return true;
}

// Whether two intervals have the same on all four sides of a position (of those here).
bool PrismWalk::is_same_beside(std::size_t position, std::size_t s, std::size_t t) const {
    return std::ranges::equal(interval(s).subspan(position, 2), interval(t).subspan(position, 2));
}

void PrismWalk::add_whole(const PrismSideFace& w, const SideFaceState& state) {
    if (w.wall < 0) return add_whole_halves(w, state);
    if (state.whole == 0) return;
    for (PolygonRef ref : facets_->walls().facets(w.wall)) {
        ref.flipped = (state.facing == Facing::InsideLeft) == w.above_is_left[0];
        found_.whole.push_back(ref);
    }
}

void PrismWalk::add_whole_halves(const PrismSideFace& w, const SideFaceState& state) {
    for (std::size_t half = 0; half < 2; ++half) {
        if ((state.whole >> half & 1U) == 0) continue;
        PolygonRef ref = w.facets[half];
        ref.flipped = (state.facing == Facing::InsideLeft) == w.above_is_left[half];
        found_.whole.push_back(ref);
    }
}

void PrismWalk::add_horizontal_edges(LeafIndex i, const SideFaceState& state) {
    const PrismSideFace& w = names_.side_face(i);
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

void PrismWalk::note_component(LeafIndex i, std::size_t p, std::array<int, 2> bounds,
                               bool unbroken) {
    const std::size_t end = p == 0 ? 0 : 1;
    const std::int32_t component = components_->of_side_face(i)[end];
    const std::size_t side = cap_is_left_[end] ? 0 : 1;
    const int here = bounds[side];
    if (!unbroken || here == 0 || here == bounds[1 - side])
        components_->note(component, PrismComponents::Broken);
    if (here != 0)
        components_->note(component, here > 0 ? PrismComponents::Below : PrismComponents::Above);
}

// Of the faces in the plane of the position, to the left and to the right of intervals [s, t).
void PrismWalk::add_cap_edges(LeafIndex i, std::size_t p, std::size_t s, std::size_t t) {
    const PrismSideFace& w = names_.side_face(i);
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
                out.component = components_->of_side_face(i)[end];
        out.side_face = i;
        out.from = begins_[s];
        out.to = end_of_interval(t - 1);
        out.face = static_cast<std::uint32_t>(2 * position + (up ? 1 : 0));
        out.left = left;
        out.all = is_all_at_end(p, s, t);
        found_.cap_edges.push_back(out);
    }
}

// Where intervals [s, t) of the side face begin or end to bound the result, along the axis.
void PrismWalk::add_side_face_edges(LeafIndex i, std::size_t p, std::size_t s, std::size_t t,
                                    const SideFaceState& state) {
    const PrismSideFace& w = names_.side_face(i);
    const std::size_t position = w.first_layer - 1 + p;
    const Facing below = facing(interval(s)[p]);
    const Facing above = facing(interval(s)[p + 1]);
    if (below == above) return;
    const bool upper_is_above = facets_->faces_up(facets_->cap_at(position));
    for (const Facing f : {below, above}) {
        if (f == Facing::None) continue;
        const bool is_above = f == above;
        NamedOutlines::Edge e;
        e.from = names_.vertex(i, begins_[s], position);
        e.to = names_.vertex(i, end_of_interval(t - 1), position);
        e.line = {names_.plane_at(position), is_above == upper_is_above};
        e.face = face_of_side_face(i, f, state);
        names_.divide(
            names_.side_face(i), e, names_.corners_between(i, position, is_all_at_end(p, s, t)),
            (f == Facing::InsideLeft) != is_above,
            [&](const NamedOutlines::Edge& part) { found_.outlines.edges.push_back(part); });
    }
}

void PrismWalk::add_vertical_edges(LeafIndex i, const SideFaceState& state) {
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
void PrismWalk::add_upright(LeafIndex i, Bound b, bool begins, std::size_t first, std::size_t end,
                            Facing f, const SideFaceState& state) {
    const std::size_t below =
        names_.side_face(i).first_layer - 2;  // the position below layer 0 of those here
    NamedOutlines::Edge e;
    e.from = names_.vertex(i, b, below + first);
    e.to = names_.vertex(i, b, below + end);
    e.line = side_of_bound(i, b, begins);
    e.face = face_of_side_face(i, f, state);
    names_.divide(names_.side_face(i), e, names_.corners_upright(i, b, below + first, below + end),
                  (f == Facing::InsideLeft) == begins,
                  [&](const NamedOutlines::Edge& part) { found_.outlines.edges.push_back(part); });
}

// One half of a side face that bounds the result as a whole: vertices lie in the edge that it ends
// with.
void PrismWalk::add_half(LeafIndex i, const SideFaceState& state) {
    const PrismSideFace& w = names_.side_face(i);
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
    found_.outlines.edges.push_back(e);
}

std::uint32_t PrismWalk::face_of_wall(const PrismSideFace& w, bool left) {
    const Source* const source = w.facets[0].source;
    const std::uint32_t facet = facets_->walls().first_facet(w.wall);
    found_.outlines.faces.push_back({source, facet, left == w.above_is_left[0]});
    if (facets_->walls().has_several_faces(w.wall))
        found_.outlines.first_facets.push_back({source, facet, false});
    return static_cast<std::uint32_t>(found_.outlines.faces.size() - 1);
}

// Named after the half that is outlined, or the first one.
std::uint32_t PrismWalk::face_of_side_face(LeafIndex i, Facing f, const SideFaceState& state) {
    const PrismSideFace& w = names_.side_face(i);
    const bool left = f == Facing::InsideLeft;
    std::int32_t& face = faces_here_[left ? 0 : 1];
    if (face < 0 && w.wall >= 0) face = static_cast<std::int32_t>(face_of_wall(w, left));
    if (face < 0) {
        std::size_t half = w.facets[0].facet < w.facets[1].facet ? 0 : 1;
        if (state.outlined != both_halves) half = state.outlined == 1 ? 0 : 1;
        face = static_cast<std::int32_t>(found_.outlines.faces.size());
        found_.outlines.faces.push_back(
            {w.facets[half].source, w.facets[half].facet, left == w.above_is_left[half]});
    }
    return static_cast<std::uint32_t>(face);
}

// The line of a face's upright edge at a bound. `keeps_to`: the face lies towards the side face's
// `to`.
EdgeName PrismWalk::side_of_bound(LeafIndex i, Bound b, bool keeps_to) const {
    const PrismSideFace& w = names_.side_face(i);
    if (b < 0) {
        const std::size_t end = b == at_from ? 0 : 1;
        const PolygonRef& f = w.facets[end];
        return {PlaneName::edge(f.source, f.facet, w.upright[end].edge), false};
    }
    const PrismSideFace& other = names_.side_face(b);
    const bool left = turn(other.from, other.to, keeps_to ? w.to : w.from) > 0;
    return {names_.support_of(b), left == other.above_is_left[0]};
}

}  // namespace trisect::detail
