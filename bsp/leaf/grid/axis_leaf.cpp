// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/grid/axis_leaf.h>

#include <algorithm>

namespace trisect::detail {

namespace {

bool has_fractions(const LeafProblem& problem) {
    return std::ranges::any_of(problem.operands, [](const LeafOperand& o) {
        return std::ranges::any_of(o.polygons,
                                   [](const PolygonRef& r) { return !r.source->is_whole(); });
    });
}

}  // namespace

std::optional<LeafResult> AxisLeaf::try_to_arrange(const LeafProblem& problem,
                                                   LeafFindings& findings) {
    if (!has_fractions(problem)) return of_whole_.arrange(problem, findings);
    if (!of_fractions_) of_fractions_ = std::make_unique<AxisArrangement<Int128>>();
    return of_fractions_->arrange(problem, findings);
}

}  // namespace trisect::detail
