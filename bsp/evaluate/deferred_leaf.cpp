// SPDX-License-Identifier: Apache-2.0
//
// Evaluation must know which facets cross and what the others are worth; where facets are cut only
// later operations in the same cell and queries care. Of a single operation all cutting would be in
// vain. A deferred leaf starts from the beginning, which takes no longer than the cutting itself.

#include <trisect/bsp/cells/deferred_leaf.h>

#include <utility>
#include <variant>
#include <vector>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/evaluate/ways.h>

namespace trisect::detail {

PolygonList DeferredLeaf::arrange() const {
    std::vector<std::vector<PolygonRef>> refs(operands.size());
    std::vector<LeafOperand> listed;
    for (std::size_t i = 0; i < operands.size(); ++i) {
        const Operand& o = operands[i];
        refs[i].assign(o.polygons.begin(), o.polygons.end());
        listed.push_back({o.slot, refs[i], o.flipped, true, o.winding});
    }
    EvaluateOptions options;
    options.winding = rule;
    LeafFindings findings;
    thread_local LeafArrangers arrangers;
    LeafResult result =
        arrange_leaf({cell, reference, listed, formula.get(), &options}, arrangers, findings);
    return PolygonList(std::move(std::get<LeafPolygons>(result).polygons));
}

}  // namespace trisect::detail
