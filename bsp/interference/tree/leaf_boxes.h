// SPDX-License-Identifier: Apache-2.0
//
// LeafBoxes: the triangles of a leaf in a tree of oriented boxes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/bsp/interference/boxes/triangle_filter.h>
#include <trisect/bsp/query/index/indexed_leaf.h>

namespace trisect::detail {

/// A point of the boundary: corner `corner` of the source's triangle, or, where that is none, the
/// first corner of the polygon's part in the cell.
struct BoundaryPoint {
    IndexPolygons::Id polygon = 0;
    std::uint8_t corner = none;
    std::array<double, 3> at{};  ///< within LeafBoxes::error()
    static constexpr std::uint8_t none = 3;
};

/// A fact of a leaf of the cell tree: its polygons, clipped to its cell, as triangles. In the open
/// cell these are the boundary; so the triangles of all leaves of a tree are all of it, and have at
/// most points of their sides in common.
class LeafBoxes final : public NodeFact {
public:
    using Id = IndexPolygons::Id;

    /// `leaf` must outlive this.
    explicit LeafBoxes(const IndexedLeaf& leaf);

    [[nodiscard]] const IndexedLeaf& leaf() const { return leaf_; }
    [[nodiscard]] const IndexPolygons& polygons() const { return leaf_.polygons(); }
    /// Empty when no polygon enters the cell.
    [[nodiscard]] const ObbTree& tree() const { return tree_; }
    [[nodiscard]] const std::vector<std::array<double, 3>>& positions() const { return positions_; }
    /// Of a position; at most clipped_error times the largest coordinate of the leaf's polygons.
    [[nodiscard]] double error() const { return error_; }
    [[nodiscard]] std::size_t triangle_count() const { return tree_.order.size(); }
    /// By the number of a triangle in the order of the tree.
    [[nodiscard]] Id polygon_of(std::uint32_t place) const {
        const std::uint32_t t = tree_.order[place];
        return polygon_.empty() ? t : polygon_[t];
    }
    [[nodiscard]] TriangleCorners corners_of(std::uint32_t place) const {
        const auto& c = tree_.corners[place];
        return {positions_[c[0]], positions_[c[1]], positions_[c[2]]};
    }
    /// Whether nothing but one polygon is within `reach`, in each coordinate, of a point, and that
    /// certainly; false near the walls of the cell.
    [[nodiscard]] bool is_alone_at(Id polygon, const std::array<double, 3>& point,
                                   double reach) const;
    /// A point of each connected piece of the boundary in the cell; of some pieces several. Made at
    /// the first call.
    [[nodiscard]] std::span<const BoundaryPoint> pieces() const;
    [[nodiscard]] std::size_t bytes() const;

private:
    void take_mesh(const Source& source);
    void take_polygons();
    [[nodiscard]] std::vector<BoundaryPoint> find_pieces() const;

    const IndexedLeaf& leaf_;
    std::vector<std::array<double, 3>> positions_;
    std::vector<Id> polygon_;  // of triangles; none where the triangles are the polygons
    double error_ = 0;
    ObbTree tree_;
    mutable std::once_flag pieces_once_;
    mutable std::vector<BoundaryPoint> pieces_;
};

/// Made when it is first needed. \pre the leaf lists something and fills the cell
[[nodiscard]] const LeafBoxes& leaf_boxes(const CellNode& leaf, const Cell& cell);

}  // namespace trisect::detail
