// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/flat/flat_state.h>

#include <algorithm>
#include <utility>

#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/flat/flat_outline.h>

namespace trisect::detail {

std::shared_ptr<SolidState> flat_state(FlatRegion region, int axis, Coordinate low,
                                       Coordinate high) {
    auto state = std::make_shared<SolidState>();
    state->lattice = region.lattice;
    const auto is_whole = [](const FlatRegion::Line& l) {
        return l.a.u.is_whole() && l.a.v.is_whole() && l.b.u.is_whole() && l.b.v.is_whole();
    };
    state->whole = low.is_whole() && high.is_whole() &&
                   std::all_of(region.lines.begin(), region.lines.end(), is_whole);
    auto operand = std::make_shared<const FlatOperand>(std::move(region), &resolved_region);
    auto tree = std::make_shared<const LazyTree>(
        [operand, axis, low, high] { return flat_tree(operand->resolved(), axis, low, high); });
    state->form = FlatPrism{std::move(operand), axis, low, high, std::move(tree)};
    return state;
}

}  // namespace trisect::detail
