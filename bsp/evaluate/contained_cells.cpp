// SPDX-License-Identifier: Apache-2.0
//
// A cell within one operand of a union is done at once, whatever others have in it. But a facet
// that reaches out of it and bounds the result elsewhere is traced by all its crossings
// (facet_outline.cpp): where it comes out of the cell the other operands that contain it are
// needed.
//
// Where the result's part of such a facet ends, another one crosses it outside of all such cells,
// or there would be no end. So a facet that no leaf has seen crossed needs nothing from here, and
// most facets in such cells are of that kind.

#include <trisect/bsp/evaluate/contained_cells.h>

#include <algorithm>
#include <span>

#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/bsp/leaf/doubles/filtered_pairs.h>
#include <trisect/kernel/contract.h>

namespace trisect::detail {

void ContainedCells::add(const CellTask& task) {
    for (const CellOperand& o : task.operands) {
        if (o.size() == 0) continue;
        const PolygonList& names = o.node->polygons();
        for (const PackedBox& e : o.list()) facets_.push_back(e.id);
        operands_.push_back({o.slot, names.whole_source(), names.flipped(), o.complemented,
                             o.winding, facets_.size()});
    }
    cells_.push_back({task.cell, task.reference, operands_.size()});
}

void ContainedCells::append(const ContainedCells& part) {
    const std::size_t operands = operands_.size();
    const std::size_t facets = facets_.size();
    for (Covered c : part.cells_) {
        c.end += operands;
        cells_.push_back(c);
    }
    for (Operand o : part.operands_) {
        o.end += facets;
        operands_.push_back(o);
    }
    facets_.insert(facets_.end(), part.facets_.begin(), part.facets_.end());
}

void ContainedCells::compare(std::span<const std::uint32_t> seen, const EvaluateSettings& options,
                             EvaluateStats& stats, Crossings& crossings) const {
    if (crossings.operands.size() <= 2) return;
    std::vector<bool> is_seen(seen.empty() ? 0 : std::size_t{std::ranges::max(seen)} + 1);
    for (const std::uint32_t facet : seen) is_seen[facet] = true;
    const auto is_crossed = [&](std::uint32_t facet) {
        return facet < is_seen.size() && is_seen[facet];
    };
    add_crossings(is_crossed, options, stats, crossings);
    for (const FacetCrossing& c : crossings.pairs)
        for (const std::uint32_t facet : c.facets)
            if (!is_crossed(facet)) crossings.hidden.push_back(facet);
}

template <class IsCrossed>
void ContainedCells::add_crossings(const IsCrossed& is_crossed, const EvaluateSettings& options,
                                   EvaluateStats& stats, Crossings& crossings) const {
    FilteredFacets facets;
    FilteredPairs pairs;
    std::vector<std::uint8_t> marks;
    std::vector<PolygonRef> polygons;
    std::vector<LeafOperand> listed;
    std::size_t operand = 0;
    std::size_t first = 0;
    for (const Covered& c : cells_) {
        marks.clear();
        polygons.clear();
        bool any = false;
        const std::size_t first_operand = operand;
        for (; operand < c.end; ++operand) {
            const Operand& o = operands_[operand];
            for (; first < o.end; ++first) {
                marks.push_back(is_crossed(crossings.number_of(static_cast<std::size_t>(o.slot),
                                                               facets_[first]))
                                    ? 1
                                    : 0);
                any = any || marks.back() != 0;
                polygons.push_back({o.source, nullptr, facets_[first], o.flipped, false});
            }
        }
        if (!any) continue;
        listed.clear();
        std::size_t begin = 0;
        for (std::size_t i = first_operand; i < c.end; ++i) {
            const Operand& o = operands_[i];
            const std::size_t before = i == 0 ? 0 : operands_[i - 1].end;
            const std::size_t count = o.end - before;
            listed.push_back({o.slot, std::span(polygons).subspan(begin, count), o.complemented,
                              true, o.winding});
            begin += count;
        }
        const LeafProblem problem{c.cell, c.reference, listed, nullptr, &options};
        if (facets.list(problem) && pairs.relate_marked(facets, marks, stats)) {
            pairs.add_to(crossings, facets);
            continue;
        }
        for (const LeafOperand& o : listed)
            for (const PolygonRef& r : o.polygons)
                crossings.uncertain.push_back(
                    crossings.number_of(static_cast<std::size_t>(o.slot), r.facet));
    }
}

}  // namespace trisect::detail
