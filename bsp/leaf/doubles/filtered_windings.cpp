// SPDX-License-Identifier: Apache-2.0
//
// A trace is a straight segment from the leaf's reference point, or from the end of an earlier
// trace on the same operand, which is mostly near: then there is little to look at. It counts the
// facets that it goes through. The sides of a facet on which its ends are give the value of the
// facet's plane there; whether it goes through the facet or beside it is seen along the axis that
// is nearest to the normal. A segment so near to an edge that doubles cannot decide is given up.

#include <trisect/bsp/leaf/doubles/filtered_windings.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

// Whether a segment surely has a part of some length in a cell: it is clipped by the splitting
// planes, in doubles and with a margin.
bool runs_through(const FilteredFacets& facets, const Vector3& a, const Vector3& b) {
    const Vector3& lo = facets.inner_lo();
    const Vector3& hi = facets.inner_hi();
    for (std::size_t k = 0; k < 3; ++k)
        if (lo[k] > hi[k] || (a[k] < lo[k] && b[k] < lo[k]) || (a[k] > hi[k] && b[k] > hi[k]))
            return false;
    double from = 0;
    double to = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double d = b[k] - a[k];
        if (d == 0) continue;
        const double s = (lo[k] - a[k]) / d;
        const double t = (hi[k] - a[k]) / d;
        from = std::max(from, std::min(s, t));
        to = std::min(to, std::max(s, t));
    }
    return to - from > 0x1p-20;
}

// Whether a point of a facet's support, known up to its error, lies in the facet: 1 inside, -1
// outside, 0 when doubles cannot decide.
template <class Corner>
int is_inside(const FilteredFacet& f, const Corner& corner, const Approximation& x) {
    const Vector3& n = f.plane.normal;
    std::size_t k = std::fabs(n[0]) > std::fabs(n[1]) ? 0 : 1;
    if (std::fabs(n[2]) > std::fabs(n[k])) k = 2;
    // The sign of the largest component must be sure.
    if (std::fabs(n[k]) <= minor_rounding * f.plane.slope) return 0;
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    int inside = 1;
    for (std::size_t c = 0; c < f.size; ++c) {
        const auto& a = corner(c);
        const auto& b = corner(c + 1U < f.size ? c + 1 : 0);
        const double u = b.c[i] - a.c[i];
        const double v = b.c[j] - a.c[j];
        const double p = x.c[i] - a.c[i];
        const double q = x.c[j] - a.c[j];
        const double s = u * q;
        const double t = v * p;
        const double m = n[k] > 0 ? s - t : t - s;
        // What differences are off by, besides rounding: of the edge's ends, and of the point and
        // one of them.
        const double edge_error = a.error + b.error;
        const double point_error = a.error + x.error;
        const double error =
            minor_rounding * (std::fabs(s) + std::fabs(t)) +
            bound_slack * (point_error * (std::fabs(u) + std::fabs(v)) +
                           edge_error * (std::fabs(p) + std::fabs(q) + 2 * point_error));
        if (m < -error) return -1;
        if (m <= error) inside = 0;
    }
    return inside;
}

int is_inside(const FilteredFacets& facets, const FilteredFacet& f, const Approximation& x) {
    struct Exact {
        const Vector3& c;
        double error = 0;
    };
    if (f.is_whole())
        return is_inside(
            f, [&](std::size_t c) { return Exact{f.corners[c]}; }, x);
    const Approximation* const corners = facets.outline(f);
    return is_inside(
        f, [&](std::size_t c) -> const Approximation& { return corners[c]; }, x);
}

}  // namespace

