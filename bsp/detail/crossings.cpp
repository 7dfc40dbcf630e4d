// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/crossings.h>

#include <algorithm>

#include <trisect/bsp/detail/solid_state.h>

namespace trisect::detail {

std::optional<Crossings> crossings_of(const Residual& formula,
                                      std::span<const std::shared_ptr<const SolidState>> states) {
    if (states.size() != 2) return std::nullopt;
    Crossings out;
    for (std::size_t i = 0; i < 2; ++i) {
        const CellRef& root = states[i]->root;
        const PolygonList& polygons = root.node->polygons();
        if (!root.node->is_leaf() || !polygons.has_all_facets() || !states[i]->embedded ||
            polygons.whole_source()->is_half_space())
            return std::nullopt;
        Crossings::Operand& o = out.operands[i];
        o.serial = polygons.whole_source()->serial();
        o.flipped = polygons.flipped() != root.complemented;
        const auto result = [&](int own, int other) {
            SlotValues values(2);
            values[i] = static_cast<std::int8_t>(own);
            values[1 - i] = static_cast<std::int8_t>(other);
            return value_of(formula, values);
        };
        const bool outside = result(0, 0) != result(1, 0);
        if (outside == (result(0, 1) != result(1, 1))) return std::nullopt;
        o.keep = outside ? 0 : 1;
        o.inside_above = result(o.flipped ? 1 : 0, o.keep);
    }
    if (out.operands[0].serial == out.operands[1].serial) return std::nullopt;
    return out;
}

void Crossings::append(const Crossings& part) {
    pairs.insert(pairs.end(), part.pairs.begin(), part.pairs.end());
    for (std::size_t i = 0; i < 2; ++i)
        doubtful[i].insert(doubtful[i].end(), part.doubtful[i].begin(), part.doubtful[i].end());
}

void Crossings::arrange() {
    std::ranges::sort(pairs, {}, &FacetCrossing::facets);
    const auto same = [](const FacetCrossing& a, const FacetCrossing& b) {
        return a.facets == b.facets;
    };
    pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
    for (auto& facets : doubtful) {
        std::ranges::sort(facets);
        facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
    }
}

}  // namespace trisect::detail
