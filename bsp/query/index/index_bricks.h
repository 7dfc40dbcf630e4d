// SPDX-License-Identifier: Apache-2.0
//
// Division of grid cells into bricks, and leaves with their planes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <trisect/bsp/query/index/index_windings.h>
#include <trisect/bsp/query/index/indexed_leaf.h>

namespace trisect::detail {

/// Makes what is below one cell of a grid after the other.
class IndexBrickBuilder {
public:
    using Id = IndexPolygons::Id;
    using Low = std::array<std::uint32_t, 3>;

    /// Up to so many polygons a cell of the grid is not divided; twice as many at each level below,
    /// where fewer queries come and polygons crowd for a reason.
    static constexpr std::size_t leaf_polygons = 48;

    /// `margin`: in lattice units, by how much the grid's first and last cells may reach beyond it.
    /// `open`: polygons may go on beyond the grid, so its far corners are not known. All arguments
    /// must outlive the builder, but the grid.
    IndexBrickBuilder(const IndexPolygons& polygons, IndexCells& cells, const IndexGrid& grid,
                      double margin, bool open);

    /// The slot of a cell whose edge is 4^level finest cells, given what meets it and the winding
    /// number at its lower corner. Where a corner inside it is on a polygon it is a leaf without
    /// planes.
    [[nodiscard]] std::uint32_t make(const Low& low, int level, std::span<const Id> ids,
                                     std::int32_t winding);
    [[nodiscard]] std::size_t depth() const { return depth_; }

private:
    using Vector = std::array<double, 3>;
    // a x + b y + c z + d in the coordinates of a block, the largest of a, b, c is 1; or all 0.
    using Coefficients = std::array<double, 4>;

    // What is worked on at one level.
    struct Work {
        explicit Work(const IndexPolygons& polygons) : windings(polygons) {}
        Vector margin{};  // in cells of the block
        std::vector<BlockItem> items;
        std::vector<Coefficients> planes;
        std::vector<std::uint64_t> masks;
        std::vector<std::uint32_t> listed;
        std::array<std::uint32_t, 65> begin{};
        std::vector<Id> ids;
        std::vector<std::uint32_t> leaf_items;
        std::vector<float> rows;
        IndexWindings windings;
    };

    void gather(Work& w, const IndexBlock& block, std::span<const Id> ids) const;
    void gather_triangle(BlockItem& item, Coefficients& plane, const IndexBlock& block,
                         const Vector& scale) const;
    void gather_other(BlockItem& item, Coefficients& plane, const IndexBlock& block,
                      const Vector& scale) const;
    [[nodiscard]] std::uint64_t cells_of(const Work& w, std::size_t item) const;
    [[nodiscard]] std::size_t limit(int level) const;
    void sort_into_cells(Work& w) const;
    [[nodiscard]] bool is_worth_it(const Work& w) const;
    [[nodiscard]] bool sweep(Work& w, const IndexBlock& block, std::int32_t winding) const;
    [[nodiscard]] std::uint32_t make_alone(Work& w, const Low& low, int level,
                                           std::span<const Id> ids, std::int32_t winding);
    [[nodiscard]] std::uint32_t make_cells(Work& w, const Low& low, int level);
    [[nodiscard]] std::uint32_t make_leaf(Work& w, std::span<const std::uint32_t> items,
                                          const Low& cell, std::uint8_t known);
    [[nodiscard]] bool has_room_for_corners(std::uint32_t count) const;
    [[nodiscard]] static float write_corners(const Work& w, std::uint32_t count, const Low& cell,
                                             float* out);
    [[nodiscard]] std::uint32_t make_list(std::span<const Id> ids, std::int32_t winding);
    [[nodiscard]] std::uint8_t known_corners(const Low& low, int level) const;

    const IndexPolygons& polygons_;
    IndexCells& cells_;
    IndexGrid grid_;
    double margin_;
    bool open_;
    std::vector<std::unique_ptr<Work>> work_;  // by level
    std::size_t depth_ = 0;
    double copies_ = 1;  // of a polygon of the grid's cell, in bricks around the one that is made
};

}  // namespace trisect::detail