void FilteredWindings::start(FilteredFacets& facets, const FilteredPairs& pairs) {
    facets_ = &facets;
    pairs_ = &pairs;
    operands_ = facets.operand_count();
    boxes_.resize(operands_);
    for (std::size_t o = 0; o < operands_; ++o) {
        boxes_[o].first = facets.first_of(o);
        boxes_[o].last = facets.first_of(o + 1);
        boxes_[o].made = false;
    }
    has_ways_ = false;
    clear_boxes_.clear();
    ids_.clear();
    nodes_.clear();
    known_.clear();
    for (const LeafOperand& o : facets.problem().operands) known_.push_back(o.winding);
    starts_.assign(1, {facets.reference(), -1, 0});
    vertices_.resize(as_index(facets.size()));
    first_.assign(as_index(facets.size()), -1);
    regions_.fill(-1);
    regions_of_.assign(as_index(facets.size()), -1);
    for (LeafIndex i = 0; i < facets.size(); ++i) {
        if (const int region = region_of(i); region >= 0) {
            regions_of_[as_index(i)] = static_cast<std::int8_t>(region);
            vertices_[as_index(i)].fill(-1);
            continue;
        }
        const bool free = pairs.contacts(i).empty();
        add_corners(i, free);
        const FilteredFacet& f = facets[i];
        if (free && !f.contained && f.is_whole()) add_edges(i);
    }
}

// A part of the cell beside the box of the other operand has none of its facets and is convex, so
// the winding number is the same all over it. -1: the item has no point that surely is in such a
// part of the cell.
int FilteredWindings::region_of(LeafIndex item) const {
    if (operands_ != 2 || pairs_->is_candidate(item)) return -1;
    const FilteredFacet& f = (*facets_)[item];
    const auto in_cell = [&](const Vector3& p) { return facets_->in_cell(p); };
    if (!f.contained && !(f.is_whole() && std::ranges::any_of(f.corners, in_cell))) return -1;
    return region_beside(f.operand, f.lo, f.hi);
}

int FilteredWindings::region_beside(LeafIndex operand, const Vector3& low,
                                    const Vector3& high) const {
    const auto& [lo, hi] = facets_->reach(as_index(1 - operand));
    for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        if (high[axis] < lo[axis]) return 6 * operand + 2 * k;
        if (low[axis] > hi[axis]) return 6 * operand + 2 * k + 1;
    }
    return -1;
}

// The winding numbers in a region, if they are known: the reference may lie there.
LeafIndex FilteredWindings::windings_in(int region) {
    LeafIndex& known = regions_[static_cast<std::size_t>(region)];
    if (known >= 0) return known;
    const auto axis = static_cast<std::size_t>(region % 6 / 2);
    const auto& [lo, hi] = facets_->reach(as_index(1 - region / 6));
    const Approximation& p = facets_->reference();
    const bool is_there =
        region % 2 == 0 ? p.c[axis] + p.error < lo[axis] : p.c[axis] - p.error > hi[axis];
    if (is_there) known = 0;
    return known;
}

// A fragment has a node for each corner of its facet that is left of that. At a corner on another
// operand there is no winding number; the owner of that corner has it.
void FilteredWindings::add_corners(LeafIndex item, bool free) {
    const FilteredFacet& f = (*facets_)[item];
    auto& vertices = vertices_[as_index(item)];
    vertices.fill(-1);
    for (std::size_t c = 0; c < f.size; ++c) {
        const int corner = f.mesh_corner(c);
        if (corner < 0 || (f.resting >> c & 1U) != 0) continue;
        const auto m = static_cast<std::size_t>(corner);
        if (!f.contained && !facets_->in_cell(f.corners[m])) continue;
        vertices[m] = node_of({f.vertices[m], static_cast<std::uint32_t>(f.surface)}, item,
                              static_cast<int>(c));
        if (free) join_item(item, vertices[m]);
    }
}

// Edges of a whole facet that run through the cell and have no end there.
void FilteredWindings::add_edges(LeafIndex item) {
    const FilteredFacet& f = (*facets_)[item];
    const auto& vertices = vertices_[as_index(item)];
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t d = c == 2 ? 0 : c + 1;
        if (vertices[c] >= 0 || vertices[d] >= 0 ||
            !runs_through(*facets_, f.corners[c], f.corners[d]))
            continue;
        const std::uint64_t v = std::min(f.vertices[c], f.vertices[d]);
        const std::uint64_t w = std::max(f.vertices[c], f.vertices[d]);
        join_item(item,
                  node_of({(w + 1) << 32 | v, static_cast<std::uint32_t>(f.surface)}, item, -1));
    }
}

