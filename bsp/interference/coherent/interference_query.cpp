// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/interference_query.h>

#include <memory>
#include <optional>

#include <trisect/bsp/interference/coherent/coherent_walk.h>
#include <trisect/bsp/interference/coherent/motion_bound.h>
#include <trisect/bsp/interference/relation/boundary_flags.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/quick_relation.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/bsp/interference/tree/solid_pair.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>

namespace trisect {

using detail::CoherentWalk;
using detail::SolidBoundary;

namespace {

InterferenceQueryCounters& counters() {
    return detail::counters_of_thread<InterferenceQueryCounters>;
}

}  // namespace

// Two boundaries, and what depends on what they are of.
class InterferenceQuery::State {
public:
    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    virtual ~State() = default;

    [[nodiscard]] Relation ask(const Pose& pose_a, const Pose& pose_b);
    virtual void replace_a(const Solid& a) = 0;
    virtual void replace_b(const Solid& b) = 0;
    void forget() {
        if (walk_) walk_->forget();
        last_apart_.reset();
        if (reserve_) reserve_->clear();
    }

protected:
    // Empty where a solid is.
    void begin(const detail::Boundary& a, const detail::Boundary& b) {
        a_ = &a;
        b_ = &b;
        last_apart_.reset();
        walk_.emplace(a, b);
        reserve_.emplace(a, b);
    }
    void end() {
        walk_.reset();
        reserve_.reset();
    }
    // Whatever the walk says.
    [[nodiscard]] virtual Relation exact(const Pose& pose_a, const Pose& pose_b) = 0;
    // Of boundaries that are apart, if that is quickly found out.
    [[nodiscard]] virtual std::optional<Relation> apart(const Pose& pose_a, const Pose& pose_b,
                                                        const detail::ApproximateMap& map) = 0;

    std::optional<CoherentWalk> walk_;
    std::optional<Relation> last_apart_;  // the relation, when the walk's last answer was apart
    std::optional<detail::MotionBound> reserve_;

private:
    [[nodiscard]] Relation ask_walk(const Pose& pose_a, const Pose& pose_b);
    [[nodiscard]] CoherentWalk::Answer walk_to(const detail::ApproximateMap& map);
    [[nodiscard]] Relation ask_exactly(const Pose& pose_a, const Pose& pose_b) {
        ++counters().exact;
        last_apart_.reset();
        return exact(pose_a, pose_b);
    }

    const detail::Boundary* a_ = nullptr;
    const detail::Boundary* b_ = nullptr;
    Relation reserved_ = Relation::Disjoint;  // the relation that the reserve is for
};

namespace {

class ModelQuery final : public InterferenceQuery::State {
public:
    ModelQuery(const InterferenceModel& a, const InterferenceModel& b) : a_(a), b_(b) {
        if (!a.is_empty() && !b.is_empty()) begin(detail::data_of(a_), detail::data_of(b_));
    }
    void replace_a(const Solid& /*a*/) override { refuse(); }
    void replace_b(const Solid& /*b*/) override { refuse(); }

private:
    [[noreturn]] static void refuse() {
        throw UsageError("a query of models cannot go on with another solid");
    }
    [[nodiscard]] Relation exact(const Pose& pose_a, const Pose& pose_b) override {
        return interfere(a_, pose_a, b_, pose_b).relation;
    }
    [[nodiscard]] std::optional<Relation> apart(const Pose& pose_a, const Pose& pose_b,
                                                const detail::ApproximateMap& map) override {
        return detail::relation_of_apart(detail::data_of(a_), pose_a, detail::data_of(b_), pose_b,
                                         map);
    }

