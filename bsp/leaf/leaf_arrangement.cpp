// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/leaf_arrangement.h>

#include <trisect/bsp/cells/polygon_in_cell.h>

namespace trisect::detail {

void LeafFindings::note_uncertain(const LeafProblem& problem) {
    if (!crossings) return;
    for (const LeafOperand& o : problem.operands)
        for (const PolygonRef& r : o.polygons) note_uncertain(o.slot, r.facet);
}

std::optional<LeafResult> LeafArrangement::arrange(const LeafProblem& problem,
                                                   LeafFindings& findings) {
    const EvaluateStats before = findings.stats;
    out_.clear();
    try {
        auto result = try_to_arrange(problem, findings);
        if (!result) findings.stats = before;
        return result;
    } catch (...) {
        end_fragments(out_);  // made before memory ended
        throw;
    }
}

std::vector<PolygonRef> LeafArrangement::listed() {
    std::vector<PolygonRef> list(out_.begin(), out_.end());
    out_.clear();
    return list;
}

}  // namespace trisect::detail
