// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/leaf_work.h>

#include <algorithm>
#include <utility>

namespace trisect::detail {

void LeafWork::start(const LeafProblem& leaf, EvaluateStats& counters) {
    problem = &leaf;
    stats = &counters;
    bench.clear();
    items.clear();
    pieces.clear();
    steps.clear();
    incomplete.clear();
    const Box cell = leaf.cell.lattice_box();
    for (std::size_t o = 0; o < leaf.operands.size(); ++o) {
        const LeafOperand& operand = leaf.operands[o];
        for (const PolygonRef& ref : operand.polygons) {
            LeafItem item;
            item.ref = ref;
            item.ref.flipped = ref.flipped != operand.flipped;
            item.orientation = item.ref.flipped ? -1 : 1;
            item.operand = static_cast<LeafIndex>(o);
            item.shape = bench.polygon(ref);
            if (item.shape.is_empty()) item.shape = bench.clipped(item.shape, ref.box(), leaf.cell);
            // A cell without lattice points still has an inside: keep one unit around it.
            item.box = ref.box();
            for (std::size_t k = 0; k < 3; ++k) {
                item.box.lo[k] = std::max(item.box.lo[k], cell.lo[k] - 1);
                item.box.hi[k] = std::min(item.box.hi[k], cell.hi[k] + 1);
            }
            if (!item.shape.is_empty()) items.push_back(std::move(item));
        }
    }
}

std::vector<int> LeafWork::step_of(LeafIndex i) const {
    std::vector<int> step(problem->operands.size(), 0);
    step[u(item(i).operand)] += item(i).orientation;
    return step;
}

}  // namespace trisect::detail