    InterferenceModel a_;
    InterferenceModel b_;
};

class SolidQuery final : public InterferenceQuery::State {
public:
    SolidQuery(const Solid& a, const Solid& b)
        : a_(std::make_unique<SolidBoundary>(a)), b_(std::make_unique<SolidBoundary>(b)) {
        begin_anew();
    }
    void replace_a(const Solid& a) override {
        replace(a_, a, [this](const detail::ChangedBoxes& c) { walk_->a_has_changed(c); });
    }
    void replace_b(const Solid& b) override {
        replace(b_, b, [this](const detail::ChangedBoxes& c) { walk_->b_has_changed(c); });
    }

private:
    void replace(std::unique_ptr<SolidBoundary>& boundary, const Solid& solid, const auto& note) {
        if (!is_overgrown(*boundary)) {
            if (const auto changed = boundary->replace(solid)) {
                last_apart_.reset();
                if (!walk_) return;
                note(*changed);
                reserve_->clear();
                return;
            }
        }
        boundary = std::make_unique<SolidBoundary>(solid);
        begin_anew();
    }
    // Whether most of what was opened is not near the other body any more, after it has been
    // elsewhere: larger arrays take longer to go on with than new ones to make.
    [[nodiscard]] bool is_overgrown(const SolidBoundary& boundary) {
        const std::size_t nodes = boundary.boxes.nodes.size();
        if (first_nodes_ == 0) first_nodes_ = nodes;
        return nodes > 4 * first_nodes_ + 2048;
    }
    void begin_anew() {
        first_nodes_ = 0;
        if (a_->is_empty() || b_->is_empty())
            end();
        else
            begin(*a_, *b_);
    }
    [[nodiscard]] Relation exact(const Pose& pose_a, const Pose& pose_b) override {
        return detail::relation_of(*a_, pose_a, *b_, pose_b, {}).relation;
    }
    [[nodiscard]] std::optional<Relation> apart(const Pose& pose_a, const Pose& pose_b,
                                                const detail::ApproximateMap& /*map*/) override {
        return detail::relation_of_apart(*a_, pose_a, *b_, pose_b);
    }

    std::unique_ptr<SolidBoundary> a_;
    std::unique_ptr<SolidBoundary> b_;
    std::size_t first_nodes_ = 0;  // of the body that is replaced, after the first questions
};

}  // namespace

Relation InterferenceQuery::State::ask(const Pose& pose_a, const Pose& pose_b) {
    ++counters().asked;
    if (!walk_) return Relation::Disjoint;
    if (reserve_->covers(pose_a, pose_b)) {
        ++counters().kept;
        return reserved_;
    }
    return ask_walk(pose_a, pose_b);
}

CoherentWalk::Answer InterferenceQuery::State::walk_to(const detail::ApproximateMap& map) {
    const detail::WalkCounters before = walk_->counters();
    const std::uint64_t fresh_walks = walk_->fresh_walks();
    const std::uint64_t resumed_fronts = walk_->resumed_fronts();
    const CoherentWalk::Answer answer = walk_->ask(map);
    const detail::WalkCounters& after = walk_->counters();
    InterferenceQueryCounters& c = counters();
    c.node_tests += after.node_tests - before.node_tests;
    c.plane_tests += after.plane_tests - before.plane_tests;
    c.triangle_pairs += after.triangle_pairs - before.triangle_pairs;
    c.by_balls += after.by_balls - before.by_balls;
    c.fresh_walks += walk_->fresh_walks() - fresh_walks;
    c.resumed_fronts += walk_->resumed_fronts() - resumed_fronts;
    return answer;
}

Relation InterferenceQuery::State::ask_walk(const Pose& pose_a, const Pose& pose_b) {
    reserve_->clear();
    const auto map = detail::approximate_map(pose_a, a_->lattice, pose_b, b_->lattice);
    if (!map.is_usable()) {
        walk_->forget();
        return ask_exactly(pose_a, pose_b);
    }
    const CoherentWalk::Answer answer = walk_to(map);
    const auto keep = [&](Relation relation) {
        reserved_ = relation;
        if (walk_->reserve() > 0) reserve_->set(pose_a, pose_b, map, walk_->reserve());
        return relation;
    };
    if (answer == CoherentWalk::Answer::Crossing) {
        last_apart_.reset();
        return keep(Relation::Overlapping);
    }
    if (answer == CoherentWalk::Answer::Apart) {
        if (walk_->is_far())
            last_apart_ = Relation::Disjoint;
        else if (last_apart_ && walk_->is_unmoved())
            ++counters().kept;
        else
            last_apart_ = apart(pose_a, pose_b, map);
        if (last_apart_) return keep(*last_apart_);
    }
    return ask_exactly(pose_a, pose_b);
}

InterferenceQuery::InterferenceQuery(const InterferenceModel& a, const InterferenceModel& b)
    : state_(std::make_unique<ModelQuery>(a, b)) {}
InterferenceQuery::InterferenceQuery(const Solid& a, const Solid& b)
    : state_(std::make_unique<SolidQuery>(a, b)) {}
InterferenceQuery::~InterferenceQuery() = default;
InterferenceQuery::InterferenceQuery(InterferenceQuery&&) noexcept = default;
InterferenceQuery& InterferenceQuery::operator=(InterferenceQuery&&) noexcept = default;

Relation InterferenceQuery::relation(const Pose& pose_a, const Pose& pose_b) {
    return state_->ask(pose_a, pose_b);
}
void InterferenceQuery::replace_a(const Solid& a) { state_->replace_a(a); }
void InterferenceQuery::replace_b(const Solid& b) { state_->replace_b(b); }
void InterferenceQuery::forget() { state_->forget(); }

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