LeafIndex FilteredWindings::node_of(const StampMap::Key& key, LeafIndex item, int corner) {
    const auto next = static_cast<LeafIndex>(nodes_.size());
    const auto [id, inserted] = ids_.insert(key, next);
    if (inserted) {
        Node& n = nodes_.emplace_back();
        n.parent = next;
        n.item = item;
        n.corner = static_cast<std::int8_t>(corner);
        const FilteredFacet& f = (*facets_)[item];
        if (corner >= 0 && operands_ == 2) {
            const auto m =
                static_cast<std::size_t>(f.mesh_corner(static_cast<std::size_t>(corner)));
            n.region =
                static_cast<std::int8_t>(region_beside(f.operand, f.corners[m], f.corners[m]));
        }
    }
    return id;
}

void FilteredWindings::join_item(LeafIndex item, LeafIndex node) {
    LeafIndex& first = first_[as_index(item)];
    if (first < 0) {
        first = node;
    } else {
        join(first, node);
    }
}

LeafIndex FilteredWindings::root(LeafIndex v) {
    while (nodes_[as_index(v)].parent != v) {
        LeafIndex& parent = nodes_[as_index(v)].parent;
        v = parent = nodes_[as_index(parent)].parent;
    }
    return v;
}

void FilteredWindings::join(LeafIndex a, LeafIndex b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    // A tree's root is a vertex if there is one.
    if (nodes_[as_index(a)].corner < 0) std::swap(a, b);
    nodes_[as_index(b)].parent = a;
    if (nodes_[as_index(b)].corner >= 0) nodes_[as_index(a)].example = b;
    // A region whose windings are known is worth more than another one.
    std::int8_t& region = nodes_[as_index(a)].region;
    const std::int8_t other = nodes_[as_index(b)].region;
    if (other >= 0 && (region < 0 || windings_in(region) < 0)) region = other;
}

// There are few different ones: inside and outside, in a leaf of two operands.
LeafIndex FilteredWindings::keep(std::span<const int> windings) {
    constexpr LeafIndex looked_at = 8;
    const auto at = static_cast<LeafIndex>(known_.size() / operands_);
    for (LeafIndex i = at - 1; i >= 0 && i >= at - looked_at; --i)
        if (std::ranges::equal(this->windings(i), windings)) return i;
    known_.insert(known_.end(), windings.begin(), windings.end());
    return at;
}

const FilteredWindings::Start& FilteredWindings::nearest_start(const Approximation& target,
                                                               LeafIndex own) const {
    constexpr std::size_t looked_at = 24;
    const auto distance = [&](const Start& s) {
        double d = 0;
        for (std::size_t k = 0; k < 3; ++k) d += std::fabs(s.at.c[k] - target.c[k]);
        return d;
    };
    const Start* nearest = &starts_[0];
    double least = distance(*nearest);
    for (std::size_t i = starts_.size(); i-- > 1 && starts_.size() - i <= looked_at;) {
        if (starts_[i].own != own) continue;
        if (const double d = distance(starts_[i]); d < least) {
            least = d;
            nearest = &starts_[i];
        }
    }
    return *nearest;
}

bool FilteredWindings::at_point(const Approximation& target, LeafIndex own, EvaluateStats& stats,
                                std::vector<int>& w) {
    check_budget(*facets_->problem().options, stats);
    ++stats.traces;
    const Start& start = nearest_start(target, own);
    const bool near = start.own >= 0;
    if (trace(start, target, own, w)) {
        stats.traces_near += near ? 1 : 0;
    } else if (!near || !trace(starts_[0], target, own, w)) {
        ++stats.traces_retried;
        return false;
    }
    starts_.push_back({target, own, keep(w)});
    return true;
}

