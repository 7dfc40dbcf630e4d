// SPDX-License-Identifier: Apache-2.0
//
// A front that is tested anew from end to end for each pose saves little: three quarters of all
// pairs of a walk are its front. So each pair of the front knows how far apart it was, and an
// odometer adds up bounds on how far any point has moved between poses. While it has moved by less
// than the gap the pair is still apart, whatever else happened. A question looks at the pairs that
// are due, which are the few where the bodies are close. (A pair's lower bound on distance against
// a bound on velocity is Mirtich's schedule, 1996, for pairs of bodies; here it is kept for pairs
// of boxes.)
//
// The front is the leaves of the tree of all pairs that a walk opens, and the whole tree is kept.
// Where a pair closes in it is divided further. Where everything below a pair is far apart by now,
// the pair itself is asked again, and when its boxes are apart what is below is forgotten. So the
// front is as coarse as the distances allow, and bodies that have parted cost a test now and then.
//
// Where boundaries cross, the pair of triangles that showed it is tried first. When it is lost the
// search climbs from it: at each pair on the way from the roots to it the other lanes are searched,
// the nearest first. At the root this has been a whole walk, no pair twice, so nothing is lost when
// there is no crossing any more. A front from before the crossing is kept; while at most half of it
// is due it is cheaper to go on from it.

#include <trisect/bsp/detail/coherent_walk.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <trisect/bsp/detail/inside_balls.h>
#include <trisect/bsp/detail/triangle_distance.h>
#include <trisect/bsp/detail/triangle_filter.h>

namespace trisect::detail {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

float size(const ObbTree& t, ObbId id) {
    const ObbNode& n = t.nodes[id.node()];
    return n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()];
}

// From the box below the root down to the box itself; of the root nothing.
std::vector<ObbId> boxes_down_to(const ObbTree& t, ObbId id) {
    std::vector<ObbId> way;
    for (; id.index != 0; id = ObbId{t.parent[id.node()]}) way.push_back(id);
    std::reverse(way.begin(), way.end());
    return way;
}

// About corner 0 of p, or the slack would be that of the lattice's origin.
double certain_distance(TriangleCorners p, TriangleCorners q, double error) {
    const auto origin = p[0];
    double largest = 0;
    for (auto* t : {&p, &q})
        for (auto& c : *t)
            for (std::size_t k = 0; k < 3; ++k) {
                c[k] -= origin[k];
                largest = std::max(largest, std::abs(c[k]));
            }
    // The differences are rounded once, by at most 2^-53 of the coordinates now.
    return certify(p, q, closest_points(p, q), error + 0x1p-52 * largest).lower;
}

}  // namespace

CoherentWalk::Opens CoherentWalk::opens(ObbId a, ObbId b) const {
    const bool leaf_a = a_->boxes.child(a).is_leaf();
    const bool leaf_b = b_->boxes.child(b).is_leaf();
    if (leaf_a && leaf_b) return Opens::Neither;
    return leaf_a || (!leaf_b && pose_->scale() * size(b_->boxes, b) > size(a_->boxes, a))
               ? Opens::B
               : Opens::A;
}

// Two triangles by their places in the trees. Crossing ones that are not clear tell nothing.
PairVerdict CoherentWalk::compare(std::uint32_t i, std::uint32_t j, TriangleCorners& p,
                                  TriangleCorners& q) {
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = a_->positions[a_->boxes.corners[i][k]];
        q[k] = map_(b_->positions[b_->boxes.corners[j][k]]);
    }
    ++counters_.triangle_pairs;
    PairVerdict verdict = compare_triangles(p, q, error_);
    if (verdict == PairVerdict::Crossing &&
        !(a_->is_clear(a_->boxes.order[i]) && b_->is_clear(b_->boxes.order[j])))
        verdict = PairVerdict::Unknown;
    switch (verdict) {
        case PairVerdict::Apart:
            ++counters_.apart;
            break;
        case PairVerdict::Crossing:
            ++counters_.crossing;
            break;
        case PairVerdict::Unknown:
            ++counters_.unknown;
            ++unknown_;
            break;
    }
    return verdict;
}

