// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/hierarchies/pairs/all_pairs.h>

namespace trisect::hierarchies {

namespace {

class AllPairs final : public PairStructure {
public:
    using PairStructure::PairStructure;
    std::string_view name() const override { return "all-pairs"; }
    BuildReport build_report() const override { return {}; }

protected:
    void update(CostCounters&) override {}
    bool find_candidates(PairVisit visit, CostCounters&) override {
        for (std::uint32_t j = 0; j < model_b().triangle_count(); ++j)
            for (std::uint32_t i = 0; i < model_a().triangle_count(); ++i)
                if (visit(i, j)) return true;
        return false;
    }
    void find_near(double limit, NearVisit visit, CostCounters&) override {
        for (std::uint32_t j = 0; j < model_b().triangle_count(); ++j)
            for (std::uint32_t i = 0; i < model_a().triangle_count() && limit >= 0; ++i)
                limit = visit(i, j);
    }
};

}  // namespace

std::unique_ptr<PairStructure> make_all_pairs(const InterferenceModel& a,
                                              const InterferenceModel& b) {
    return std::make_unique<AllPairs>(a, b);
}

}  // namespace trisect::hierarchies
