// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference_query.h>

#include <optional>

#include <trisect/bsp/detail/boundary_flags.h>
#include <trisect/bsp/detail/coherent_walk.h>
#include <trisect/bsp/detail/quick_relation.h>

namespace trisect {

using detail::CoherentWalk;

struct InterferenceQuery::State {
    State(const InterferenceModel& one, const InterferenceModel& other)
        : a(one), b(other), walk(a.data(), b.data()) {}

    [[nodiscard]] Relation ask(const Pose& pose_a, const Pose& pose_b);

    InterferenceModel a;
    InterferenceModel b;
    CoherentWalk walk;
    std::optional<Relation> last_apart;  // the relation, when the last answer was apart
    InterferenceQueryCounters counters;
};

Relation InterferenceQuery::State::ask(const Pose& pose_a, const Pose& pose_b) {
    ++counters.asked;
    if (a.is_empty() || b.is_empty()) return Relation::Disjoint;
    const auto map = detail::approximate_map(pose_a, a.lattice(), pose_b, b.lattice());
    if (!map.is_usable()) {
        ++counters.exact;
        walk.forget();
        last_apart.reset();
        return interfere(a, pose_a, b, pose_b).relation;
    }
    const CoherentWalk::Answer answer = walk.ask(map);
    counters.node_tests = walk.counters().node_tests;
    counters.triangle_pairs = walk.counters().triangle_pairs;
    counters.fresh_walks = walk.fresh_walks();
    if (answer == CoherentWalk::Answer::Crossing) {
        last_apart.reset();
        return Relation::Overlapping;
    }
    if (answer == CoherentWalk::Answer::Apart) {
        if (last_apart && walk.is_unmoved()) {
            ++counters.kept;
            return *last_apart;
        }
        last_apart = detail::relation_of_apart(a.data(), pose_a, b.data(), pose_b, map);
        if (last_apart) return *last_apart;
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
}
const InterferenceQueryCounters& InterferenceQuery::counters() const { return state_->counters; }

}  // namespace trisect
