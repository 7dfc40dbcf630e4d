// SPDX-License-Identifier: Apache-2.0
//
// Gears side by side, plates with holes, a stack of profiles: operands that are prisms along one
// axis, and many of them begin and end in the same planes. Compared facet by facet all caps
// coincide, every side face ends in every cap's plane, and nothing is in general position. Yet
// there is no more to it than an arrangement of segments in a plane, one for each layer between two
// caps' positions.
//
// So nothing is compared but side faces, as segments. Along a side face the operands that are
// inside on its two sides change only where other side faces cross it; with the order of these
// places, fractions of integers, the intervals that bound the result are read off. In the plane of
// a cap the result is bounded where the layers below and above it differ; of several operands with
// a cap there the first one is the representative. The division of that region among its
// representatives shows on the side faces' intervals, too: on the two sides of an interval other
// operands are representatives. A cap is cut along the intervals that bound its operand's share and
// no others, hence n coincident caps make n small sets of parts and not n² ones.
//
// Where side faces touch or overlap instead of crossing the leaf takes the exact path.

#include <trisect/bsp/leaf/prism/prism_leaf.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/leaf/prism/crossed_ways.h>
#include <trisect/bsp/leaf/split_piece.h>
#include <trisect/bsp/leaf/straight_crossings.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

constexpr std::size_t on_left = 0;
constexpr std::size_t on_right = 1;

}  // namespace

std::optional<LeafResult> PrismLeaf::try_to_arrange(const LeafProblem& problem,
                                                    LeafFindings& findings) {
    if (!facets_.list(problem)) return std::nullopt;
    // Fragments without owners end here, whatever is thrown or given up.
    struct EndCaps {
        std::vector<PolygonRef>& caps;
        ~EndCaps() {
            if (!caps.empty()) end_fragments(caps);
        }
    } const end_caps{caps_};
    EvaluateStats& stats = findings.stats;
    if (!arrange_listed(problem, stats)) return std::nullopt;
    emit_walls();
    out_.insert(out_.end(), caps_.begin(), caps_.end());
    stats.pieces += side_face_parts_.size() + caps_.size();
    caps_.clear();
    findings.note_uncertain(problem);
    if (keeps_common_lines_ && crossings_.any_coincide())
        findings.may_have_straight_crossings = true;
    return LeafPolygons{listed()};
}

void PrismLeaf::emit_walls() {
    for (std::size_t i = 0; i < side_face_parts_.size();) {
        std::size_t j = i + 1;
        while (j < side_face_parts_.size() &&
               side_face_parts_[j].interval.side_face == side_face_parts_[i].interval.side_face)
            ++j;
        emit_side_face(i, j);
        i = j;
    }
}

bool PrismLeaf::arrange_listed(const LeafProblem& problem, EvaluateStats& stats) {
    stats_ = &stats;
    if (!crossings_.find(problem, facets_.side_faces(), stats)) return false;
    bench_.clear();
    formula_.start(problem);
    keeps_common_lines_ = may_have_straight_crossings(problem);
    operands_ = problem.operands.size();
    row_size_ = formula_.row_size();
    rows_.assign(4 * row_size_, 0);
    insides_.assign(4 * operands_, 0);
    side_face_parts_.clear();
    caps_.clear();
    outlines_.resize(operands_);
    const auto side_faces = static_cast<LeafIndex>(facets_.side_faces().size());
    auto cap = facets_.caps().begin();
    for (std::size_t position = 0; position < facets_.positions().size(); ++position) {
        for (auto& intervals : outlines_) intervals.clear();
        for (LeafIndex i = 0; i < side_faces; ++i) {
            const PrismSideFace& w = facets_.side_faces()[as_index(i)];
            if (!w.is_in(position) && !w.is_in(position + 1)) continue;
            check_budget(*problem.options, stats);
            walk(i, position);
        }
        for (; cap != facets_.caps().end() && cap->position == position; ++cap) {
            check_budget(*problem.options, stats);
            if (!cut_cap(*cap)) return false;
        }
    }
    std::stable_sort(side_face_parts_.begin(), side_face_parts_.end(),
                     [](const SideFacePart& a, const SideFacePart& b) {
                         return a.interval.side_face < b.interval.side_face;
                     });
    return true;
}

// --- Along a side face.