bool FilteredWindings::trace(const Start& start, const Approximation& target, LeafIndex own,
                             std::vector<int>& w) {
    const auto known = windings(start.windings);
    w.assign(known.begin(), known.end());
    Vector3 lo;
    Vector3 hi;
    for (std::size_t k = 0; k < 3; ++k) {
        // One more unit than the errors, so that rounding does not matter.
        lo[k] = std::min(start.at.c[k] - start.at.error, target.c[k] - target.error) - 1;
        hi[k] = std::max(start.at.c[k] + start.at.error, target.c[k] + target.error) + 1;
    }
    const BoxRows::Probe probe = BoxRows::probe(lo, hi, own);
    const auto count = [&](LeafIndex first, std::size_t row, unsigned met) {
        for (; met != 0; met &= met - 1) {
            const auto i = static_cast<LeafIndex>(4 * row) + std::countr_zero(met);
            if (!add_crossing(first + i, start.at, target, lo, hi, w)) return false;
        }
        return true;
    };
    const BoxRows* const all = pairs_->all_boxes();
    if (const FacetRows* const planes = pairs_->all_planes()) {
        const FacetRows::Segment segment = planes->segment(start.at, target);
        return all->visit_meeting(0, probe, [&](std::size_t row, unsigned met) {
            return count(0, row, met & ~planes->parted(row, segment, met));
        });
    }
    const auto count_in = [&](const BoxRows& boxes, LeafIndex first, std::size_t begin,
                              std::size_t end) {
        for (std::size_t row = begin; row < end; ++row)
            if (!count(first, row, boxes.meeting(row, probe))) return false;
        return true;
    };
    if (all != nullptr && operands_ > 2) return count_in(*all, 0, 0, all->row_count());
    if (all != nullptr) {
        const OperandBoxes& other = boxes_[1 - as_index(own)];
        return count_in(*all, 0, as_index(other.first) / 4, (as_index(other.last) + 3) / 4);
    }
    for (std::size_t o = 0; o < operands_; ++o) {
        if (o == as_index(own)) continue;
        const BoxRows& boxes = boxes_of(o);
        if (!count_in(boxes, boxes_[o].first, 0, boxes.row_count())) return false;
    }
    return true;
}

namespace {

// A plane at both ends of a trace: its values, and what they are off by at most.
struct AtEnds {
    double start;
    double start_error;
    double target;
    double target_error;
};

// All points of a trace that can be in a plane which the target may be in, as the target with a
// larger error. False when that says too little.
bool near_target(const AtEnds& plane, const Approximation& start, const Approximation& target,
                 Approximation& x) {
    const double reach = std::fabs(plane.target) + plane.target_error;
    const double height = std::fabs(plane.start) - plane.start_error;
    if (!(height > 4 * reach)) return false;
    double span = 0;
    for (std::size_t k = 0; k < 3; ++k) span = std::max(span, std::fabs(start.c[k] - target.c[k]));
    // With the value v at the target and w at the start the plane is met at v / (v - w) of the way
    // from the target, |v| <= reach and |w| >= height.
    x = target;
    x.error += 1.5 * (span + start.error + target.error) * reach / height;
    return true;
}

}  // namespace

// Counts a facet of another operand if the segment goes through it; false when that is uncertain.
bool FilteredWindings::add_crossing(LeafIndex i, const Approximation& start,
                                    const Approximation& target, const Vector3& lo,
                                    const Vector3& hi, std::vector<int>& w) {
    FilteredFacet& f = (*facets_)[i];
    if (!f.meets(lo, hi)) return true;
    const FilteredPlane& plane = facets_->plane(i);
    const AtEnds at{plane.value(start.c), plane.error(start), plane.value(target.c),
                    plane.error(target)};
    if (!(std::fabs(at.start) > at.start_error)) return false;
    Approximation x;
    if (!(std::fabs(at.target) > at.target_error)) {
        // The target may be in the plane. It is not on the facet: so beside it, or undecided.
        return near_target(at, start, target, x) && is_inside(*facets_, f, x) < 0;
    }
    if ((at.start > 0) == (at.target > 0)) return true;
    const int inside =
        interpolate(start, at.start, target, at.target, at.start_error + at.target_error, x)
            ? is_inside(*facets_, f, x)
            : 0;
    if (inside == 0) return false;
    if (inside > 0) w[as_index(f.operand)] += at.start > 0 ? f.orientation : -f.orientation;
    return true;
}

