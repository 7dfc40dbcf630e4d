// SPDX-License-Identifier: Apache-2.0
//
// CrossedFacets: pairs of facets of two outlined solids that cross.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/leaf/doubles/single_box.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/outlines/part_halves.h>
#include <trisect/bsp/many_meshes/places_in_cells.h>
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
    /// False when a cell cannot be listed in doubles. Counts. `threads`: 1, or 0 for all; what is
    /// found is the same. Many facets go to all in any case.
    [[nodiscard]] bool find(const OutlinedSolid& first, const OutlinedSolid& second,
                            const Places& near, std::uint32_t threads, EvaluateStats& stats);
    using Pairs = PoolVector<CrossedFacets>;
    /// Each pair once, in lists that follow each other.
    [[nodiscard]] std::span<const Pairs> pairs() const { return found_; }
    [[nodiscard]] std::size_t pair_count() const;

private:
    // A facet, with the box of what may lie in the cell.
    class Item {
    public:
        Item() = default;
        Item(const SingleBox& box, std::uint32_t place) : box_(box) {
            box_.lo[3] = std::bit_cast<float>(finite + place);
        }
        [[nodiscard]] const SingleBox& box() const { return box_; }
        void cut(const SingleBox& box) {
            const float place = box_.lo[3];
            const float shared = box_.down[3];
            box_.cut(box);
            box_.lo[3] = place;
            box_.down[3] = shared;
        }
        [[nodiscard]] std::uint32_t place() const {
            return std::bit_cast<std::uint32_t>(box_.lo[3]) - finite;
        }
        // Whether another cell may have it, too.
        [[nodiscard]] bool is_shared() const { return box_.down[3] != 0; }
        void set_shared(bool shared) { box_.down[3] += shared ? 1.0F : 0.0F; }
        // Whether it is one of two of its facet.
        [[nodiscard]] bool is_half() const { return box_.down[3] >= half; }
        void set_half() { box_.down[3] += half; }

    private:
        // Added to a place: so it is the bits of a finite number, as there are fewer than 2^29.
        static constexpr std::uint32_t finite = std::uint32_t{1} << 30;
        static constexpr float half = 0x1p20F;  // more than cells are divided
        SingleBox box_;
    };
    // Items lie behind those of the cell that it is a part of.
    struct Cell {
        SingleBox bounds;
        SingleBox reach;  // of what may cross
        std::array<std::size_t, 2> first{};
        std::array<std::size_t, 2> end{};
        bool stalled = false;
        [[nodiscard]] std::size_t count(std::size_t solid) const {
            return end[solid] - first[solid];
        }
        [[nodiscard]] std::size_t count() const { return count(0) + count(1); }
        [[nodiscard]] std::uint64_t pair_count() const {
            return std::uint64_t{count(0)} * count(1);
        }
    };
    struct Splitter {
        std::size_t axis = 0;
        float at = 0;
        double part_left = 1;  ///< of the pairs, on both sides together
    };
    // A cell with items of its own.
    struct CellOfItems {
        Cell cell;
        std::array<PoolVector<Item>, 2> items;
    };
    [[nodiscard]] bool solve(Cell& cell);
    [[nodiscard]] bool begin(Cell& cell);
    [[nodiscard]] bool solve_begun(Cell& cell);
    [[nodiscard]] bool are_few(const Cell& cell) const;
    [[nodiscard]] bool solve_in_parts(Cell& cell);
    void list_parts(Cell& cell, std::size_t most, std::vector<CellOfItems>& out);
    template <class Solve>
    [[nodiscard]] bool find_on_threads(std::size_t cells, const Solve& solve);
    [[nodiscard]] bool leave_out(Cell& cell);
    [[nodiscard]] std::size_t leave_out(std::size_t solid, std::span<Item> items,
                                        const SingleBox& reach) const;
    [[nodiscard]] Item* list(std::size_t solid, std::uint32_t place, Item* next) const;
    void draw_in(std::size_t solid, Item& item, const SingleBox& reach) const;
    [[nodiscard]] Splitter splitter_of(const Cell& cell) const;
    [[nodiscard]] bool divide(const Cell& cell, const Splitter& splitter);
    // What is below, and what is above.
    [[nodiscard]] std::array<Cell, 2> halves_of(const Cell& cell, const Splitter& splitter);
    [[nodiscard]] bool find_in_cells(const Places& near);
    [[nodiscard]] bool solve_cell(const PlacesInCells& cells, std::size_t number);
    void take_from(CrossedFacetsFinder& other);
    void take_halves(std::size_t solid, Cell& below, Cell& above, const Cell& cell,
                     const Splitter& splitter);
    [[nodiscard]] bool compare(const Cell& cell);
    void leave_out_planes(const Cell& cell);
    [[nodiscard]] std::span<Item> items_of(const Cell& cell, std::size_t solid) {
        return std::span(items_[solid]).subspan(cell.first[solid], cell.count(solid));
    }
    [[nodiscard]] std::span<const Item> items_of(const Cell& cell, std::size_t solid) const {
        return std::span(items_[solid]).subspan(cell.first[solid], cell.count(solid));
    }
    // The box of all; two at once, neither of which waits for the one before it.
    [[nodiscard]] static SingleBox box_of(std::span<const Item> items) {
        SingleBox out = SingleBox::none();
        SingleBox other = SingleBox::none();
        std::size_t i = 0;
        for (; i + 2 <= items.size(); i += 2) {
            out.add(items[i].box());
            other.add(items[i + 1].box());
        }
        if (i < items.size()) out.add(items[i].box());
        out.add(other);
        return out;
    }
    using Pair = std::array<Item, 2>;
    [[nodiscard]] Pair pair_of(const Cell& cell, const WholeFacetPairs::Places& places) const {
        return {items_[0][cell.first[0] + places[0]], items_[1][cell.first[1] + places[1]]};
    }
    void decide(const Cell& cell);
    [[nodiscard]] bool meets(const Pair& pair, const std::array<FacetCrossing::End, 2>& ends) const;
    void keep(const Pair& pair, const std::array<FacetCrossing::End, 2>& ends);

    const ManyMeshes& meshes_;
    const EvaluateSettings& options_;
    SpecialPosition& position_;
    SpecialPairs special_;
    std::array<const OutlinedSolid*, 2> solids_{};
    std::array<PartHalves, 2> halves_;
    SinglePlace place_;                      // where both are
    std::array<PoolVector<Item>, 2> items_;  // of a cell and of those that it is a part of
    std::vector<Pairs> found_{1};
    FlatMap known_;                         // those that were found, where there are several cells
    PoolVector<std::uint32_t> many_cells_;  // by number in found_, of those that may be found again
    bool is_of_many_ = false;               // in a cell of a grid
    EvaluateStats* stats_ = nullptr;
    WholeFacetPairs pairs_;
    std::vector<std::uint32_t> planes_;  // across axes, of items of the second list and the first
    std::array<std::vector<SpecialPairs::InCell>, 2> in_planes_;
};

}  // namespace trisect::detail
