// SPDX-License-Identifier: Apache-2.0
//
// Evaluation must know which facets cross and what the others are worth; where facets are cut only
// later operations in the same cell and queries care. Of a single operation all cutting would be in
// vain. A deferred leaf starts from the beginning, which takes no longer than the cutting itself.

#include <trisect/bsp/detail/deferred_leaf.h>

#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/detail/leaf_arrangement.h>
#include <trisect/bsp/detail/leaf_problem.h>

namespace trisect::detail {

PolygonList DeferredLeaf::arrange() const {
    std::array<std::vector<PolygonRef>, 2> refs;
    std::vector<LeafOperand> listed;
    for (std::size_t i = 0; i < 2; ++i) {
        refs[i].assign(operands[i].polygons.begin(), operands[i].polygons.end());
        listed.push_back({static_cast<std::int32_t>(i), refs[i], operands[i].flipped, true,
                          operands[i].winding});
    }
    EvaluateOptions options;
    options.winding = rule;
    SlotValues values(2, -1);
    EvaluateStats uncounted;
    thread_local LeafArranger arranger;
    LeafResult result =
        arranger.arrange({cell, reference, listed, formula.get(), &options}, values, uncounted);
    return PolygonList(std::move(result.polygons));
}

}  // namespace trisect::detail
