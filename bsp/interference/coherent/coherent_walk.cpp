// SPDX-License-Identifier: Apache-2.0
//
// A front that is tested anew from end to end for each pose saves little: three quarters of all
// pairs of a walk are its front. So each pair of the front stores its gap, and an odometer adds up
// bounds on how far any point has moved between poses. While it has moved by less than the gap the
// pair is still apart, whatever else happened. A question looks at the pairs that are due, which
// are the few where the bodies are close. (A pair's lower bound on distance against a bound on
// velocity is Mirtich's schedule, 1996, for pairs of bodies; here it is kept for pairs of boxes.)
//
// What is due is tested first with the planes: do they still separate the boxes that they separated
// when they were last tested in full: one direction for each lane instead of sixteen (a witness
// kept between frames, as Baraff 1990 does for convex polyhedra). Where the centre of a box is
// along such a direction is linear in the pose, and no box is loaded for it; how much the rest of
// the box may add follows from how far B has turned (separating_planes.h). Most of what is due is
// done by that, in a sixth of the time of a box. It is also sharper than the odometer, which treats
// the body as a whole: a plane feels the motion of its own box, along its own normal.
//
// The front is the leaves of the tree of all pairs that a walk opens, and the whole tree is kept.
// Where a pair closes in it is divided further. Where everything below a pair is far apart by now,
// the pair itself is tested again, and when its boxes are apart what is below is forgotten. So the
// front is as coarse as the distances allow, and bodies that have parted cost a test now and then.
//
// Where boundaries cross, balls inside both solids are tried first, then the pair of triangles that
// showed the crossing. Balls give a reserve: until something has moved by as much as they reach
// into each other no test is needed at all (motion_bound.h), and the same holds for the least gap
// of a front. A crossing pair of a fine mesh is lost with every step; so balls are tried that touch
// the boundaries from inside near where it was found. Models keep one for each region; the deepest
// pair of some next to each other is taken, and again when the last one has parted.
//
// When nothing of this helps the search climbs from the lost pair: at each pair on the way from the
// roots to it the other lanes are searched, the nearest first. At the root this has been a whole
// walk, no pair twice, so nothing is lost when there is no crossing any more. A front from before
// the crossing is kept, and unless nearly all of it is due it is cheaper to go on from it.

#include <trisect/bsp/interference/coherent/coherent_walk.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <trisect/bsp/interference/boxes/triangle_distance.h>
#include <trisect/bsp/interference/boxes/triangle_filter.h>
#include <trisect/bsp/interference/relation/crossings_tell.h>
#include <trisect/bsp/interference/relation/inside_balls.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/infinity.h>

namespace trisect::detail {

namespace {

constexpr float infinite_float = std::numeric_limits<float>::infinity();
// A step of this part of the larger body's radius is a leap.
constexpr double leap = 0.125;

float size(const ObbTree& t, ObbId id) {
    const ObbNode& n = t.nodes[id.node()];
    return n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()];
}

// From the box itself up to that below the root; of the root nothing.
void find_boxes_up_from(const ObbTree& t, ObbId id, std::vector<ObbId>& way) {
    way.clear();
    for (; id.index != 0; id = ObbId{t.parent[id.node()]}) way.push_back(id);
}

}  // namespace

CoherentWalk::Opens CoherentWalk::opens(ObbId a, ObbId b) const {
    const bool leaf_a = a_->boxes.is_leaf(a);
    const bool leaf_b = b_->boxes.is_leaf(b);
    if (leaf_a && leaf_b) return Opens::Neither;
    return leaf_a || (!leaf_b && pose_->scale() * size(b_->boxes, b) > size(a_->boxes, a))
               ? Opens::B
               : Opens::A;
}

// Two triangles by their places in the trees, in A.
void CoherentWalk::move_corners(std::uint32_t i, std::uint32_t j, TriangleCorners& p,
                                TriangleCorners& q) const {
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = a_->positions[a_->boxes.corners[i][k]];
        q[k] = map_(b_->positions[b_->boxes.corners[j][k]]);
    }
}

