// SPDX-License-Identifier: Apache-2.0
//
// A frame in three steps: boxes of the bodies that moved; pairs of boxes that meet; for each pair
// its relation, exactly. The first two only exclude pairs, so all that their doubles must be is on
// the safe side.
//
// What stays between frames (Cohen, Lin, Manocha and Ponamgi 1995 call it coherence): the order of
// the boxes, and for each pair of boxes that meet its answer and, of large bodies, what its query
// remembers. A pair of which neither body has moved keeps its answer. Answers are distinguished by
// placements, numbers that no two poses of a scene share, so that a body that came in the place of
// a removed one is never mistaken for it.
//
// Pairs are independent of each other and of the order in which they are processed, and each writes
// to a place of its own; so threads cannot change the outcome, not even which of two errors is
// thrown.
#include <trisect/bsp/interference/interference_scene.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <string>
#include <utility>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/interference/boxes/broad_phase.h>
#include <trisect/bsp/interference/interference_query.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/scene/broad_phases.h>
#include <trisect/bsp/interference/scene/chain_boxes.h>
#include <trisect/bsp/interference/scene/scene_bodies.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/seconds_since.h>

namespace trisect {
namespace {

using detail::BodyPair;
using detail::SceneBodies;
using detail::SceneBody;
using detail::seconds_since;

/// Of both models together. Below that a walk from the roots takes no longer than remembering.
constexpr std::size_t worth_remembering = 4096;

void for_each_in_parallel(std::size_t n, std::uint32_t threads, std::size_t grain,
                          const auto& work) {
    detail::ParallelParts(n, threads, grain)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) work(i);
        });
}

std::unique_ptr<detail::BroadPhase> make_broad_phase(SceneBroadPhase kind) {
    switch (kind) {
        case SceneBroadPhase::SweepAndPrune:
            break;
        case SceneBroadPhase::BoxTree:
            return detail::make_box_tree();
        case SceneBroadPhase::HashGrid:
            return hierarchies::make_hash_grid();
        case SceneBroadPhase::HierarchicalGrid:
            return hierarchies::make_hierarchical_grid();
        case SceneBroadPhase::Octree:
            return hierarchies::make_octree_phase();
        case SceneBroadPhase::KdTree:
            return hierarchies::make_kd_tree_phase();
        case SceneBroadPhase::ChainBoxes:
            return hierarchies::make_chain_boxes();
    }
    return detail::make_sweep_and_prune();
}

}  // namespace

SceneCounters& SceneCounters::operator+=(const SceneCounters& o) {
    bodies += o.bodies;
    boxes_met += o.boxes_met;
    filtered += o.filtered;
    kept += o.kept;
    asked += o.asked;
    interfering += o.interfering;
    broad_seconds += o.broad_seconds;
    exact_seconds += o.exact_seconds;
    return *this;
}

SceneCounters& SceneCounters::operator-=(const SceneCounters& o) {
    bodies -= o.bodies;
    boxes_met -= o.boxes_met;
    filtered -= o.filtered;
    kept -= o.kept;
    asked -= o.asked;
    interfering -= o.interfering;
    broad_seconds -= o.broad_seconds;
    exact_seconds -= o.exact_seconds;
    return *this;
}

class Scene::Implementation {
public:
    explicit Implementation(const SceneOptions& options)
        : broad_(make_broad_phase(options.broad_phase)) {}

    SceneBodies bodies;

    std::vector<ScenePair> interfering(const SceneQueryOptions& options) {
        counters_ = {};
        counters_.bodies = bodies.size();
        const auto start = std::chrono::steady_clock::now();
        update_boxes(options.threads);
        broad_->pairs(pairs_);
        counters_.boxes_met = pairs_.size();
        counters_.broad_seconds = seconds_since(start);
        const auto middle = std::chrono::steady_clock::now();
        ask(options);
        std::vector<ScenePair> out = answers(options.contacts);
        counters_.interfering = out.size();
        counters_.exact_seconds = seconds_since(middle);
        detail::counters_of_thread<SceneCounters> += counters_;
        return out;
    }

private:
    /// State of a pair of bodies.
    struct Answer {
        BodyPair pair;
        std::uint64_t placement_a = 0;
        std::uint64_t placement_b = 0;
        bool has_contacts = false;
        Relation relation = Relation::Disjoint;
        std::vector<Contact> contacts;
        std::vector<NamedContact> named_contacts;
        /// Of large models only, and those for which it was made; it keeps them alive.
        std::unique_ptr<InterferenceQuery> query;
        const detail::InterferenceModelData* query_a = nullptr;
        const detail::InterferenceModelData* query_b = nullptr;
        /// Those of a query of solids.
        Solid solid_a;
        Solid solid_b;
        std::exception_ptr error;
    };

    /// State of a slot in the broad phase.
    struct Known {
        std::uint64_t placement = 0;  ///< 0: nothing
        detail::BodyBox box;
    };

