// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/interference_query.h>

#include <optional>

#include <trisect/bsp/interference/coherent/coherent_walk.h>
#include <trisect/bsp/interference/coherent/motion_bound.h>
#include <trisect/bsp/interference/relation/boundary_flags.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/quick_relation.h>
#include <trisect/kernel/diagnostics.h>

namespace trisect {

using detail::CoherentWalk;

namespace {

InterferenceQueryCounters& counters() {
    return detail::counters_of_thread<InterferenceQueryCounters>;
}

}  // namespace

struct InterferenceQuery::State {
    State(const InterferenceModel& one, const InterferenceModel& other)
        : a(one),
          b(other),
          walk(detail::data_of(a), detail::data_of(b)),
          reserve(detail::data_of(a), detail::data_of(b)) {}

    [[nodiscard]] Relation ask(const Pose& pose_a, const Pose& pose_b);
    [[nodiscard]] Relation ask_walk(const Pose& pose_a, const Pose& pose_b);
    [[nodiscard]] CoherentWalk::Answer walk_to(const detail::ApproximateMap& map);

    InterferenceModel a;
    InterferenceModel b;
    CoherentWalk walk;
    std::optional<Relation> last_apart;  // the relation, when the walk's last answer was apart
    detail::MotionBound reserve;
    Relation reserved = Relation::Disjoint;  // the relation that it is for
};

Relation InterferenceQuery::State::ask(const Pose& pose_a, const Pose& pose_b) {
    ++counters().asked;
    if (a.is_empty() || b.is_empty()) return Relation::Disjoint;
    if (reserve.covers(pose_a, pose_b)) {
        ++counters().kept;
        return reserved;
    }
    return ask_walk(pose_a, pose_b);
}

CoherentWalk::Answer InterferenceQuery::State::walk_to(const detail::ApproximateMap& map) {
    const detail::WalkCounters before = walk.counters();
    const std::uint64_t fresh_walks = walk.fresh_walks();
    const std::uint64_t resumed_fronts = walk.resumed_fronts();
    const CoherentWalk::Answer answer = walk.ask(map);
    const detail::WalkCounters& after = walk.counters();
    InterferenceQueryCounters& c = counters();
    c.node_tests += after.node_tests - before.node_tests;
    c.plane_tests += after.plane_tests - before.plane_tests;
    c.triangle_pairs += after.triangle_pairs - before.triangle_pairs;
    c.by_balls += after.by_balls - before.by_balls;
    c.fresh_walks += walk.fresh_walks() - fresh_walks;
    c.resumed_fronts += walk.resumed_fronts() - resumed_fronts;
    return answer;
}

Relation InterferenceQuery::State::ask_walk(const Pose& pose_a, const Pose& pose_b) {
    reserve.clear();
    const auto map = detail::approximate_map(pose_a, a.lattice(), pose_b, b.lattice());
    if (!map.is_usable()) {
        ++counters().exact;
        walk.forget();
        last_apart.reset();
        return interfere(a, pose_a, b, pose_b).relation;
    }
    const CoherentWalk::Answer answer = walk_to(map);
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
            ++counters().kept;
        } else {
            last_apart = detail::relation_of_apart(detail::data_of(a), pose_a, detail::data_of(b),
                                                   pose_b, map);
        }
        if (last_apart) return keep(*last_apart);
    }
    ++counters().exact;
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

InterferenceQueryCounters& InterferenceQueryCounters::operator+=(
    const InterferenceQueryCounters& o) {
    asked += o.asked;
    node_tests += o.node_tests;
    plane_tests += o.plane_tests;
    triangle_pairs += o.triangle_pairs;
    fresh_walks += o.fresh_walks;
    resumed_fronts += o.resumed_fronts;
    by_balls += o.by_balls;
    kept += o.kept;
    exact += o.exact;
    return *this;
}

InterferenceQueryCounters& InterferenceQueryCounters::operator-=(
    const InterferenceQueryCounters& o) {
    asked -= o.asked;
    node_tests -= o.node_tests;
    plane_tests -= o.plane_tests;
    triangle_pairs -= o.triangle_pairs;
    fresh_walks -= o.fresh_walks;
    resumed_fronts -= o.resumed_fronts;
    by_balls -= o.by_balls;
    kept -= o.kept;
    exact -= o.exact;
    return *this;
}

}  // namespace trisect
