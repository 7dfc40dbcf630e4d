// SPDX-License-Identifier: Apache-2.0
//
// A front that is tested anew from end to end for each pose saves little: three quarters of all
// pairs of a walk are its front. So each pair of the front knows how far apart it was, and an
// odometer adds up bounds on how far any point has moved between poses. While it has moved by less
// than the gap the pair is still apart, whatever else happened. The front is a heap; a question
// looks at the pairs that have expired, which are the few where the bodies are close. (A pair's
// lower bound on distance against a bound on velocity is Mirtich's schedule, 1996, for pairs of
// bodies; here it is kept for pairs of boxes.)
//
// Pairs are divided further when they close in and never put together again; when the front has
// doubled a fresh walk makes a new one.
//
// Where boundaries cross, the pair of triangles that showed it is tried first, then what is below
// the boxes some levels above it.

#include <trisect/bsp/detail/coherent_walk.h>

#include <algorithm>
#include <limits>

#include <trisect/bsp/detail/triangle_distance.h>
#include <trisect/bsp/detail/triangle_filter.h>

namespace trisect::detail {

namespace {

struct LaterFirst {
    template <class Entry>
    bool operator()(const Entry& a, const Entry& b) const {
        return a.expiry > b.expiry;
    }
};

float size(const ObbTree& t, ObbId id) {
    const ObbNode& n = t.nodes[id.node()];
    return n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()];
}

ObbId above(const ObbTree& t, ObbId id, int levels) {
    for (; levels > 0; --levels) id = ObbId{t.parent[id.node()]};
    return id;
}

}  // namespace

bool CoherentWalk::opens_b(const Entry& e) const {
    const ObbChild ca = a_->boxes.child(e.a);
    const ObbChild cb = b_->boxes.child(e.b);
    return ca.is_leaf() ||
           (!cb.is_leaf() && pose_->scale() * size(b_->boxes, e.b) > size(a_->boxes, e.a));
}

void CoherentWalk::keep(const Entry& e) {
    front_.push_back(e);
    std::push_heap(front_.begin(), front_.end(), LaterFirst{});
}

// Tests the pair, keeps it with its new expiry and opens lanes that may meet. The same side is
// opened each time, also when a pose has changed the size of a body. True when a crossing was
// found.
bool CoherentWalk::visit(Entry e) {
    const ObbChild ca = a_->boxes.child(e.a);
    const ObbChild cb = b_->boxes.child(e.b);
    if (ca.is_leaf() && cb.is_leaf()) return visit_leaves(e);
    if (!e.open_b) e.open_b = opens_b(e);
    const bool open_b = *e.open_b;
    const ObbNode& node = open_b ? b_->boxes.nodes[cb.node()] : a_->boxes.nodes[ca.node()];
    ++counters_.node_tests;
    const Float4 gaps = open_b ? pose_->all_gaps(a_->boxes.box(e.a), node)
                               : pose_->all_gaps(node, b_->boxes.box(e.b));
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t k = 0; k < 4; ++k) {
        if ((e.done >> k & 1U) != 0 || !(node.half[0][k] >= 0)) continue;
        if (gaps[k] > 0) {
            least = std::min(least, gaps[k]);
            continue;
        }
        e.done = static_cast<std::uint8_t>(e.done | 1U << k);
        open_.push_back(open_b ? ObbWalk::Pair{e.a, ObbId::of(cb.node(), k)}
                               : ObbWalk::Pair{ObbId::of(ca.node(), k), e.b});
    }
    if (least < std::numeric_limits<float>::infinity()) {
        e.expiry = odometer_ + static_cast<double>(least);
        keep(e);
    }
    return false;
}

// Whether two triangles, by their places in the trees, tell the relation where they cross.
bool CoherentWalk::are_clear(std::uint32_t i, std::uint32_t j) const {
    return a_->is_clear(a_->boxes.order[i]) && b_->is_clear(b_->boxes.order[j]);
}

bool CoherentWalk::visit_leaves(Entry e) {
    const ObbChild ca = a_->boxes.child(e.a);
    const ObbChild cb = b_->boxes.child(e.b);
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t j = 0; j < cb.count(); ++j) {
        TriangleCorners q;
        for (std::size_t k = 0; k < 3; ++k)
            q[k] = map_(b_->positions[b_->boxes.corners[cb.first() + j][k]]);
        for (std::uint32_t i = 0; i < ca.count(); ++i) {
            TriangleCorners p;
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = a_->positions[a_->boxes.corners[ca.first() + i][k]];
            ++counters_.triangle_pairs;
            const PairVerdict verdict = compare_triangles(p, q, error_);
            if (verdict == PairVerdict::Crossing && are_clear(ca.first() + i, cb.first() + j)) {
                ++counters_.crossing;
                witness_ = Witness{e.a, e.b};
                return true;
            }
            if (verdict != PairVerdict::Apart) {
                ++counters_.unknown;
                ++unknown_;
                least = 0;
                continue;
            }
            ++counters_.apart;
            // About corner 0 of p, or the slack would be that of the lattice's origin.
            const auto origin = p[0];
            for (auto* t : {&p, &q})
                for (auto& c : *t)
                    for (std::size_t k = 0; k < 3; ++k) c[k] -= origin[k];
            // The differences are rounded once, by less than 2^-53 of the coordinates below.
            double largest = 0;
            for (const auto* t : {&p, &q})
                for (const auto& c : *t)
                    for (const double v : c) largest = std::max(largest, v < 0 ? -v : v);
            const double error = error_ + 0x1p-52 * largest;
            const DistanceBounds d = certify(p, q, closest_points(p, q), error);
            least = std::min(least, d.lower / a_->boxes.unit);
        }
    }
    e.expiry = odometer_ + least;
    keep(e);
    return false;
}

