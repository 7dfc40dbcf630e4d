// SPDX-License-Identifier: Apache-2.0
//
// The placement is worked out once for all structures, in doubles with certified errors. Where the
// poses are beyond doubles, nothing but exact tests decides, and every pair is visited.

#include <trisect/bsp/hierarchies/pairs/pair_structure.h>

#include <utility>

#include <trisect/bsp/hierarchies/pairs/deformation.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/error.h>

namespace trisect::hierarchies {

PairStructure::PairStructure(const InterferenceModel& a, const InterferenceModel& b)
    : a_(a), b_(b) {
    if (a.is_empty() || b.is_empty())
        throw UsageError("a structure over two solids needs solids that are not empty");
}

PairStructure::~PairStructure() = default;

void PairStructure::place(const Pose& a, const Pose& b, CostCounters& counters) {
    pose_a_ = a;
    pose_b_ = b;
    placed_ = true;
    placement_.to_a =
        detail::approximate_map(a, data_a().brep.lattice(), b, data_b().brep.lattice());
    if (!placement_.to_a.is_usable()) {
        const detail::RelativePose exact =
            detail::relative_pose(a, data_a().brep.lattice(), b, data_b().brep.lattice());
        if (exact.has_doubles()) placement_.to_a = detail::approximate_map(exact);
    }
    placement_.b_error = placement_.to_a.error_below(data_b().largest, data_b().position_error);
    if (has_doubles()) update(counters);
}

bool PairStructure::deform_b(const InterferenceModel& b, CostCounters& counters) {
    const auto now = same_triangles(b_, b);
    if (!now) return false;
    const InterferenceModel before = std::exchange(b_, b);
    if (!refit_b(*now, counters)) {
        b_ = before;
        return false;
    }
    placed_ = false;
    return true;
}

bool PairStructure::candidates(PairVisit visit, CostCounters& counters) {
    if (!placed_) place(Pose(), Pose(), counters);
    if (has_doubles()) return find_candidates(visit, counters);
    for (std::uint32_t i = 0; i < a_.triangle_count(); ++i)
        for (std::uint32_t j = 0; j < b_.triangle_count(); ++j)
            if (visit(i, j)) return true;
    return false;
}

std::optional<Relation> PairStructure::early_relation(CostCounters& counters) {
    if (!placed_) place(Pose(), Pose(), counters);
    return has_doubles() ? find_early_relation(counters) : std::nullopt;
}

void PairStructure::near(double limit, NearVisit visit, CostCounters& counters) {
    if (!placed_) place(Pose(), Pose(), counters);
    if (has_doubles()) {
        find_near(limit, visit, counters);
        return;
    }
    for (std::uint32_t i = 0; i < a_.triangle_count(); ++i)
        for (std::uint32_t j = 0; j < b_.triangle_count(); ++j) (void)visit(i, j);
}

std::vector<VolumeOutline> PairStructure::outlines_of_a(unsigned levels) {
    return has_doubles() ? list_outlines(false, levels) : std::vector<VolumeOutline>();
}

std::vector<VolumeOutline> PairStructure::outlines_of_b(unsigned levels) {
    return has_doubles() ? list_outlines(true, levels) : std::vector<VolumeOutline>();
}

}  // namespace trisect::hierarchies
