// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/interference_query.h>

#include <optional>

#include <trisect/bsp/interference/coherent/coherent_walk.h>
#include <trisect/bsp/interference/coherent/motion_bound.h>
#include <trisect/bsp/interference/relation/boundary_flags.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/quick_relation.h>

namespace trisect {

using detail::CoherentWalk;

struct InterferenceQuery::State {
    State(const InterferenceModel& one, const InterferenceModel& other)
        : a(one),
          b(other),
          walk(detail::data_of(a), detail::data_of(b)),
          reserve(detail::data_of(a), detail::data_of(b)) {}

    [[nodiscard]] Relation ask(const Pose& pose_a, const Pose& pose_b);
    [[nodiscard]] Relation ask_walk(const Pose& pose_a, const Pose& pose_b);

    InterferenceModel a;
    InterferenceModel b;
    CoherentWalk walk;
    std::optional<Relation> last_apart;  // the relation, when the walk's last answer was apart
    detail::MotionBound reserve;
    Relation reserved = Relation::Disjoint;  // the relation that it is for
    InterferenceQueryCounters counters;
};

Relation InterferenceQuery::State::ask(const Pose& pose_a, const Pose& pose_b) {
    ++counters.asked;
    if (a.is_empty() || b.is_empty()) return Relation::Disjoint;
    if (reserve.covers(pose_a, pose_b)) {
        ++counters.kept;
        return reserved;
    }
    return ask_walk(pose_a, pose_b);
}

Relation InterferenceQuery::State::ask_walk(const Pose& pose_a, const Pose& pose_b) {
    reserve.clear();
    const auto map = detail::approximate_map(pose_a, a.lattice(), pose_b, b.lattice());
    if (!map.is_usable()) {
        ++counters.exact;
        walk.forget();
        last_apart.reset();
        return interfere(a, pose_a, b, pose_b).relation;
    }
    const CoherentWalk::Answer answer = walk.ask(map);
    const auto keep = [&](Relation relation) {
        reserved = relation;
        if (walk.reserve() > 0) reserve.set(pose_a, pose_b, map, walk.reserve());
        return relation;
    };
    if (answer == CoherentWalk::Answer::Crossing) {
        last_apart.reset();
        return keep(Relation::Overlapping);
    }
    if (answer == CoherentWalk::Answer::Apart) {
        if (walk.is_far()) {
            last_apart = Relation::Disjoint;
        } else if (last_apart && walk.is_unmoved()) {
            ++counters.kept;
        } else {
            last_apart = detail::relation_of_apart(detail::data_of(a), pose_a, detail::data_of(b),
                                                   pose_b, map);
        }
        if (last_apart) return keep(*last_apart);
    }
    ++counters.exact;
    last_apart.reset();
    return interfere(a, pose_a, b, pose_b).relation;
}

InterferenceQuery::InterferenceQuery(const InterferenceModel& a, const InterferenceModel& b)
    : state_(std::make_unique<State>(a, b)) {}
InterferenceQuery::~InterferenceQuery() = default;
InterferenceQuery::InterferenceQuery(InterferenceQuery&&) noexcept = default;
InterferenceQuery& InterferenceQuery::operator=(InterferenceQuery&&) noexcept = default;

Relation InterferenceQuery::relation(const Pose& pose_a, const Pose& pose_b) {
    return state_->ask(pose_a, pose_b);
}
void InterferenceQuery::forget() {
    state_->walk.forget();
    state_->last_apart.reset();
    state_->reserve.clear();
}
InterferenceQueryCounters InterferenceQuery::counters() const {
    InterferenceQueryCounters r = state_->counters;
    const detail::WalkCounters& walk = state_->walk.counters();
    r.node_tests = walk.node_tests;
    r.plane_tests = walk.plane_tests;
    r.triangle_pairs = walk.triangle_pairs;
    r.by_balls = walk.by_balls;
    r.fresh_walks = state_->walk.fresh_walks();
    r.resumed_fronts = state_->walk.resumed_fronts();
    return r;
}

}  // namespace trisect