const BoxRows& FilteredWindings::boxes_of(std::size_t operand) {
    OperandBoxes& boxes = boxes_[operand];
    if (boxes.made) return boxes.rows;
    boxes.made = true;
    boxes.rows.clear();
    for (LeafIndex i = boxes.first; i < boxes.last; ++i) {
        const FilteredFacet& f = (*facets_)[i];
        boxes.rows.add(f.lo, f.hi, f.operand);
    }
    return boxes.rows;
}

void FilteredWindings::find_windings(LeafIndex r, EvaluateStats& stats) {
    const int region = nodes_[as_index(r)].region;
    if (region >= 0 && windings_in(region) >= 0) {
        ++stats.linked;
        nodes_[as_index(r)].state = State::Known;
        nodes_[as_index(r)].windings = windings_in(region);
        spread(r);
        return;
    }
    nodes_[as_index(r)].state = State::Useless;
    const LeafIndex example = nodes_[as_index(r)].example;
    for (const LeafIndex at : {r, example}) {
        if (at < 0) continue;
        const Node& n = nodes_[as_index(at)];
        if (n.corner < 0) continue;  // edges only: see remember()
        const FilteredFacet& f = (*facets_)[n.item];
        facets_->make_outline(n.item);
        if (!at_point(facets_->corner(f, static_cast<std::size_t>(n.corner)), f.operand, stats,
                      traced_))
            continue;
        nodes_[as_index(r)].state = State::Known;
        nodes_[as_index(r)].windings = keep(traced_);
        if (region >= 0) regions_[static_cast<std::size_t>(region)] = nodes_[as_index(r)].windings;
        spread(r);
        return;
    }
}

void FilteredWindings::list_ways() {
    has_ways_ = true;
    found_.clear();
    for (LeafIndex i = 0; i < facets_->size(); ++i) {
        if (pairs_->contacts(i).empty() || !(*facets_)[i].is_whole()) continue;
        const auto& vertices = vertices_[as_index(i)];
        for (std::int8_t c = 0; c < 3; ++c) {
            const auto d = static_cast<std::int8_t>(c == 2 ? 0 : c + 1);
            const LeafIndex a = vertices[static_cast<std::size_t>(c)];
            const LeafIndex b = vertices[static_cast<std::size_t>(d)];
            if (a < 0 || b < 0) continue;
            const LeafIndex from = root(a);
            const LeafIndex to = root(b);
            if (from == to) continue;
            found_.push_back({from, to, i, c, c});
            found_.push_back({to, from, i, c, d});
        }
    }
    // Counting sort: `first_way_[n + 1]` runs from the start of node n's to their end.
    first_way_.assign(nodes_.size() + 2, 0);
    for (const Way& w : found_) ++first_way_[as_index(w.from) + 2];
    for (std::size_t n = 2; n < first_way_.size(); ++n) first_way_[n] += first_way_[n - 1];
    ways_.resize(found_.size());
    for (const Way& w : found_) ways_[first_way_[as_index(w.from) + 1]++] = w;
}

// From a tree that has become known to all that edges connect it with.
void FilteredWindings::spread(LeafIndex r) {
    if (!has_ways_) list_ways();
    reached_.assign(1, r);
    while (!reached_.empty()) {
        const LeafIndex from = reached_.back();
        reached_.pop_back();
        const std::size_t end = first_way_[as_index(from) + 1];
        for (std::size_t i = first_way_[as_index(from)]; i < end; ++i) {
            const Way& way = ways_[i];
            if (nodes_[as_index(way.to)].state == State::Known) continue;
            const auto known = windings(nodes_[as_index(from)].windings);
            traced_.assign(known.begin(), known.end());
            if (!follow(way, traced_)) continue;
            Node& to = nodes_[as_index(way.to)];
            to.state = State::Known;
            to.windings = keep(traced_);
            reached_.push_back(way.to);
        }
    }
}