    void update_boxes(std::uint32_t threads) {
        known_.resize(bodies.slot_count());
        std::vector<std::pair<std::uint32_t, detail::BodyBox>> moved;
        for (std::uint32_t s = 0; s < known_.size(); ++s) {
            const bool stands = bodies.is_used(s) && bodies.body(s).bounds;
            if (stands && bodies.body(s).placement != known_[s].placement) {
                moved.emplace_back(s, detail::BodyBox());
            } else if (!stands && known_[s].placement != 0) {
                broad_->remove(s);
                known_[s].placement = 0;
            }
        }
        for_each_in_parallel(moved.size(), threads, 64, [&](std::size_t i) {
            const SceneBody& body = bodies.body(moved[i].first);
            moved[i].second = body.bounds->under(body.pose);
        });
        for (const auto& [s, box] : moved) {
            if (known_[s].placement == 0) {
                broad_->insert(s, box);
            } else {
                broad_->update(s, box);
            }
            known_[s].placement = bodies.body(s).placement;
        }
    }

    void ask(const SceneQueryOptions& options) {
        std::vector<Answer> next;
        std::vector<std::uint32_t> open;
        auto old = answers_.begin();
        for (const BodyPair& pair : pairs_) {
            if (!bodies.may_meet(pair.first, pair.second)) {
                ++counters_.filtered;
                continue;
            }
            while (old != answers_.end() && old->pair < pair) ++old;
            if (old != answers_.end() && old->pair == pair) {
                next.push_back(std::move(*old));
            } else {
                next.emplace_back().pair = pair;
            }
            if (is_current(next.back(), options)) {
                ++counters_.kept;
            } else {
                open.push_back(static_cast<std::uint32_t>(next.size() - 1));
            }
        }
        answers_ = std::move(next);
        counters_.asked = open.size();
        for_each_in_parallel(open.size(), options.threads, 1,
                             [&](std::size_t i) { decide(answers_[open[i]], options); });
        for (const std::uint32_t i : open) {
            if (!answers_[i].error) continue;
            const std::exception_ptr error = answers_[i].error;
            answers_.clear();
            std::rethrow_exception(error);
        }
    }

    [[nodiscard]] bool is_current(const Answer& answer, const SceneQueryOptions& options) const {
        return answer.placement_a == bodies.body(answer.pair.first).placement &&
               answer.placement_b == bodies.body(answer.pair.second).placement &&
               (answer.has_contacts || !options.contacts);
    }

    void decide(Answer& answer, const SceneQueryOptions& options) const {
        const SceneBody& a = bodies.body(answer.pair.first);
        const SceneBody& b = bodies.body(answer.pair.second);
        try {
            relate(answer, a, b, options);
        } catch (const LimitError& e) {
            answer.error = std::make_exception_ptr(
                LimitError("bodies " + std::to_string(answer.pair.first) + " and " +
                           std::to_string(answer.pair.second) + ": " + e.what()));
        } catch (...) {
            answer.error = std::current_exception();
        }
        answer.placement_a = a.placement;
        answer.placement_b = b.placement;
        answer.has_contacts = options.contacts;
    }

    static void relate(Answer& answer, const SceneBody& a, const SceneBody& b,
                       const SceneQueryOptions& options);
    static void relate_solids(Answer& answer, const SceneBody& a, const SceneBody& b,
                              const SceneQueryOptions& options);
    [[nodiscard]] static Relation relation(Answer& answer, const SceneBody& a, const SceneBody& b);

    [[nodiscard]] std::vector<ScenePair> answers(bool contacts) const {
        std::vector<ScenePair> out;
        for (const Answer& answer : answers_) {
            if (answer.relation == Relation::Disjoint) continue;
            out.push_back({bodies.id(answer.pair.first),
                           bodies.id(answer.pair.second),
                           answer.relation,
                           {},
                           {}});
            if (!contacts) continue;
            out.back().contacts = answer.contacts;
            out.back().named_contacts = answer.named_contacts;
        }
        return out;
    }

    std::unique_ptr<detail::BroadPhase> broad_;
    std::vector<Known> known_;     // by slot
    std::vector<BodyPair> pairs_;  // of boxes that meet
    std::vector<Answer> answers_;  // of pairs that filters let pass, in order
    SceneCounters counters_;       // of the last query
};

void Scene::Implementation::relate(Answer& answer, const SceneBody& a, const SceneBody& b,
                                   const SceneQueryOptions& options) {
    answer.contacts.clear();
    answer.named_contacts.clear();
    if (a.solid || b.solid) return relate_solids(answer, a, b, options);
    answer.relation = relation(answer, a, b);
    // Only boundaries that meet have contacts, and most do not.
    if (!options.contacts || answer.relation == Relation::Disjoint) return;
    InterferenceOptions query;
    query.contacts = true;
    answer.contacts = interfere(a.model, a.pose, b.model, b.pose, query).contacts;
}

