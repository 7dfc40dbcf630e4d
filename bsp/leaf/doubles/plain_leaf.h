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
#include <trisect/bsp/leaf/doubles/plain_cutting.h>
#include <trisect/bsp/leaf/doubles/plain_facets.h>
#include <trisect/bsp/leaf/doubles/plain_pairs.h>
#include <trisect/bsp/leaf/doubles/plain_windings.h>
#include <trisect/bsp/leaf/leaf_formula.h>

namespace trisect::detail {

/// Arranges leaves of facets of embedded operands, whole ones or fragments, where no two facets
/// coincide and no edge runs along another operand's facet. Most leaves of meshes are of that
/// kind. Keeps its memory from leaf to leaf; what it returns depends on the problem alone.
class PlainLeaf {
public:
    /// Lists what bounds the result; `out` is empty before. False when the leaf is of another kind
    /// or doubles cannot decide; then `out` and `stats` are as before.
    [[nodiscard]] bool arrange(const LeafProblem& problem, EvaluateStats& stats,
                               std::vector<PolygonRef>& out);
    /// The same without the facets that something crosses in the cell: these and the operands that
    /// contain them are added to `crossings`, which has the operands of the formula, and their
    /// numbers to `seen` if the formula has more than two. Returns nothing for false, else how many
    /// of those facets there are.
    [[nodiscard]] std::optional<std::size_t> arrange_uncrossed(const LeafProblem& problem,
                                                               EvaluateStats& stats,
                                                               std::vector<PolygonRef>& out,
                                                               Crossings& crossings,
                                                               std::vector<std::uint32_t>& seen);

private:
    [[nodiscard]] bool arrange_listed(Crossings* crossings, EvaluateStats& stats,
                                      std::vector<PolygonRef>& out);
    [[nodiscard]] bool try_to_arrange(const LeafProblem& problem, Crossings* crossings,
                                      EvaluateStats& stats, std::vector<PolygonRef>& out);
    void start_covers(const Crossings* crossings);
    [[nodiscard]] bool add_covers(LeafIndex item, Crossings& crossings,
                                  std::vector<std::uint32_t>& seen);
    [[nodiscard]] bool is_crossed_inside(LeafIndex item) const;
    [[nodiscard]] std::size_t slot_of(std::size_t operand) const {
        return static_cast<std::size_t>(facets_.problem().operands[operand].slot);
    }
    void emit(LeafIndex item, const PlainCutting::Result& result, std::vector<PolygonRef>& out);

    PlainFacets facets_;
    PlainPairs pairs_;
    PlainWindings windings_;
    PlainCutting cutting_;
    LeafFormula formula_;
    std::size_t crossed_ = 0;  // facets
    std::vector<std::uint32_t>* seen_ = nullptr;
    // By operand, where crossings are collected: its winding number where it contains nothing, and
    // its slot.
    std::vector<int> open_;
    std::vector<std::uint32_t> slots_;
};

}  // namespace trisect::detail
