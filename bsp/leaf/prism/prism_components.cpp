// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/prism/prism_components.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

std::uint32_t PrismComponents::root(std::uint32_t v) {
    while (root_[v] != v) v = root_[v] = root_[root_[v]];
    return v;
}

void PrismComponents::join(std::uint32_t v, std::uint32_t w) {
    const auto [low, high] = std::minmax({root(v), root(w)});
    root_[high] = low;
}

bool PrismComponents::list(const LeafProblem& problem, const PrismFacets& facets) {
    first_.clear();
    std::uint32_t points = 0;
    for (const LeafOperand& o : problem.operands) {
        first_.push_back(points);
        points += static_cast<std::uint32_t>(o.polygons[0].source->mesh().points.size());
    }
    root_.resize(points);
    std::iota(root_.begin(), root_.end(), 0U);
    const auto point = [&](LeafIndex operand, const PolygonRef& ref, int i) {
        return first_[as_index(operand)] + ref.source->corner_index(ref.facet, i);
    };
    for (const PrismCap& c : facets.caps()) {
        const std::uint32_t v = point(c.operand, c.ref, 0);
        for (int i = 1; i < 3; ++i) join(v, point(c.operand, c.ref, i));
    }
    positions_.clear();
    number_.assign(points, -1);
    of_cap_.clear();
    for (const PrismCap& c : facets.caps()) {
        std::int32_t& n = number_[root(point(c.operand, c.ref, 0))];
        if (n < 0) {
            n = static_cast<std::int32_t>(positions_.size());
            positions_.push_back(c.position);
        }
        of_cap_.push_back(n);
    }
    signs_.assign(positions_.size(), 0);
    of_side_face_.clear();
    edges_.clear();
    for (const PrismSideFace& w : facets.side_faces()) {
        std::array<std::uint32_t, 2> low{};
        std::array<std::uint32_t, 2> high{};
        for (std::size_t end = 0; end < 2; ++end) {
            const auto number = [&](const PrismCorner& c) {
                return first_[as_index(w.operand)] +
                       w.facets[end].source->corner_index(c.facet, c.corner);
            };
            low[end] = number(facets.corner_of(w, end, false));
            high[end] = number(facets.corner_of(w, end, true));
        }
        edges_.push_back(low);
        of_side_face_.push_back({number_[root(low[0])], number_[root(high[0])]});
        if (of_side_face_.back()[0] < 0 || of_side_face_.back()[1] < 0) return false;
    }
    return true;
}

}  // namespace trisect::detail