void PrismLeaf::walk(LeafIndex i, std::size_t position) {
    const PrismSideFace& side_face = facets_.side_faces()[as_index(i)];
    start_walk(side_face, position);
    Interval interval{i, open, open};
    Sides now = sides();
    const auto crossings = crossings_.of(i);
    for (std::size_t c = 0; c < crossings.size();) {
        const std::size_t first = c;
        bool changed = false;
        std::size_t met = 0;  // in the layer below the position
        do {
            const PrismSideFace& other = facets_.side_faces()[as_index(crossings[c].side_face)];
            for (std::size_t layer = 0; layer < 2; ++layer) {
                if (!other.is_in(position + layer)) continue;
                met += layer == 0 ? 1 : 0;
                cross(other.operand, layer);
                changed = true;
            }
            ++c;
        } while (c < crossings.size() && crossings_.compare(crossings[first], crossings[c]) == 0);
        if (!changed) continue;
        const Sides next = sides();
        const bool is_common_line = keeps_common_lines_ && met > 1 && side_face.is_in(position);
        if (next == now && !is_common_line) continue;
        interval.end = crossings[first].side_face;
        add_interval(interval, now, position);
        if (is_common_line) end_part(interval, position);
        interval.begin = interval.end;
        now = next;
    }
    interval.end = open;
    add_interval(interval, now, position);
}

// What is where the side face begins. On its own operand's side there it is known without looking.
void PrismLeaf::start_walk(const PrismSideFace& side_face, std::size_t position) {
    for (std::size_t layer = 0; layer < 2; ++layer) {
        std::uint8_t* in = insides(layer, on_left);
        std::copy(facets_.outside().begin(), facets_.outside().end(), in);
        for (const PrismSideFace& w : facets_.side_faces())
            if (w.is_in(position + layer) && crosses_way(w, side_face.from))
                in[as_index(w.operand)] ^= 1;
        std::uint8_t* other = insides(layer, on_right);
        std::copy_n(in, operands_, other);
        if (side_face.is_in(position + layer)) {
            in[as_index(side_face.operand)] = side_face.inside_is_left ? 1 : 0;
            other[as_index(side_face.operand)] = side_face.inside_is_left ? 0 : 1;
        }
        for (const std::size_t side : {on_left, on_right}) {
            const std::span<int> r = row(layer, side);
            std::copy_n(insides(layer, side), operands_, r.begin());
            formula_.fill(r);
        }
    }
    for (const std::size_t side : {on_left, on_right}) {
        capped_[side].assign(operands_ / 64 + 1, 0);
        for (std::size_t o = 0; o < operands_; ++o)
            if (insides(0, side)[o] != insides(1, side)[o])
                capped_[side][o / 64] |= std::uint64_t{1} << o % 64;
    }
}

void PrismLeaf::cross(LeafIndex operand, std::size_t layer) {
    const std::size_t o = as_index(operand);
    for (const std::size_t side : {on_left, on_right}) {
        std::uint8_t& in = insides(layer, side)[o];
        in ^= 1;
        formula_.set(row(layer, side), o, in);
        capped_[side][o / 64] ^= std::uint64_t{1} << o % 64;
    }
}

PrismLeaf::Sides PrismLeaf::sides() const {
    Sides out;
    for (const std::size_t side : {on_left, on_right}) {
        const auto value = [&](std::size_t layer) {
            return formula_.value(
                std::span(rows_).subspan((2 * layer + side) * row_size_, row_size_));
        };
        out[side].below = value(0);
        out[side].above = value(1);
        if (!out[side].bounds()) continue;
        std::size_t word = 0;
        while (capped_[side][word] == 0) ++word;
        out[side].representative = static_cast<LeafIndex>(
            64 * word + static_cast<std::size_t>(std::countr_zero(capped_[side][word])));
    }
    return out;
}

void PrismLeaf::add_interval(const Interval& interval, const Sides& s, std::size_t position) {
    if (s[on_left].below != s[on_right].below) {
        const bool inside_left = s[on_left].below == 1;
        SideFacePart* last = side_face_parts_.empty() ? nullptr : &side_face_parts_.back();
        if (last != nullptr && last->interval.side_face == interval.side_face &&
            last->layer == position && last->inside_left == inside_left && !last->is_ended &&
            last->interval.end == interval.begin && interval.begin != open) {
            last->interval.end = interval.end;
        } else {
            side_face_parts_.push_back({interval, position, inside_left, false});
        }
    }
    const auto share = [](const Side& side) {
        return side.bounds() ? 2 * side.representative + side.below : -1;
    };
    if (share(s[on_left]) == share(s[on_right])) return;
    for (const std::size_t side : {on_left, on_right})
        if (s[side].bounds() && (side == on_left || !s[on_left].bounds() ||
                                 s[on_left].representative != s[on_right].representative))
            outlines_[as_index(s[side].representative)].push_back(interval);
}