// Crossing pairs -----------------------------------------------------------------------------

bool CoherentWalk::leaves_cross(ObbId a, ObbId b) {
    const ObbChild ca = a_->boxes.child(a);
    const ObbChild cb = b_->boxes.child(b);
    TriangleCorners p;
    TriangleCorners q;
    for (std::uint32_t j = 0; j < cb.count(); ++j)
        for (std::uint32_t i = 0; i < ca.count(); ++i)
            if (compare(ca.first() + i, cb.first() + j, p, q) == PairVerdict::Crossing) {
                witness_ = {a, b};
                return true;
            }
    return false;
}

// Pairs below that may meet, for the search; without one that has been searched.
void CoherentWalk::push_lanes(const ObbWalk::Pair& p, Opens side, ObbWalk::Pair searched) {
    const ObbTree& ta = a_->boxes;
    const ObbTree& tb = b_->boxes;
    const std::uint32_t node = side == Opens::B ? tb.child(p.b).node() : ta.child(p.a).node();
    ++counters_.node_tests;
    const unsigned hits = side == Opens::B ? pose_->overlaps(ta.box(p.a), tb.nodes[node])
                                           : pose_->overlaps(ta.nodes[node], tb.box(p.b));
    for (std::uint32_t k = 0; k < 4; ++k) {
        if ((hits >> k & 1U) == 0) continue;
        const ObbId lane = ObbId::of(node, k);
        const ObbWalk::Pair below =
            side == Opens::B ? ObbWalk::Pair{p.a, lane} : ObbWalk::Pair{lane, p.b};
        if (below.a.index == searched.a.index && below.b.index == searched.b.index) continue;
        stack_.push_back(below);
    }
}

bool CoherentWalk::cross_below_stack() {
    while (!stack_.empty()) {
        const ObbWalk::Pair p = stack_.back();
        stack_.pop_back();
        const Opens side = opens(p.a, p.b);
        if (side != Opens::Neither)
            push_lanes(p, side, ObbWalk::Pair{});
        else if (leaves_cross(p.a, p.b))
            return true;
    }
    return false;
}

// The pairs that a walk opens from the roots to a pair of leaves, without that.
std::vector<ObbWalk::Pair> CoherentWalk::way_to(ObbId a, ObbId b) const {
    const std::vector<ObbId> below_a = boxes_down_to(a_->boxes, a);
    const std::vector<ObbId> below_b = boxes_down_to(b_->boxes, b);
    std::vector<ObbWalk::Pair> way;
    ObbWalk::Pair at;
    for (std::size_t i = 0, j = 0; i < below_a.size() || j < below_b.size();) {
        way.push_back(at);
        if (opens(at.a, at.b) == Opens::B)
            at.b = below_b[j++];
        else
            at.a = below_a[i++];
    }
    return way;
}

// The witness itself has been compared.
CoherentWalk::Answer CoherentWalk::search_from_witness() {
    constexpr std::uint64_t patience = 16;
    ObbWalk::Pair searched = *witness_;
    const std::vector<ObbWalk::Pair> way = way_to(searched.a, searched.b);
    const std::uint64_t before = counters_.node_tests;
    bool may_resume = front_pose_.has_value();
    stack_.clear();
    for (std::size_t k = way.size(); k-- > 0;) {
        push_lanes(way[k], opens(way[k].a, way[k].b), searched);
        if (cross_below_stack()) return Answer::Crossing;
        searched = way[k];
        if (may_resume && counters_.node_tests - before > patience) {
            const double now = odometer_ + pose_->displacement_from(*front_pose_);
            if (2 * due_.count_due(now) <= visits_.size() - unused_.size()) {
                ++resumed_;
                witness_.reset();
                return renew_front();
            }
            may_resume = false;
        }
    }
    ++fresh_;
    witness_.reset();
    front_pose_.reset();
    return answer();
}