bool CoherentWalk::cross_below(ObbId a, ObbId b, std::uint64_t budget) {
    std::vector<ObbWalk::Pair> stack{{a, b}};
    const std::uint64_t end = counters_.node_tests + budget;
    while (!stack.empty() && counters_.node_tests < end) {
        const ObbWalk::Pair p = stack.back();
        stack.pop_back();
        const ObbChild ca = a_->boxes.child(p.a);
        const ObbChild cb = b_->boxes.child(p.b);
        if (ca.is_leaf() && cb.is_leaf()) {
            for (std::uint32_t j = 0; j < cb.count(); ++j)
                for (std::uint32_t i = 0; i < ca.count(); ++i) {
                    TriangleCorners tp;
                    TriangleCorners tq;
                    for (std::size_t k = 0; k < 3; ++k) {
                        tp[k] = a_->positions[a_->boxes.corners[ca.first() + i][k]];
                        tq[k] = map_(b_->positions[b_->boxes.corners[cb.first() + j][k]]);
                    }
                    ++counters_.triangle_pairs;
                    if (compare_triangles(tp, tq, error_) != PairVerdict::Crossing ||
                        !are_clear(ca.first() + i, cb.first() + j))
                        continue;
                    ++counters_.crossing;
                    witness_ = Witness{p.a, p.b};
                    return true;
                }
            continue;
        }
        const bool open_b = opens_b({0, p.a, p.b});
        const ObbNode& node = open_b ? b_->boxes.nodes[cb.node()] : a_->boxes.nodes[ca.node()];
        ++counters_.node_tests;
        const unsigned hits = open_b ? pose_->overlaps(a_->boxes.box(p.a), node)
                                     : pose_->overlaps(node, b_->boxes.box(p.b));
        for (std::uint32_t k = 0; k < 4; ++k)
            if ((hits >> k & 1U) != 0)
                stack.push_back(open_b ? ObbWalk::Pair{p.a, ObbId::of(cb.node(), k)}
                                       : ObbWalk::Pair{ObbId::of(ca.node(), k), p.b});
    }
    return false;
}

bool CoherentWalk::crosses_near_witness() {
    const Witness w = *witness_;
    if (cross_below(w.a, w.b, 1)) return true;
    for (const int levels : {1, 2, 4})
        if (cross_below(above(a_->boxes, w.a, levels), above(b_->boxes, w.b, levels), 24))
            return true;
    witness_.reset();
    return false;
}

CoherentWalk::Answer CoherentWalk::walk_fresh() {
    ++fresh_;
    front_.clear();
    has_front_ = false;
    odometer_ = 0;
    unknown_ = 0;
    if (!pose_->is_apart()) {
        open_.assign(1, ObbWalk::Pair{});
        while (!open_.empty()) {
            const ObbWalk::Pair p = open_.back();
            open_.pop_back();
            if (visit({0, p.a, p.b})) return Answer::Crossing;
        }
        has_front_ = true;
        fresh_size_ = front_.size();
    }
    return answer();
}

CoherentWalk::Answer CoherentWalk::renew_front() {
    unknown_ = 0;
    odometer_ += pose_->displacement_from(*last_);
    unmoved_ = true;
    std::vector<Entry> expired;
    while (!front_.empty() && !(front_.front().expiry > odometer_)) {
        std::pop_heap(front_.begin(), front_.end(), LaterFirst{});
        expired.push_back(front_.back());
        front_.pop_back();
    }
    unmoved_ = expired.empty();
    // What expires next to nothing would only be tested twice.
    if (expired.size() > fresh_size_ / 2 + 8 || front_.size() > 2 * fresh_size_ + 64)
        return walk_fresh();
    open_.clear();
    for (const Entry& e : expired)
        if (visit(e)) {
            has_front_ = false;
            return Answer::Crossing;
        }
    while (!open_.empty()) {
        const ObbWalk::Pair p = open_.back();
        open_.pop_back();
        if (visit({0, p.a, p.b})) {
            has_front_ = false;
            return Answer::Crossing;
        }
    }
    return answer();
}

CoherentWalk::Answer CoherentWalk::ask(const ApproximateMap& b_to_a) {
    last_ = pose_;
    map_ = b_to_a;
    pose_.emplace(a_->boxes, b_->boxes, b_to_a);
    error_ = a_->position_error + b_to_a.error_below(b_->largest, b_->position_error);
    unmoved_ = false;
    if (witness_) {
        if (crosses_near_witness()) return Answer::Crossing;
        return walk_fresh();
    }
    return has_front_ ? renew_front() : walk_fresh();
}

void CoherentWalk::forget() {
    witness_.reset();
    front_.clear();
    has_front_ = false;
    pose_.reset();
}

}  // namespace trisect::detail