// Other side faces cross in one line here: nothing that begins there is joined with what ends.
void PrismLeaf::end_part(const Interval& interval, std::size_t position) {
    if (side_face_parts_.empty()) return;
    SideFacePart& last = side_face_parts_.back();
    if (last.interval.side_face == interval.side_face && last.layer == position &&
        last.interval.end == interval.end)
        last.is_ended = true;
}

// --- Caps.

// A side face along an interval: its support, and the planes that end it.
WorkPolygon PrismLeaf::cutter_of(const Interval& interval) {
    const PrismSideFace& side_face = facets_.side_faces()[as_index(interval.side_face)];
    WorkPolygon out;
    out.support =
        bench_.plane(PlaneName::support(side_face.facets[0].source, side_face.facets[0].facet));
    const auto bound = [&](Bound b, std::size_t end) {
        const FlatCorner& kept = end == 0 ? side_face.to : side_face.from;
        if (b != open) {
            const PrismSideFace& other = facets_.side_faces()[as_index(b)];
            const PolygonRef& f = other.facets[0];
            out.edges.push_back({bench_.plane(PlaneName::support(f.source, f.facet)),
                                 is_left(b, kept) == other.above_is_left[0]});
            return;
        }
        const PolygonRef& f = side_face.facets[end];
        int i = 0;
        const auto corner = [&](int k) { return facets_.flat(f.source->corner(f.facet, k % 3)); };
        while (corner(i) != corner(i + 1)) ++i;
        out.edges.push_back({bench_.plane(PlaneName::edge(f.source, f.facet, i)), false});
    };
    bound(interval.begin, 0);
    bound(interval.end, 1);
    return out;
}

bool PrismLeaf::is_left(LeafIndex side_face, const FlatCorner& p) const {
    const PrismSideFace& w = facets_.side_faces()[as_index(side_face)];
    return turn(w.from, w.to, p) > 0;
}

bool PrismLeaf::cut_cap(const PrismCap& cap) {
    parts_.clear();
    cap_parts_.clear();
    keep_bench_small();
    WorkPolygon whole = bench_.polygon(cap.ref);
    bench_.with_edges(whole, cap.ref);
    parts_.push_back(whole);
    for (const Interval& s : outlines_[as_index(cap.operand)]) {
        const WorkPolygon cutter = cutter_of(s);
        const std::size_t end = parts_.size();
        for (std::size_t i = 0; i < end; ++i) {
            WorkPolygon above;
            if (split_along(bench_, parts_[i], cutter.support, cutter, false, above))
                parts_.push_back(std::move(above));
        }
    }
    bool all = true;
    for (WorkPolygon& p : parts_) {
        const auto side = side_of_middle(p, cap.position);
        if (!side) return false;
        const bool kept = side->bounds() && side->representative == cap.operand;
        all = all && kept;
        if (kept) cap_parts_.push_back({std::move(p), side->below == 1});
    }
    const bool whole_cap = all && std::ranges::all_of(cap_parts_, [&](const CapPart& p) {
                               return p.inside_below == cap_parts_[0].inside_below;
                           });
    if (whole_cap) cap_parts_.resize(1);
    for (const CapPart& p : cap_parts_) emit_cap(cap, p, whole_cap);
    return true;
}

// Most points of a cut cap are of parts that were cut further or dropped: what thousands of caps
// leave would be most of the memory of a leaf. \pre nothing holds numbers of points or planes.
void PrismLeaf::keep_bench_small() {
    constexpr std::size_t most_points = 1024;
    if (bench_.point_count() > most_points) bench_.clear();
}

