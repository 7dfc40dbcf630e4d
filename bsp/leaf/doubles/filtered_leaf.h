// SPDX-License-Identifier: Apache-2.0
//
// Filtered leaf arrangement for polygons in general position.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/leaf/doubles/filtered_cutting.h>
#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/bsp/leaf/doubles/filtered_pairs.h>
#include <trisect/bsp/leaf/doubles/filtered_windings.h>
#include <trisect/bsp/leaf/leaf_arrangement.h>
#include <trisect/bsp/leaf/leaf_formula.h>

namespace trisect::detail {

/// Arranges leaves of facets of embedded operands, whole ones or fragments, where no two facets
/// coincide and no edge runs along another operand's facet. Most leaves of meshes are of that
/// kind. Keeps its memory from leaf to leaf; what it returns depends on the problem alone.
///
/// Where polygons are not needed yet and crossings are collected, facets that something crosses in
/// the cell are left out: these, and the operands that contain
/// them, are added to the crossings, and their
/// numbers to `seen` if the formula has more than two operands.
///
/// Not for leaves of another kind, nor where doubles cannot decide.
class FilteredLeaf final : public LeafArrangement {
private:
    [[nodiscard]] std::optional<LeafResult> try_to_arrange(const LeafProblem& problem,
                                                           LeafFindings& findings) override;
    [[nodiscard]] bool arrange_listed();
    void undo();
    void start_covers();
    [[nodiscard]] bool add_covers(LeafIndex item);
    [[nodiscard]] bool is_crossed_inside(LeafIndex item) const;
    [[nodiscard]] std::size_t slot_of(std::size_t operand) const {
        return static_cast<std::size_t>(facets_.problem().operands[operand].slot);
    }
    void emit(LeafIndex item, const FilteredCutting::Result& result);

    FilteredFacets facets_;
    FilteredPairs pairs_;
    FilteredWindings windings_;
    FilteredCutting cutting_;
    LeafFormula formula_;
    LeafFindings* findings_ = nullptr;
    bool defers_ = false;      // facets that are crossed are not cut
    std::size_t crossed_ = 0;  // facets
    // What there was of findings before the leaf.
    std::size_t covers_before_ = 0;
    std::size_t seen_before_ = 0;
    // By operand, where crossings are collected: its winding number where it contains nothing, and
    // its slot.
    std::vector<int> open_;
    std::vector<std::uint32_t> slots_;
};

}  // namespace trisect::detail
