// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/enclosed_contact.h>

#include <trisect/bsp/interference/approach/enclosed_query.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/diagnostics.h>

namespace trisect {

namespace {

class EnclosedQueryOfModels final : public detail::EnclosedQuery {
public:
    EnclosedQueryOfModels(const InterferenceModel& a, const EnclosedMotion& motion_a,
                          const InterferenceModel& b, const EnclosedMotion& motion_b,
                          const EnclosedContactOptions& options)
        : EnclosedQuery(detail::data_of(a), motion_a, detail::data_of(b), motion_b, options),
          a_(a),
          b_(b) {}

protected:
    [[nodiscard]] Relation relation_at(const Pose& pose_a, const Pose& pose_b) override {
        return interfere(a_, pose_a, b_, pose_b).relation;
    }
    [[nodiscard]] const BrepIndex& index_a() override { return a_.index(); }
    [[nodiscard]] const BrepIndex& index_b() override { return b_.index(); }

private:
    const InterferenceModel& a_;
    const InterferenceModel& b_;
};

}  // namespace

EnclosedContact enclosed_first_contact(const InterferenceModel& a, const EnclosedMotion& motion_a,
                                       const InterferenceModel& b, const EnclosedMotion& motion_b,
                                       const EnclosedContactOptions& options) {
    EnclosedQueryOfModels query(a, motion_a, b, motion_b, options);
    EnclosedContact result = query.run();
    if (const auto& c = query.crossing())
        result.witnesses.push_back(
            {detail::data_of(a).triangles[c->a].face, detail::data_of(b).triangles[c->b].face});
    detail::counters_of_thread<FirstContactCounters> += query.counters();
    return result;
}

}  // namespace trisect
