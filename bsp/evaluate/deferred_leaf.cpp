// SPDX-License-Identifier: Apache-2.0
//
// Evaluation needs the facets that cross and what the others are worth; where facets are cut only
// later operations in the same cell and queries care. Of a single operation all cutting would be in
// vain. A deferred leaf starts from the beginning, which takes no longer than the cutting itself.

#include <trisect/bsp/cells/deferred_leaf.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/evaluate/leaf_arrangement.h>

namespace trisect::detail {

PolygonList DeferredLeaf::arrange() const {
    std::vector<std::vector<PolygonRef>> refs(operands.size());
    std::vector<LeafOperand> listed;
    std::int32_t slots = 0;
    for (std::size_t i = 0; i < operands.size(); ++i) {
        const Operand& o = operands[i];
        refs[i].assign(o.polygons.begin(), o.polygons.end());
        listed.push_back({o.slot, refs[i], o.flipped, true, o.winding});
        slots = std::max(slots, o.slot + 1);
    }
    EvaluateOptions options;
    options.winding = rule;
    SlotValues values(static_cast<std::size_t>(slots), -1);
    EvaluateStats uncounted;
    thread_local LeafArranger arranger;
    LeafResult result =
        arranger.arrange({cell, reference, listed, formula.get(), &options}, values, uncounted);
    return PolygonList(std::move(result.polygons));
}

}  // namespace trisect::detail
