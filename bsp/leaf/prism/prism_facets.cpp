// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/prism/prism_facets.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

#include <trisect/bsp/leaf/prism/crossed_ways.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/task_group.h>

namespace trisect::detail {

namespace {

auto side_face_key(const PrismSideFace& w) {
    return std::tuple(w.operand, w.from, w.to, w.lo, w.hi, w.facets[0].source != nullptr ? 0 : 1);
}

bool same_rectangle(const PrismSideFace& a, const PrismSideFace& b) {
    return a.operand == b.operand && a.from == b.from && a.to == b.to && a.lo == b.lo &&
           a.hi == b.hi;
}

bool is_whole_facet(const PolygonRef& ref) {
    return ref.fragment == nullptr && !ref.source->is_half_space();
}

bool is_half(const PrismSideFace& w) {
    return w.facets[0].source == nullptr || w.facets[1].source == nullptr;
}

// Whether they are the two halves of one rectangle.
bool do_fit(const PrismSideFace& a, const PrismSideFace& b) {
    return is_half(a) && is_half(b) && same_rectangle(a, b) &&
           a.inside_is_left == b.inside_is_left &&
           (a.facets[0].source == nullptr) != (b.facets[0].source == nullptr);
}

// The first one becomes the rectangle.
void join(PrismSideFace& a, const PrismSideFace& b) {
    const std::size_t half = a.facets[0].source == nullptr ? 0 : 1;
    a.facets[half] = b.facets[half];
    a.upright[half] = b.upright[half];
    a.above_is_left[half] = b.above_is_left[half];
}

}  // namespace

bool PrismFacets::faces_up(const PolygonRef& cap) const {
    const auto corner = [&](int i) { return flat(cap.source->corner(cap.facet, i)); };
    return turn(corner(0), corner(1), corner(2)) > 0;
}

// Two of its corners have two coordinates in common, or all three have one.
bool PrismFacets::may_be_of_prism(const PolygonRef& polygon) {
    if (polygon.fragment != nullptr || polygon.source->is_half_space()) return false;
    std::array<int, 3> equal{};  // by axis: sides along which it does not change
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& a = polygon.source->corner(polygon.facet, i);
        const LatticePoint& b = polygon.source->corner(polygon.facet, (i + 1) % 3);
        int here = 0;
        for (std::size_t k = 0; k < 3; ++k)
            if (coordinate(a, k) == coordinate(b, k)) {
                ++equal[k];
                ++here;
            }
        if (here == 2) return true;
    }
    return std::ranges::any_of(equal, [](int n) { return n == 3; });
}

bool PrismFacets::may_be_of_wall(const PolygonRef& polygon) {
    if (polygon.fragment != nullptr || polygon.source->is_half_space()) return false;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (FlatFacet(polygon, axis).is_upright()) return true;
    return false;
}

bool PrismFacets::list(const LeafProblem& problem, bool takes_walls, std::uint32_t threads) {
    threads_ = threads;
    const auto may_be = takes_walls ? &may_be_of_wall : &may_be_of_prism;
    for (const LeafOperand& o : problem.operands)
        if (!o.embedded ||
            (!o.polygons.empty() && !(may_be(o.polygons.front()) && may_be(o.polygons.back()))))
            return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (takes_walls && !may_be_along(problem, axis)) continue;
        if (!list_along(problem, axis, takes_walls)) continue;
        // Where everything is axis-perpendicular other ways are shorter, whatever the axis.
        if (is_grid()) return false;
        if (!find_layers()) continue;
        find_outside(problem);
        return true;
    }
    return false;
}

// A look at some facets all over each operand, before all are listed.
bool PrismFacets::may_be_along(const LeafProblem& problem, std::size_t axis) {
    constexpr std::size_t few = 64;
    return std::ranges::all_of(problem.operands, [&](const LeafOperand& o) {
        const std::size_t count = std::min(few, o.polygons.size());
        for (std::size_t i = 0; i < count; ++i) {
            const PolygonRef& ref = o.polygons[i * o.polygons.size() / count];
            if (ref.fragment != nullptr || ref.source->is_half_space()) return false;
            const FlatFacet flat(ref, axis);
            if (!flat.is_cap() && !flat.is_upright()) return false;
        }
        return true;
    });
}

bool PrismFacets::list_along(const LeafProblem& problem, std::size_t axis, bool takes_walls) {
    axis_ = axis;
    side_faces_.clear();
    walls_.clear();
    caps_.clear();
    std::size_t size = 0;
    for (const LeafOperand& o : problem.operands) size += o.polygons.size();
    // Prisms over polygons have as many caps as side faces, each of two halves.
    if (takes_walls) side_faces_.reserve(size / 4 + problem.operands.size());
    if (takes_walls) caps_.reserve(size / 2);
    for (std::size_t o = 0; o < problem.operands.size(); ++o)
        if (!list_operand(problem, o, takes_walls)) return false;
    return true;
}