// Goes on with the query of the last solids in these slots.
void Scene::Implementation::relate_solids(Answer& answer, const SceneBody& a, const SceneBody& b,
                                          const SceneQueryOptions& options) {
    const auto& solid_of = [](const SceneBody& body) -> const Solid& {
        return body.solid ? *body.solid : body.model.solid();
    };
    const Solid& solid_a = solid_of(a);
    const Solid& solid_b = solid_of(b);
    const auto are_same = [](const Solid& s, const Solid& t) {
        return detail::state_of(s) == detail::state_of(t);
    };
    if (!answer.query || answer.query_a != nullptr) {
        answer.query = std::make_unique<InterferenceQuery>(solid_a, solid_b);
        answer.query_a = answer.query_b = nullptr;
    } else {
        if (!are_same(answer.solid_a, solid_a)) answer.query->replace_a(solid_a);
        if (!are_same(answer.solid_b, solid_b)) answer.query->replace_b(solid_b);
    }
    answer.solid_a = solid_a;
    answer.solid_b = solid_b;
    answer.relation = answer.query->relation(a.pose, b.pose);
    if (!options.contacts || answer.relation == Relation::Disjoint) return;
    answer.named_contacts =
        interfere(solid_a, a.pose, solid_b, b.pose, {.contacts = true}).contacts;
}

Relation Scene::Implementation::relation(Answer& answer, const SceneBody& a, const SceneBody& b) {
    if (a.model.triangle_count() + b.model.triangle_count() < worth_remembering)
        return interfere(a.model, a.pose, b.model, b.pose).relation;
    // Another body may have come into the slot of one that was removed.
    if (!answer.query || answer.query_a != &detail::data_of(a.model) ||
        answer.query_b != &detail::data_of(b.model)) {
        answer.query = std::make_unique<InterferenceQuery>(a.model, b.model);
        answer.query_a = &detail::data_of(a.model);
        answer.query_b = &detail::data_of(b.model);
    }
    return answer.query->relation(a.pose, b.pose);
}

Scene::Scene(const SceneOptions& options)
    : implementation_(std::make_unique<Implementation>(options)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

BodyId Scene::add(const InterferenceModel& model, const Pose& pose, const CollisionFilter& filter) {
    return implementation_->bodies.add(model, pose, filter);
}

BodyId Scene::add_link(BodyId carrier, const InterferenceModel& model, const Joint& joint,
                       const LinkOptions& options) {
    return implementation_->bodies.add_link(carrier, model, joint, options);
}

BodyId Scene::add(const Solid& solid, const Pose& pose, const CollisionFilter& filter) {
    return implementation_->bodies.add(solid, pose, filter);
}

BodyId Scene::add_link(BodyId carrier, const Solid& solid, const Joint& joint,
                       const LinkOptions& options) {
    return implementation_->bodies.add_link(carrier, solid, joint, options);
}

void Scene::replace(BodyId body, const Solid& solid) {
    implementation_->bodies.replace(body, solid);
}

void Scene::remove(BodyId body) { implementation_->bodies.remove(body); }

void Scene::set_pose(BodyId body, const Pose& pose) {
    implementation_->bodies.set_pose(body, pose);
}

void Scene::set_joint(BodyId link, Ratio value) {
    const JointValue one{link, value};
    implementation_->bodies.set_joints({&one, 1});
}

void Scene::set_joints(std::span<const JointValue> values) {
    implementation_->bodies.set_joints(values);
}

void Scene::set_filter(BodyId body, const CollisionFilter& filter) {
    implementation_->bodies.set_filter(body, filter);
}

void Scene::ignore(BodyId a, BodyId b, bool ignored) {
    implementation_->bodies.ignore(a, b, ignored);
}

bool Scene::contains(BodyId body) const { return implementation_->bodies.contains(body); }
std::size_t Scene::size() const { return implementation_->bodies.size(); }
std::vector<BodyId> Scene::bodies() const { return implementation_->bodies.all(); }

const InterferenceModel& Scene::model(BodyId body) const {
    const SceneBody& b = implementation_->bodies.at(body);
    if (b.solid) throw UsageError("the body is a solid without a model");
    return b.model;
}

const Solid& Scene::solid(BodyId body) const {
    const SceneBody& b = implementation_->bodies.at(body);
    return b.solid ? *b.solid : b.model.solid();
}

const Pose& Scene::pose(BodyId body) const { return implementation_->bodies.at(body).pose; }
const Joint& Scene::joint(BodyId link) const { return implementation_->bodies.link(link).joint; }
Ratio Scene::joint_value(BodyId link) const { return implementation_->bodies.link(link).value; }

std::vector<ScenePair> Scene::interfering(const SceneQueryOptions& options) {
    return implementation_->interfering(options);
}

}  // namespace trisect