// The front ----------------------------------------------------------------------------------

std::uint32_t CoherentWalk::add_visit(ObbId a, ObbId b, std::uint32_t parent, double slack) {
    std::uint32_t v = static_cast<std::uint32_t>(visits_.size());
    if (unused_.empty()) {
        visits_.emplace_back();
    } else {
        v = unused_.back();
        unused_.pop_back();
        visits_[v] = Visit{};
    }
    visits_[v].a = a;
    visits_[v].b = b;
    visits_[v].parent = parent;
    visits_[v].slack = slack;
    visits_[v].opens = opens(a, b);
    open_.push_back(v);
    return v;
}

// Numbers of visits that are no more may stay in lists; they are known by their reading.
void CoherentWalk::remove(std::uint32_t v) {
    for (std::size_t k = 0; k < 4; ++k)
        if ((visits_[v].open >> k & 1U) != 0) remove(visits_[v].below[k]);
    visits_[v].due = std::numeric_limits<double>::quiet_NaN();
    unused_.push_back(v);
}

// Everything of the visit that has none below it is apart by the gap.
void CoherentWalk::keep(std::uint32_t v, double gap) {
    Visit& e = visits_[v];
    if (!(e.slack + gap > step_)) unmoved_ = false;
    e.due = (odometer_ + gap) * (1 - 0x1p-52);
    if (gap < infinity) due_.push({e.due, v}, odometer_);
}

// True when a crossing was found.
bool CoherentWalk::visit(std::uint32_t v) {
    if (visits_[v].opens == Opens::Neither) return visit_leaves(v);
    visit_lanes(v);
    return false;
}

void CoherentWalk::visit_lanes(std::uint32_t v) {
    // The same side is opened each time, also when a pose has changed the size of a body.
    const Visit e = visits_[v];
    const ObbTree& ta = a_->boxes;
    const ObbTree& tb = b_->boxes;
    const bool open_b = e.opens == Opens::B;
    const std::uint32_t number = open_b ? tb.child(e.b).node() : ta.child(e.a).node();
    const ObbNode& node = open_b ? tb.nodes[number] : ta.nodes[number];
    ++counters_.node_tests;
    const Float4 gaps = open_b ? pose_->gaps(ta.box(e.a), node) : pose_->gaps(node, tb.box(e.b));
    const auto few_steps = static_cast<float>(2 * step_);
    std::uint8_t open = e.open;
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (!(node.half[0][k] >= 0)) continue;
        const auto bit = static_cast<std::uint8_t>(1U << k);
        if ((open & bit) != 0) {
            if (!(gaps[k] > few_steps)) continue;
            remove(e.below[k]);
            open = static_cast<std::uint8_t>(open & ~bit);
        }
        if (gaps[k] > 0) {
            least = std::min(least, gaps[k]);
            continue;
        }
        open = static_cast<std::uint8_t>(open | bit);
        const ObbId lane = ObbId::of(number, k);
        const std::uint32_t below =
            open_b ? add_visit(e.a, lane, v, e.slack) : add_visit(lane, e.b, v, e.slack);
        visits_[v].below[k] = below;
    }
    visits_[v].open = open;
    keep(v, static_cast<double>(least));
    if (open == 0 && e.parent != none && step_ > 0 && least > 2 * few_steps &&
        least > 1.5F * e.tried) {
        visits_[v].tried = least;
        begin(e.parent);
    }
}