bool PrismFacets::list_operand(const LeafProblem& problem, std::size_t operand, bool takes_walls) {
    const LeafOperand& o = problem.operands[operand];
    const std::size_t first = side_faces_.size();
    const std::size_t first_cap = caps_.size();
    constexpr std::size_t many = 32768;
    Halves halves;
    bool all_in_cell = true;
    const auto list_halves_of = [&] { halves = list_halves(problem, operand); };
    const auto list_caps_of = [&] { all_in_cell = list_caps(problem, operand); };
    if (threads_ == 1 || o.polygons.size() < many) {
        list_halves_of();
        if (!halves.fit && !takes_walls) return false;
        list_caps_of();
    } else {
        both_at_once(list_caps_of, list_halves_of);
    }
    if (!all_in_cell || !halves.all_in_cell) return false;
    // Copies of a rectangle touch, which crossings show as well.
    const bool has_halves =
        halves.fit && ((takes_walls && halves.loose == 0) || join_halves(first));
    if (!takes_walls) return has_halves;
    if (has_halves && end_at_caps(first, first_cap)) return true;
    side_faces_.resize(first);
    return walls_.add(o.polygons, static_cast<LeafIndex>(operand), o.flipped, axis_, side_faces_) &&
           end_at_caps(first, first_cap);
}

bool PrismFacets::list_caps(const LeafProblem& problem, std::size_t operand) {
    for (const PolygonRef& ref : problem.operands[operand].polygons) {
        if (!is_whole_facet(ref)) return false;
        if (!FlatFacet(ref, axis_).is_cap()) continue;
        if (!problem.cell.contains(ref.box())) return false;
        caps_.push_back({static_cast<LeafIndex>(operand), ref, 0});
    }
    return true;
}

auto PrismFacets::list_halves(const LeafProblem& problem, std::size_t operand) -> Halves {
    const LeafOperand& o = problem.operands[operand];
    const std::size_t first = side_faces_.size();
    Halves out;
    for (const PolygonRef& ref : o.polygons) {
        if (!is_whole_facet(ref)) return {false, false, 0};
        const FlatFacet flat(ref, axis_);
        if (flat.is_cap()) continue;
        if (!problem.cell.contains(ref.box())) return {false, false, 0};
        if (!out.fit) continue;
        out.fit = add_half(ref, flat, static_cast<LeafIndex>(operand), o.flipped);
        if (!out.fit) continue;
        ++out.loose;
        // Mostly both halves are listed one after the other.
        if (side_faces_.size() > first + 1 && do_fit(side_faces_.end()[-2], side_faces_.back())) {
            join(side_faces_.end()[-2], side_faces_.back());
            side_faces_.pop_back();
            out.loose -= 2;
        }
    }
    return out;
}

bool PrismFacets::is_grid() const {
    return std::ranges::all_of(side_faces_, [](const PrismSideFace& w) {
        return w.from.u == w.to.u || w.from.v == w.to.v;
    });
}

bool PrismFacets::add_half(const PolygonRef& ref, const FlatFacet& flat, LeafIndex operand,
                           bool flipped) {
    const auto& [corners, height] = flat;
    // The edge along the axis.
    std::size_t i = 0;
    while (i < 3 && corners[i] != corners[(i + 1) % 3]) ++i;
    if (i == 3) return false;
    const std::size_t third = (i + 2) % 3;
    const auto [lo, hi] = std::minmax(height[i], height[(i + 1) % 3]);
    if (height[third] != lo && height[third] != hi) return false;
    PrismSideFace w;
    w.operand = operand;
    w.lo = lo;
    w.hi = hi;
    w.from = corners[i];
    w.to = corners[third];
    const bool turned = w.to < w.from;
    if (turned) std::swap(w.from, w.to);
    // Up along the axis and then away from it: the normal is to the left of that way.
    const bool up = height[i] < height[(i + 1) % 3];
    const std::size_t half = turned ? 1 : 0;
    const auto low = static_cast<std::uint8_t>(up ? i : (i + 1) % 3);
    const auto high = static_cast<std::uint8_t>(up ? (i + 1) % 3 : i);
    w.facets[half] = ref;
    w.upright[half] = {low, high, static_cast<std::uint8_t>(i)};
    w.above_is_left[half] = up != turned;
    const bool outside_above = ref.flipped == flipped;
    w.inside_is_left = outside_above != w.above_is_left[half];
    side_faces_.push_back(w);
    return true;
}