// What changes along an edge, which lies in the cell: all that it pierces is known. False where it
// meets an edge.
bool FilteredWindings::follow(const Way& way, std::span<int> w) const {
    for (const FilteredContact& c : pairs_->contacts(way.item)) {
        const FilteredCrossing& crossing = pairs_->crossing(c.crossing);
        const bool above = (crossing.above[c.is_second ? 1 : 0] >> way.corner & 1U) != 0;
        const FilteredFacet& f = (*facets_)[c.other];
        for (const FilteredEnd& end : crossing.ends) {
            if (end.edge_of(c.is_second) != way.edge) continue;
            if (end.other_edge >= 0) return false;
            w[as_index(f.operand)] += above ? f.orientation : -f.orientation;
        }
    }
    return true;
}

FilteredWindings::ClearBox FilteredWindings::clear_box(LeafIndex item, LeafIndex windings) const {
    const FilteredFacet& f = (*facets_)[item];
    ClearBox box{f.lo, f.hi, windings};
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = std::max(box.lo[k], facets_->inner_lo()[k]);
        box.hi[k] = std::min(box.hi[k], facets_->inner_hi()[k]);
    }
    return box;
}

// Within a box without facets of the other operand its winding number is the same everywhere, and
// so it is in two that meet in the cell. Fragments mostly have no corner in common by name.
LeafIndex FilteredWindings::from_clear_boxes(LeafIndex item, EvaluateStats& stats) {
    if (!is_clear(item)) return -1;
    ClearBox box = clear_box(item, -1);
    for (std::size_t i = clear_boxes_.size(); i-- > 0;) {
        const ClearBox& b = clear_boxes_[i];
        bool meet = true;
        for (std::size_t k = 0; k < 3 && meet; ++k)
            meet = std::max(b.lo[k], box.lo[k]) <= std::min(b.hi[k], box.hi[k]);
        if (!meet) continue;
        ++stats.linked;
        box.windings = b.windings;
        clear_boxes_.push_back(box);
        return box.windings;
    }
    return -1;
}

LeafIndex FilteredWindings::remember(LeafIndex item, std::span<const int> windings) {
    const LeafIndex kept = keep(windings);
    if (const int region = regions_of_[as_index(item)]; region >= 0)
        regions_[static_cast<std::size_t>(region)] = kept;
    if (is_clear(item)) clear_boxes_.push_back(clear_box(item, kept));
    const LeafIndex first = first_[as_index(item)];
    if (first < 0) return kept;
    Node& r = nodes_[as_index(root(first))];
    r.windings = kept;
    r.state = State::Known;
    return kept;
}

FilteredWindings::Anchor FilteredWindings::anchor_of(LeafIndex item, EvaluateStats& stats) {
    if (const int region = regions_of_[as_index(item)]; region >= 0) {
        const LeafIndex known = windings_in(region);
        if (known >= 0) ++stats.linked;
        return {known, 0};
    }
    if (const LeafIndex first = first_[as_index(item)]; first >= 0) {
        // All its vertices hang together; which one it is does not matter.
        const LeafIndex r = root(first);
        if (nodes_[as_index(r)].state == State::Unknown) find_windings(r, stats);
        return {nodes_[as_index(r)].windings, 0};
    }
    const FilteredFacet& f = (*facets_)[item];
    if (f.contained) {
        if (const LeafIndex known = from_clear_boxes(item, stats); known >= 0) return {known, 0};
    }
    const auto& vertices = vertices_[as_index(item)];
    // First a vertex of which the windings are known.
    for (const bool ask : {false, true}) {
        for (std::size_t c = 0; c < f.size; ++c) {
            const int corner = f.mesh_corner(c);
            if (corner < 0 || vertices[static_cast<std::size_t>(corner)] < 0) continue;
            const LeafIndex r = root(vertices[static_cast<std::size_t>(corner)]);
            if (ask && nodes_[as_index(r)].state == State::Unknown) find_windings(r, stats);
            const Node& n = nodes_[as_index(r)];
            if (n.state == State::Known) return {n.windings, static_cast<int>(c)};
        }
    }
    return {};
}

}  // namespace trisect::detail
