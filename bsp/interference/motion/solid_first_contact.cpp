// SPDX-License-Identifier: Apache-2.0
//
// Both boundaries serve all static queries and all searches of a question, so each box is opened
// once however often the search comes to it.
//
// Corners and sides that walls of cells made are no entities, and what meets must not depend on
// cells. So an event counts as in a model: a vertex of the set with what it arrives at, or two of
// its edges that cross. Where they do at a corner that a wall made on one of them, the event is
// that of the corner (solid_events.cpp); edges that are parallel then, or in one plane for good, do
// not cross. All that is left out has an entity of the model beside it: where a wall's side within
// a face meets an edge at a first contact, the edge lies in the face and leaves it somewhere.

#include <trisect/bsp/interference/solid_motion.h>

#include <algorithm>
#include <utility>

#include <trisect/bsp/interference/motion/contact_query.h>
#include <trisect/bsp/interference/motion/exact_paths.h>
#include <trisect/bsp/interference/motion/solid_events.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/bsp/interference/tree/solid_pair.h>
#include <trisect/kernel/diagnostics.h>

namespace trisect {

namespace {

using detail::SolidEvents;

class QueryOfSolids final : public detail::ContactQuery {
public:
    QueryOfSolids(SolidEvents& a, const Motion& motion_a, SolidEvents& b, const Motion& motion_b)
        : ContactQuery(a, motion_a, b, motion_b), a_(a), b_(b) {}

    [[nodiscard]] std::vector<NamedWitness> witnesses() && { return std::move(witnesses_); }

protected:
    [[nodiscard]] Relation relation_at(const Pose& pose_a, const Pose& pose_b) override {
        return relation_of(a_.solid(), pose_a, b_.solid(), pose_b, {}).relation;
    }
    void take_witnesses(const detail::EventsAtATime& events,
                        const detail::RelativeMotion& motion) override {
        detail::RealRoot time = events.time;
        for (const detail::FeaturePair& p : events.pairs) {
            const SolidEvents::Entity a = a_.entity_of(p.a);
            const SolidEvents::Entity b = b_.entity_of(p.b);
            if (are_entities(p, a.name, b.name) ||
                (a.name.kind == Kind::Edge && b.name.kind == Kind::Edge &&
                 cross_at(time, motion, a.line, b.line)))
                witnesses_.push_back({a.name, b.name});
        }
        sort_witnesses();
    }
    void take_witnesses_at(const Pose& pose_a, const Pose& pose_b) override {
        SolidInterferenceOptions options;
        options.contacts = true;
        for (const NamedContact& c :
             relation_of(a_.solid(), pose_a, b_.solid(), pose_b, options).contacts)
            witnesses_.push_back({c.a, c.b});
        sort_witnesses();
    }

private:
    using Kind = EntityName::Kind;

    // Whether the vertex that arrives is one of the set.
    static bool are_entities(const detail::FeaturePair& p, const EntityName& a,
                             const EntityName& b) {
        using Event = detail::FeaturePair::Kind;
        return (p.kind == Event::VertexOfA && a.kind == Kind::Vertex) ||
               (p.kind == Event::VertexOfB && b.kind == Kind::Vertex);
    }
    void sort_witnesses() {
        std::ranges::sort(witnesses_);
        witnesses_.erase(std::unique(witnesses_.begin(), witnesses_.end()), witnesses_.end());
    }

    const SolidEvents& a_;
    const SolidEvents& b_;
    std::vector<NamedWitness> witnesses_;
};

}  // namespace

NamedFirstContact first_contact(const Solid& a, const Motion& motion_a, const Solid& b,
                                const Motion& motion_b, const FirstContactOptions& options) {
    const detail::SolidBoundary boundary_a(a);
    const detail::SolidBoundary boundary_b(b);
    SolidEvents events_a(boundary_a);
    SolidEvents events_b(boundary_b);
    QueryOfSolids query(events_a, motion_a, events_b, motion_b);
    query.run(options.event);
    detail::counters_of_thread<FirstContactCounters> += query.counters();
    return {query.time(), std::move(query).witnesses(), query.at_start()};
}

}  // namespace trisect
