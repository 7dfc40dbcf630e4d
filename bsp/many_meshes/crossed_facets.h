// SPDX-License-Identifier: Apache-2.0
//
// CrossedFacets: pairs of facets of two outlined solids that cross.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/special_pairs.h>
#include <trisect/bsp/many_meshes/whole_facet_pairs.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Two facets, by their places in either solid. They cross as whole facets; whether their parts do
/// is another question.
struct CrossedFacets {
    std::array<std::uint32_t, 2> places{};
    FacetCrossing crossing;
};

/// Finds such pairs among those whose parts have boxes that meet; keeps its memory.
class CrossedFacetsFinder {
public:
    CrossedFacetsFinder(const ManyMeshes& meshes, const EvaluateSettings& options,
                        SpecialPosition& special)
        : meshes_(meshes),
          options_(options),
          position_(special),
          special_(meshes, special),
          pairs_(meshes) {}

    /// Places of facets whose boxes meet that of the other solid, ascending.
    using Places = std::array<std::span<const std::uint32_t>, 2>;
    /// False when a cell cannot be listed in doubles. Counts.
    [[nodiscard]] bool find(const OutlinedSolid& first, const OutlinedSolid& second,
                            const Places& near, EvaluateStats& stats);
    /// Each pair once.
    [[nodiscard]] std::span<const CrossedFacets> pairs() const { return found_; }

private:
    struct Item {
        OutlineBox box;  ///< of what may lie in the cell
        std::uint32_t place = 0;
    };
    using Items = std::array<PoolVector<Item>, 2>;
    struct Cell {
        OutlineBox bounds;
        OutlineBox reach;  ///< of what may cross
        Items items;
        bool stalled = false;
    };
    struct Splitter {
        std::size_t axis = 0;
        double at = 0;
        double part_left = 1;  ///< of the pairs, on both sides together
        std::array<std::array<std::size_t, 2>, 2> counts{};  ///< of items below and above, by solid
    };
    [[nodiscard]] bool solve(Cell& cell);
    [[nodiscard]] bool leave_out(Cell& cell) const;
    void draw_in(std::size_t solid, Item& item, const OutlineBox& reach) const;
    [[nodiscard]] static Splitter splitter_of(const Cell& cell);
    [[nodiscard]] bool divide(Cell& cell, const Splitter& splitter);
    [[nodiscard]] bool solve_both(std::array<Cell, 2>& cells);
    void add(const CrossedFacetsFinder& other);
    [[nodiscard]] bool compare(const Cell& cell);
    void leave_out_planes(const Cell& cell);
    [[nodiscard]] static std::array<std::uint32_t, 2> places_of(
        const Cell& cell, const WholeFacetPairs::Places& pair) {
        return {cell.items[0][pair[0]].place, cell.items[1][pair[1]].place};
    }
    void decide(const Cell& cell);
    void keep(const Cell& cell, const std::array<std::uint32_t, 2>& places,
              const std::array<FacetCrossing::End, 2>& ends);

    const ManyMeshes& meshes_;
    const EvaluateSettings& options_;
    SpecialPosition& position_;
    SpecialPairs special_;
    std::array<const OutlinedSolid*, 2> solids_{};
    PoolVector<CrossedFacets> found_;
    FlatMap known_;  // those that were found, where there are several cells
    PoolVector<std::array<std::uint32_t, 2>> all_known_;
    bool is_shared_ = false;  // among threads
    EvaluateStats* stats_ = nullptr;
    WholeFacetPairs pairs_;
    std::vector<std::uint32_t> planes_;  // across axes, of items of the second list and the first
    std::array<std::vector<SpecialPairs::InCell>, 2> in_planes_;
};

}  // namespace trisect::detail