// Of an operand, the last ones that are listed. Some are joined.
bool PrismFacets::join_halves(std::size_t first) {
    const auto listed = std::span(side_faces_).subspan(first);
    std::sort(listed.begin(), listed.end(), [](const PrismSideFace& a, const PrismSideFace& b) {
        return side_face_key(a) < side_face_key(b);
    });
    std::size_t joined = first;
    for (std::size_t i = first; i < side_faces_.size(); ++i) {
        PrismSideFace w = side_faces_[i];
        if (is_half(w)) {
            if (++i == side_faces_.size() || !do_fit(w, side_faces_[i])) return false;
            join(w, side_faces_[i]);
        }
        if (joined > first && same_rectangle(side_faces_[joined - 1], w)) return false;
        side_faces_[joined++] = w;
    }
    side_faces_.resize(joined);
    return true;
}

// Of each height one, in order. Facets of the two ends of a prism mostly alternate.
std::vector<Coordinate> PrismFacets::heights_of(std::span<const PrismCap> caps) const {
    std::vector<Coordinate> out;
    constexpr std::ptrdiff_t few = 4;
    for (const PrismCap& c : caps) {
        const Coordinate h = height_of(c);
        const auto last = out.end() - std::min(few, std::ssize(out));
        if (std::find(last, out.end(), h) == out.end()) out.push_back(h);
    }
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

// The last side faces that are listed, at caps of their operand: a grid is made of rectangles as
// well.
bool PrismFacets::end_at_caps(std::size_t first, std::size_t first_cap) const {
    const std::vector<Coordinate> heights = heights_of(std::span(caps_).subspan(first_cap));
    return std::ranges::all_of(std::span(side_faces_).subspan(first), [&](const PrismSideFace& w) {
        return std::ranges::binary_search(heights, w.lo) &&
               std::ranges::binary_search(heights, w.hi);
    });
}

bool PrismFacets::find_layers() {
    constexpr std::size_t least_placed = 4096;
    positions_ = heights_of(caps_);
    const auto index = [&](Coordinate p) {
        return static_cast<std::size_t>(std::ranges::lower_bound(positions_, p) -
                                        positions_.begin());
    };
    std::atomic<bool> ends = true;
    ParallelParts(side_faces_.size(), threads_, least_placed)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (PrismSideFace& w : std::span(side_faces_).subspan(begin, end - begin)) {
                w.first_layer = index(w.lo) + 1;
                w.end_layer = index(w.hi) + 1;
                // Ends where it meets no cap.
                if (w.end_layer > positions_.size() || positions_[w.first_layer - 1] != w.lo ||
                    positions_[w.end_layer - 1] != w.hi)
                    ends.store(false, std::memory_order_relaxed);
            }
        });
    if (!ends) return false;
    ParallelParts(caps_.size(), threads_, least_placed)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (PrismCap& c : std::span(caps_).subspan(begin, end - begin))
                c.position = index(height_of(c));
        });
    named_.assign(positions_.size(), PolygonRef{});
    std::size_t unnamed = named_.size();
    for (auto c = caps_.begin(); unnamed != 0; ++c) {
        if (named_[c->position].source != nullptr) continue;
        named_[c->position] = c->ref;
        --unnamed;
    }
    sort_caps();
    return true;
}

// Mostly the order of each operand is that of its facets, so they are put position by position.
void PrismFacets::sort_caps() {
    const auto key = [](const PrismCap& c) {
        return std::tuple(c.position, c.operand, c.ref.source->serial(), c.ref.facet);
    };
    const auto is_before = [&](const PrismCap& a, const PrismCap& b) { return key(a) < key(b); };
    if (std::is_sorted(caps_.begin(), caps_.end(), is_before)) return;
    std::vector<std::size_t> next(positions_.size() + 1);
    for (const PrismCap& c : caps_) ++next[c.position + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    PoolVector<PrismCap> sorted(caps_.size());
    for (const PrismCap& c : caps_) sorted[next[c.position]++] = c;
    caps_.swap(sorted);
    if (!std::is_sorted(caps_.begin(), caps_.end(), is_before))
        std::sort(caps_.begin(), caps_.end(), is_before);
}

// From the reference straight to where nothing is, within its layer.
void PrismFacets::find_outside(const LeafProblem& problem) {
    outside_.clear();
    for (const LeafOperand& o : problem.operands)
        outside_.push_back(is_inside(o.winding, problem.options->winding) ? 1 : 0);
    const FinePoint& r = problem.reference;
    const auto layer = static_cast<std::size_t>(
        std::ranges::partition_point(positions_,
                                     [&](Coordinate p) { return compare(p, r.c[axis_]) <= 0; }) -
        positions_.begin());
    const FlatFinePoint point{r.c[(axis_ + 1) % 3], r.c[(axis_ + 2) % 3]};
    for (const PrismSideFace& w : side_faces_)
        if (w.is_in(layer) && crosses_way(w, point)) outside_[as_index(w.operand)] ^= 1;
}

}  // namespace trisect::detail