// Crossing ones beside which there may be something else decide nothing.
PairVerdict CoherentWalk::compare(std::uint32_t i, std::uint32_t j, TriangleCorners& p,
                                  TriangleCorners& q) {
    move_corners(i, j, p, q);
    ++counters_.triangle_pairs;
    PairVerdict verdict = compare_triangles(p, q, error_);
    if (verdict == PairVerdict::Crossing &&
        !crossing_tells(*a_, a_->boxes.order[i], *b_, b_->boxes.order[j], map_))
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

// Pairs below that may meet, for the search; without one that has been searched. Which of them
// cannot be predicted, so all four are written, one over the other where they are apart.
void CoherentWalk::push_lanes(const ObbWalk::Pair& p, Opens side, ObbWalk::Pair searched) {
    const ObbTree& ta = a_->boxes;
    const ObbTree& tb = b_->boxes;
    const std::uint32_t node = side == Opens::B ? tb.child(p.b).node() : ta.child(p.a).node();
    ++counters_.node_tests;
    const unsigned hits = side == Opens::B ? pose_->overlaps(ta.box(p.a), tb.nodes[node])
                                           : pose_->overlaps(ta.nodes[node], tb.box(p.b));
    std::size_t end = stack_.size();
    stack_.resize(end + 4);
    for (std::uint32_t k = 0; k < 4; ++k) {
        const ObbId lane = ObbId::of(node, k);
        const ObbWalk::Pair below =
            side == Opens::B ? ObbWalk::Pair{p.a, lane} : ObbWalk::Pair{lane, p.b};
        const bool known =
            (below.a.index == searched.a.index) & (below.b.index == searched.b.index);
        stack_[end] = below;
        end += (hits >> k & 1U) & (known ? 0U : 1U);
    }
    stack_.resize(end);
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
void CoherentWalk::find_way_to(ObbWalk::Pair leaves) {
    find_boxes_up_from(a_->boxes, leaves.a, up_in_a_);
    find_boxes_up_from(b_->boxes, leaves.b, up_in_b_);
    way_.clear();
    ObbWalk::Pair at;
    for (std::size_t i = up_in_a_.size(), j = up_in_b_.size(); i > 0 || j > 0;) {
        way_.push_back(at);
        if (opens(at.a, at.b) == Opens::B)
            at.b = up_in_b_[--j];
        else
            at.a = up_in_a_[--i];
    }
}

// The witness itself has been compared.
CoherentWalk::Answer CoherentWalk::search_from_witness() {
    constexpr std::uint64_t patience = 16;
    ObbWalk::Pair searched = *witness_;
    find_way_to(searched);
    const std::uint64_t before = counters_.node_tests;
    bool may_resume = front_pose_.has_value();
    stack_.clear();
    for (std::size_t k = way_.size(); k-- > 0;) {
        push_lanes(way_[k], opens(way_[k].a, way_[k].b), searched);
        if (cross_below_stack()) return Answer::Crossing;
        searched = way_[k];
        if (may_resume && counters_.node_tests - before > patience) {
            const double now = odometer_ + pose_->displacement_from(*front_pose_);
            if (8 * due_.count_due(now) <= 7 * (visits_.size() - unused_.size())) {
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

// After a leap, and at first. A front would take several times as long to make, and is worth it if
// the next question is about a place nearby. One from before a leap does not help: what was open
// keeps its visits until it is apart by twice the step, so those of the old place would stay.
bool CoherentWalk::is_elsewhere() const {
    if (!last_pose_) return true;
    const double larger =
        std::max(a_->boxes.radius, static_cast<double>(pose_->scale()) * b_->boxes.radius);
    return pose_->displacement_from(*last_pose_) > leap * larger;
}

// Keeps no front.
CoherentWalk::Answer CoherentWalk::place() {
    ++fresh_;
    front_pose_.reset();
    stack_.clear();
    stack_.push_back(ObbWalk::Pair{});
    return cross_below_stack() ? Answer::Crossing : answer();
}

// The front ----------------------------------------------------------------------------------

std::uint32_t CoherentWalk::add_visit(ObbId a, ObbId b, std::uint32_t parent, double slack) {
    std::uint32_t v = static_cast<std::uint32_t>(visits_.size());
    if (unused_.empty()) {
        visits_.emplace_back();
        planes_.emplace_back();
    } else {
        v = unused_.back();
        unused_.pop_back();
        visits_[v] = Visit{};
        planes_[v] = SeparatingPlanes{};
    }
    visits_[v].a = a;
    visits_[v].b = b;
    visits_[v].parent = parent;
    visits_[v].slack = slack;
    visits_[v].opens = opens(a, b);
    open_.push_back(v);
    return v;
}

// Numbers of visits that are no more may stay on the list of those to be made.
void CoherentWalk::remove(std::uint32_t v) {
    for (std::size_t k = 0; k < 4; ++k)
        if ((visits_[v].open >> k & 1U) != 0) remove(visits_[v].below[k]);
    visits_[v].in_use = false;
    due_.drop(v);
    unused_.push_back(v);
}

// Everything of the visit that has none below it is apart by the gap, and stays so until then.
void CoherentWalk::keep_apart(std::uint32_t v, double gap) {
    due_.set(v, (odometer_ + gap) * (1 - 0x1p-52));
}

// The same, when it was not apart by the same planes before. It was apart, by the slack.
void CoherentWalk::keep(std::uint32_t v, double gap) {
    if (!(visits_[v].slack + gap > step_)) unmoved_ = false;
    keep_apart(v, gap);
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
    SeparatingPlanes& planes = planes_[v];
    Float4 gaps{};
    if (open_b) {
        gaps = pose_->gaps(ta.box(e.a), node, planes.along);
        planes.set(plane_pose_, gaps, node);
    } else {
        const OrientedBox box = tb.box(e.b);
        gaps = pose_->gaps(node, box, planes.along);
        planes.set(plane_pose_, gaps, box);
    }
    const auto few_steps = static_cast<float>(2 * step_);
    const Mask4 used = node.half[0] >= all_lanes(0);
    const Mask4 closed = used & (gaps > all_lanes(0));
    unsigned open = bits_of(used & ~closed);
    // What was open stays so until it is well apart.
    for (unsigned was = e.open & ~open; was != 0; was &= was - 1) {
        const auto k = static_cast<std::uint32_t>(std::countr_zero(was));
        if (gaps[k] > few_steps)
            remove(e.below[k]);
        else
            open |= 1U << k;
    }
    const Mask4 parted = closed & ~lanes_of(open);
    planes.ask_only(parted);
    const float least = least_of(parted ? gaps : all_lanes(infinite_float));
    visits_[v].open = static_cast<std::uint8_t>(open);
    keep(v, static_cast<double>(least));
    for (unsigned opened = open & ~unsigned{e.open}; opened != 0; opened &= opened - 1) {
        const auto k = static_cast<std::uint32_t>(std::countr_zero(opened));
        const ObbId lane = ObbId::of(number, k);
        const std::uint32_t below =
            open_b ? add_visit(e.a, lane, v, e.slack) : add_visit(lane, e.b, v, e.slack);
        visits_[v].below[k] = below;
    }
    if (open == 0 && e.parent != none && step_ > 0 && least > 4 * few_steps &&
        least > 2 * e.tried) {
        visits_[v].tried = least;
        begin(e.parent);
    }
}

bool CoherentWalk::visit_leaves(std::uint32_t v) {
    const ObbChild ca = a_->boxes.child(visits_[v].a);
    const ObbChild cb = b_->boxes.child(visits_[v].b);
    TriangleCorners p;
    TriangleCorners q;
    if (visits_[v].has_plane) {
        ++counters_.plane_tests;
        move_corners(ca.first(), cb.first(), p, q);
        if (const double gap = gap_along_plane(v, p, q); gap > 0) {
            keep_apart(v, gap);
            return false;
        }
    }
    double least = infinity;
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
                    set_plane(v, p, q);
                    least = std::min(least, std::max(gap_along_plane(v, p, q), 0.0));
                    break;
            }
        }
    visits_[v].has_plane = least > 0 && ca.count() == 1 && cb.count() == 1;
    keep(v, least);
    return false;
}

// Across the way between closest points.
void CoherentWalk::set_plane(std::uint32_t v, const TriangleCorners& p, const TriangleCorners& q) {
    // About corner 0 of p, or rounding would be that of the lattice's origin.
    TriangleCorners p0 = p;
    TriangleCorners q0 = q;
    for (auto* t : {&p0, &q0})
        for (auto& c : *t)
            for (std::size_t k = 0; k < 3; ++k) c[k] -= p[0][k];
    const ClosestPoints closest = closest_points(p0, q0);
    std::array<double, 3> way{};
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 3; ++i)
            way[k] += closest.on_q[i] * q0[i][k] - closest.on_p[i] * p0[i][k];
        square += way[k] * way[k];
    }
    const double factor = square > 0 ? (1 - 0x1p-20) / std::sqrt(square) : 0;
    for (std::size_t k = 0; k < 3; ++k)
        planes_[v].along[k][0] = static_cast<float>(way[k] * factor);
}

// In units. Along L, |L| <= 1: `error_` bounds the errors of a coordinate of p and one of q
// together, √3 times it their effect; 2^50 times it also bounds the coordinates of q. So products
// with L, three terms each, are off by less than 2^-51 · (3 largest + 3 · 2^50 error_).
double CoherentWalk::gap_along_plane(std::uint32_t v, const TriangleCorners& p,
                                     const TriangleCorners& q) const {
    std::array<double, 3> along{};
    for (std::size_t k = 0; k < 3; ++k) along[k] = static_cast<double>(planes_[v].along[k][0]);
    double reach = -infinity;
    double from = infinity;
    for (std::size_t i = 0; i < 3; ++i) {
        reach = std::max(reach, (along[0] * p[i][0] + along[1] * p[i][1]) + along[2] * p[i][2]);
        from = std::min(from, (along[0] * q[i][0] + along[1] * q[i][1]) + along[2] * q[i][2]);
    }
    const double gap = from - reach - (4 * error_ + 0x1p-48 * a_->largest);
    return gap * slightly_less / a_->boxes.unit;
}

// Puts a visit on the list of those to be made.
void CoherentWalk::begin(std::uint32_t v) {
    visits_[v].slack = due_[v] - (odometer_ - step_);
    open_.push_back(v);
}

// Makes the visits on the list and those that they open. Stops at a crossing; what is left is due.
CoherentWalk::Answer CoherentWalk::visit_open() {
    while (!open_.empty()) {
        const std::uint32_t v = open_.back();
        open_.pop_back();
        if (!visits_[v].in_use) continue;
        if (!visit(v)) continue;
        open_.push_back(v);
        for (const std::uint32_t w : open_)
            if (visits_[w].in_use) due_.set(w, odometer_);
        open_.clear();
        return Answer::Crossing;
    }
    return answer();
}

// The odometer stands at this pose.
void CoherentWalk::stand() {
    front_pose_ = pose_;
    plane_pose_ = PlanePose(*pose_, turn_);
}

CoherentWalk::Answer CoherentWalk::make_front() {
    ++fresh_;
    visits_.clear();
    planes_.clear();
    // Growing step by step would be a good part of the first question.
    constexpr std::size_t room = 256;
    visits_.reserve(room);
    planes_.reserve(room);
    open_.reserve(room);
    unused_.clear();
    open_.clear();
    odometer_ = 0;
    step_ = 0;
    turn_ = 0;
    unknown_ = 0;
    unmoved_ = false;
    due_.clear();
    stand();
    add_visit(ObbId{}, ObbId{}, none, 0);
    return visit_open();
}

// Planes that part B from A under two poses do so all along the straight ways of B's points.
CoherentWalk::Answer CoherentWalk::renew_front() {
    unknown_ = 0;
    step_ = pose_->displacement_from(*front_pose_);
    odometer_ = (odometer_ + step_) * (1 + 0x1p-52);
    turn_ = (turn_ + pose_->turn_from(*front_pose_)) * (1 + 0x1p-52);
    if (!(turn_ <= PlanePose::most_turn * static_cast<double>(pose_->scale()))) {
        for (SeparatingPlanes& p : planes_) p.forget();
        turn_ = 0;
    }
    stand();
    unmoved_ = last_from_front_;
    due_.take(
        odometer_,
        [this](std::uint32_t v) {
            ++counters_.plane_tests;
            // No gap is no later reading.
            return (odometer_ + static_cast<double>(planes_[v].gap(plane_pose_))) * (1 - 0x1p-52);
        },
        open_);
    for (const std::uint32_t v : open_) visits_[v].slack = due_[v] - (odometer_ - step_);
    const std::size_t live = visits_.size() - unused_.size();
    if (8 * open_.size() > 7 * live + 64) return make_front();
    return visit_open();
}

// Depth ------------------------------------------------------------------------------------------

// Where a crossing was there may be depth. The last balls first, then large ones, then those next
// to the last ones: as bodies slide, the place where they are deepest wanders along both
// boundaries.
bool CoherentWalk::balls_overlap() {
    const InsideBalls* balls_a = a_->balls_in_time();
    const InsideBalls* balls_b = b_->balls_in_time();
    if (balls_a == nullptr || balls_b == nullptr) return false;
    std::optional<Relation> r;
    if (balls_)
        r = relation_by_ball_pair(*a_, balls_->first, *b_, *balls_b, balls_->second, map_,
                                  &reserve_);
    if (!r) r = relation_by_balls(*a_, *balls_a, *b_, *balls_b, map_, &reserve_);
    if (r != Relation::Overlapping && !find_balls()) {
        reserve_ = 0;
        return false;
    }
    ++counters_.by_balls;
    return true;
}

// The deepest pair of balls of the regions and some next to them.
bool CoherentWalk::find_balls() {
    constexpr std::size_t reach = 7;
    balls_.reset();
    const InsideBalls* balls_a = a_->balls_in_time();
    const InsideBalls* balls_b = b_->balls_in_time();
    if (balls_a == nullptr || balls_b == nullptr) return false;
    const std::size_t from_a = region_a_ - std::min(region_a_, reach);
    const std::size_t from_b = region_b_ - std::min(region_b_, reach);
    const auto near = [](const InsideBalls& balls, std::size_t from) {
        const auto all = balls.along_boundary();
        return all.subspan(from, std::min(2 * reach + 1, all.size() - from));
    };
    const auto near_a = near(*balls_a, from_a);
    const auto near_b = near(*balls_b, from_b);
    const auto deepest = deepest_pair(near_a, near_b, map_);
    if (!deepest) return false;
    const InsideBall& in_a = near_a[deepest->first];
    const InsideBall& in_b = near_b[deepest->second];
    if (!relation_by_ball_pair(*a_, in_a, *b_, *balls_b, in_b, map_, &reserve_)) return false;
    balls_.emplace(in_a, in_b);
    region_a_ = from_a + deepest->first;
    region_b_ = from_b + deepest->second;
    return true;
}

CoherentWalk::Answer CoherentWalk::crossing_answer() {
    const InsideBalls* balls_a = a_->balls_in_time();
    const InsideBalls* balls_b = b_->balls_in_time();
    if (balls_a == nullptr || balls_b == nullptr) return Answer::Crossing;
    region_a_ = balls_a->region_of(a_->boxes.child(witness_->a).first());
    region_b_ = balls_b->region_of(b_->boxes.child(witness_->b).first());
    if (!find_balls()) reserve_ = 0;
    return Answer::Crossing;
}

CoherentWalk::Answer CoherentWalk::ask(const ApproximateMap& b_to_a) {
    map_ = b_to_a;
    error_ = a_->position_error + b_to_a.error_below(b_->largest, b_->position_error);
    unknown_ = 0;
    const bool continues = last_from_front_;
    last_from_front_ = false;
    unmoved_ = false;
    far_ = false;
    reserve_ = 0;
    if (witness_) {
        if (balls_overlap()) return Answer::Crossing;
        if (leaves_cross(witness_->a, witness_->b)) return crossing_answer();
    }
    pose_.emplace(a_->boxes, b_->boxes, b_to_a);
    const bool elsewhere = is_elsewhere();
    last_pose_ = pose_;
    if (pose_->clearance() > 0) {
        far_ = true;
        witness_.reset();
        reserve_ = pose_->clearance() * a_->boxes.unit;
        return Answer::Apart;
    }
    Answer found{};
    if (witness_) {
        found = search_from_witness();
    } else {
        last_from_front_ = continues;
        found = elsewhere ? place() : front_pose_ ? renew_front() : make_front();
    }
    last_from_front_ = found != Answer::Crossing && front_pose_;
    if (found == Answer::Crossing) return crossing_answer();
    // Less than the last step had better not be kept.
    if (found == Answer::Apart && front_pose_)
        if (const double left = (due_.first() - odometer_) * slightly_less; left > step_)
            reserve_ = left * a_->boxes.unit;
    return found;
}

// What names boxes that are no more goes, and what names others is due at once.
void CoherentWalk::a_has_changed(const ChangedBoxes& changed) {
    if (witness_ && changed.is_gone(witness_->a)) witness_.reset();
    forget_changed(changed, &Visit::a);
}

void CoherentWalk::b_has_changed(const ChangedBoxes& changed) {
    if (witness_ && changed.is_gone(witness_->b)) witness_.reset();
    forget_changed(changed, &Visit::b);
}

void CoherentWalk::forget_changed(const ChangedBoxes& changed, ObbId Visit::*box) {
    balls_.reset();
    last_from_front_ = false;
    unmoved_ = false;
    if (!front_pose_) return;
    for (std::uint32_t v = 0; v < visits_.size(); ++v) {
        const ObbId own = visits_[v].*box;
        if (!visits_[v].in_use || changed.is_gone(own) || !changed.is_other(own)) continue;
        for (std::uint32_t k = 0; k < 4; ++k) {
            const unsigned bit = 1U << k;
            if ((visits_[v].open & bit) == 0) continue;
            const std::uint32_t below = visits_[v].below[k];
            if (!changed.is_gone(visits_[below].*box)) continue;
            remove(below);
            visits_[v].open = static_cast<std::uint8_t>(visits_[v].open & ~bit);
        }
        planes_[v].forget();
        visits_[v].has_plane = false;
        due_.set(v, odometer_);
    }
}

void CoherentWalk::forget() {
    witness_.reset();
    last_pose_.reset();
    front_pose_.reset();
    last_from_front_ = false;
}

}  // namespace trisect::detail