// A part is on one side of whatever divides its cap's shares, so any point of it will do.
std::optional<PrismLeaf::Side> PrismLeaf::side_of_middle(const WorkPolygon& part,
                                                         std::size_t position) {
    ++stats_->traces;
    const std::size_t u_axis = (facets_.axis() + 1) % 3;
    const std::size_t v_axis = (facets_.axis() + 2) % 3;
    for (unsigned attempt = 0; attempt < 4; ++attempt) {
        std::array<double, 2> middle{};
        double weights = 0;
        double error = 0;
        double largest = 0;
        for (std::size_t i = 0; i < part.points.size(); ++i) {
            const Approximation& a = bench_.approximation(part.points[i]);
            const double weight = 1.0 + static_cast<double>((attempt * (i + 1) * 5) % 7);
            middle[0] += weight * a.c[u_axis];
            middle[1] += weight * a.c[v_axis];
            weights += weight;
            error = std::max(error, a.error);
            largest = std::max({largest, std::fabs(a.c[u_axis]), std::fabs(a.c[v_axis])});
        }
        for (double& c : middle) c /= weights;
        // A product, as many sums as there are points and a quotient round, each by a unit roundoff
        // of a sum that is at most the weights times the largest coordinate.
        error += last_place * static_cast<double>(part.points.size() + 2) * largest;
        bool sure = true;
        for (std::size_t layer = 0; layer < 2; ++layer)
            std::copy(facets_.outside().begin(), facets_.outside().end(), insides(layer, on_left));
        for (const PrismSideFace& w : facets_.side_faces()) {
            if (!w.is_in(position) && !w.is_in(position + 1)) continue;
            const auto crosses = crosses_way(w, middle, error);
            sure = crosses.has_value();
            if (!sure) break;
            if (!*crosses) continue;
            for (std::size_t layer = 0; layer < 2; ++layer)
                if (w.is_in(position + layer)) insides(layer, on_left)[as_index(w.operand)] ^= 1;
        }
        if (!sure) continue;
        Side out;
        for (std::size_t o = operands_; o-- > 0;)
            if (insides(0, on_left)[o] != insides(1, on_left)[o])
                out.representative = static_cast<LeafIndex>(o);
        for (std::size_t layer = 0; layer < 2; ++layer) {
            const std::span<int> r = row(layer, on_left);
            std::copy_n(insides(layer, on_left), operands_, r.begin());
            formula_.fill(r);
            (layer == 0 ? out.below : out.above) = formula_.value(r);
        }
        return out;
    }
    return std::nullopt;
}

// --- What bounds the result.

// The parts of one side face.
void PrismLeaf::emit_side_face(std::size_t first, std::size_t last) {
    keep_bench_small();
    const auto parts = std::span(side_face_parts_).subspan(first, last - first);
    const PrismSideFace& side_face = facets_.side_faces()[as_index(parts[0].interval.side_face)];
    const bool whole = parts.size() == side_face.end_layer - side_face.first_layer &&
                       std::ranges::all_of(parts, [&](const SideFacePart& p) {
                           return p.interval.begin == open && p.interval.end == open &&
                                  p.inside_left == parts[0].inside_left;
                       });
    if (!whole) {
        for (const SideFacePart& p : parts) emit_side_face_part(p);
        return;
    }
    for (std::size_t half = 0; half < 2; ++half) {
        PolygonRef ref = side_face.facets[half];
        ref.flipped = parts[0].inside_left == side_face.above_is_left[half];
        ref.touched = true;
        out_.push_back(ref);
    }
}

void PrismLeaf::emit_side_face_part(const SideFacePart& part) {
    const PrismSideFace& side_face = facets_.side_faces()[as_index(part.interval.side_face)];
    for (std::size_t half = 0; half < 2; ++half) {
        const PolygonRef& ref = side_face.facets[half];
        WorkPolygon shape = bench_.polygon(ref);
        bench_.with_edges(shape, ref);
        const auto clip = [&](const PolygonRef& by, bool above) {
            if (shape.is_empty()) return;
            shape = bench_.clipped(std::move(shape),
                                   bench_.plane(PlaneName::support(by.source, by.facet)),
                                   above ? 1 : -1);
        };
        const auto clip_at = [&](Bound b, const FlatCorner& kept) {
            if (b == open) return;
            const PrismSideFace& other = facets_.side_faces()[as_index(b)];
            clip(other.facets[0], is_left(b, kept) == other.above_is_left[0]);
        };
        clip_at(part.interval.begin, side_face.to);
        clip_at(part.interval.end, side_face.from);
        if (part.layer > side_face.first_layer) {
            const PolygonRef& cap = facets_.cap_at(part.layer - 1);
            clip(cap, facets_.faces_up(cap));
        }
        if (part.layer + 1 < side_face.end_layer) {
            const PolygonRef& cap = facets_.cap_at(part.layer);
            clip(cap, !facets_.faces_up(cap));
        }
        if (shape.is_empty()) continue;
        make_room(out_);
        out_.push_back(make_fragment(bench_, ref, shape));
        out_.back().flipped = part.inside_left == side_face.above_is_left[half];
    }
}

void PrismLeaf::emit_cap(const PrismCap& cap, const CapPart& part, bool whole) {
    make_room(caps_);
    caps_.push_back(whole ? cap.ref : make_fragment(bench_, cap.ref, part.shape));
    caps_.back().touched = caps_.back().touched || whole;
    caps_.back().flipped = part.inside_below != facets_.faces_up(cap.ref);
}

}  // namespace trisect::detail
