// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/first_contact.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/motion/contact_query.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/diagnostics.h>

namespace trisect {

namespace {

using detail::ModelEvents;

BoundaryEntity entity_of(const detail::ContactFeature& f, const detail::InterferenceModelData& d) {
    const detail::ModelTriangle& t = d.triangles[f.triangle];
    if (f.feature.is_corner()) return d.place[t.vertex[f.feature.index()].index];
    if (f.feature.is_interior()) return t.face;
    const EdgeId edge = t.edge[f.feature.index()];
    if (!edge.is_valid()) return t.face;
    const auto copies = d.brep.copies(edge);
    return copies.empty() ? edge : *std::min_element(copies.begin(), copies.end());
}

class QueryOfModels final : public detail::ContactQuery {
public:
    QueryOfModels(const InterferenceModel& a, ModelEvents& events_a, const Motion& motion_a,
                  const InterferenceModel& b, ModelEvents& events_b, const Motion& motion_b,
                  bool leave_out_receding)
        : ContactQuery(events_a, motion_a, events_b, motion_b),
          a_(a),
          b_(b),
          events_a_(events_a),
          events_b_(events_b),
          leave_out_receding_(leave_out_receding) {}

    [[nodiscard]] std::vector<ContactWitness> witnesses() && { return std::move(witnesses_); }

protected:
    [[nodiscard]] Relation relation_at(const Pose& pose_a, const Pose& pose_b) override {
        return interfere(a_, pose_a, b_, pose_b).relation;
    }
    void take_witnesses(const detail::EventsAtATime& events,
                        const detail::RelativeMotion& /*motion*/) override {
        for (const detail::FeaturePair& p : events.pairs)
            witnesses_.push_back(
                {entity_of(p.a, events_a_.data()), entity_of(p.b, events_b_.data())});
        sort_witnesses();
    }
    void take_witnesses_at(const Pose& pose_a, const Pose& pose_b) override {
        InterferenceOptions options;
        options.contacts = true;
        const InterferenceResult r = interfere(a_, pose_a, b_, pose_b, options);
        for (const Contact& c : r.contacts) witnesses_.push_back({c.a, c.b});
        sort_witnesses();
    }
    [[nodiscard]] detail::RecedingFaces* receding() override {
        if (!leave_out_receding_) return nullptr;
        cones_a_ = std::make_unique<detail::FacingCones>(events_a_);
        cones_b_ = std::make_unique<detail::FacingCones>(events_b_);
        receding_ = std::make_unique<detail::RecedingFaces>(*cones_a_, *cones_b_, events_b_);
        return receding_.get();
    }

private:
    void sort_witnesses() {
        std::ranges::sort(witnesses_);
        witnesses_.erase(std::unique(witnesses_.begin(), witnesses_.end()), witnesses_.end());
    }

    const InterferenceModel& a_;
    const InterferenceModel& b_;
    const ModelEvents& events_a_;
    const ModelEvents& events_b_;
    bool leave_out_receding_;
    std::unique_ptr<detail::FacingCones> cones_a_;
    std::unique_ptr<detail::FacingCones> cones_b_;
    std::unique_ptr<detail::RecedingFaces> receding_;
    std::vector<ContactWitness> witnesses_;
};

}  // namespace

FirstContactCounters& FirstContactCounters::operator+=(const FirstContactCounters& o) {
    intervals += o.intervals;
    box_tests += o.box_tests;
    triangle_pairs += o.triangle_pairs;
    separating_pairs += o.separating_pairs;
    return *this;
}

FirstContactCounters& FirstContactCounters::operator-=(const FirstContactCounters& o) {
    intervals -= o.intervals;
    box_tests -= o.box_tests;
    triangle_pairs -= o.triangle_pairs;
    separating_pairs -= o.separating_pairs;
    return *this;
}

FirstContact first_contact(const InterferenceModel& a, const Motion& motion_a,
                           const InterferenceModel& b, const Motion& motion_b,
                           const FirstContactOptions& options) {
    ModelEvents events_a(detail::data_of(a));
    ModelEvents events_b(detail::data_of(b));
    QueryOfModels query(a, events_a, motion_a, b, events_b, motion_b, options.leave_out_receding);
    query.run(options.event);
    detail::counters_of_thread<FirstContactCounters> += query.counters();
    return {query.time(), std::move(query).witnesses(), query.at_start()};
}

}  // namespace trisect