bool CoherentWalk::visit_leaves(std::uint32_t v) {
    const ObbChild ca = a_->boxes.child(visits_[v].a);
    const ObbChild cb = b_->boxes.child(visits_[v].b);
    double least = infinity;
    TriangleCorners p;
    TriangleCorners q;
    for (std::uint32_t j = 0; j < cb.count(); ++j)
        for (std::uint32_t i = 0; i < ca.count(); ++i) {
            switch (compare(ca.first() + i, cb.first() + j, p, q)) {
                case PairVerdict::Crossing:
                    witness_ = {visits_[v].a, visits_[v].b};
                    return true;
                case PairVerdict::Unknown:
                    least = 0;
                    break;
                case PairVerdict::Apart:
                    least = std::min(least, certain_distance(p, q, error_) / a_->boxes.unit);
                    break;
            }
        }
    keep(v, least);
    return false;
}

// Puts a visit on the list of those to be made.
void CoherentWalk::begin(std::uint32_t v) {
    visits_[v].slack = visits_[v].due - (odometer_ - step_);
    open_.push_back(v);
}

// Makes the visits on the list and those that they open. Stops at a crossing; what is left is due.
CoherentWalk::Answer CoherentWalk::visit_open() {
    while (!open_.empty()) {
        const std::uint32_t v = open_.back();
        open_.pop_back();
        if (std::isnan(visits_[v].due)) continue;
        if (!visit(v)) continue;
        open_.push_back(v);
        for (const std::uint32_t w : open_) {
            if (std::isnan(visits_[w].due)) continue;
            visits_[w].due = odometer_;
            due_.push({odometer_, w}, odometer_);
        }
        open_.clear();
        return Answer::Crossing;
    }
    return answer();
}

CoherentWalk::Answer CoherentWalk::make_front() {
    ++fresh_;
    visits_.clear();
    unused_.clear();
    open_.clear();
    odometer_ = 0;
    step_ = 0;
    unknown_ = 0;
    unmoved_ = false;
    due_.reset(0x1p-16);
    front_pose_ = pose_;
    add_visit(ObbId{}, ObbId{}, none, 0);
    const Answer found = visit_open();
    fresh_size_ = visits_.size();
    return found;
}

CoherentWalk::Answer CoherentWalk::renew_front() {
    unknown_ = 0;
    step_ = pose_->displacement_from(*front_pose_);
    odometer_ = (odometer_ + step_) * (1 + 0x1p-52);
    front_pose_ = pose_;
    unmoved_ = last_from_front_;
    due_.take(odometer_, [this](const DueList::Item& item) {
        if (visits_[item.name].due == item.due) begin(item.name);
    });
    const std::size_t live = visits_.size() - unused_.size();
    if (8 * open_.size() > 7 * live + 64) return make_front();
    return visit_open();
}

CoherentWalk::Answer CoherentWalk::ask(const ApproximateMap& b_to_a) {
    map_ = b_to_a;
    error_ = a_->position_error + b_to_a.error_below(b_->largest, b_->position_error);
    unknown_ = 0;
    const bool continues = last_from_front_;
    last_from_front_ = false;
    unmoved_ = false;
    if (witness_ && leaves_cross(witness_->a, witness_->b)) return Answer::Crossing;
    // Where a crossing was there may be depth.
    if (witness_) {
        const InsideBalls* balls_a = a_->balls_in_time();
        const InsideBalls* balls_b = b_->balls_in_time();
        if (balls_a != nullptr && balls_b != nullptr &&
            relation_by_balls(*a_, *balls_a, *b_, *balls_b, b_to_a) == Relation::Overlapping) {
            ++counters_.by_balls;
            return Answer::Crossing;
        }
    }
    pose_.emplace(a_->boxes, b_->boxes, b_to_a);
    if (witness_) return search_from_witness();
    if (pose_->is_apart()) return Answer::Apart;
    if (!front_pose_) {
        const Answer found = make_front();
        last_from_front_ = found != Answer::Crossing;
        return found;
    }
    last_from_front_ = continues;
    const Answer found = renew_front();
    last_from_front_ = found != Answer::Crossing;
    return found;
}

void CoherentWalk::forget() {
    witness_.reset();
    front_pose_.reset();
    last_from_front_ = false;
}

}  // namespace trisect::detail
