// SPDX-License-Identifier: Apache-2.0
//
// LeafBoxes: the triangles of a leaf in a tree of oriented boxes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <trisect/bsp/interference/boxes/triangle_filter.h>
#include <trisect/bsp/interference/tree/leaf_hull.h>
#include <trisect/bsp/interference/tree/leaf_tree.h>
#include <trisect/bsp/query/index/indexed_leaf.h>
#include <trisect/bsp/query/index/polygon_id.h>

namespace trisect::detail {

struct ClippedPolygon;

/// A point of the boundary: corner `corner` of the source's triangle, or, where that is none, the
/// first corner of the polygon's part in the cell.
struct BoundaryPoint {
    IndexPolygons::Id polygon = 0;
    std::uint8_t corner = none;
    std::array<double, 3> at{};  ///< within LeafBoxes::error()
    static constexpr std::uint8_t none = 3;
};

/// The polygons of a leaf of the cell tree as triangles, in boxes. Their parts in the open cell are
/// the boundary; so the parts of all leaves of a tree are all of it, and have at most points of
/// their sides in common. Threads may share it.
///
/// A triangle of a source that reaches out of the cell by little is in the boxes as a whole, and
/// clipped when a walk comes to it; other polygons are clipped at once. Corners of sources and of
/// fragments are not copied. 4 bytes a triangle and the boxes, where all are triangles of sources;
/// otherwise 8 more, and 24 for each corner of a polygon that was clipped at once.
class LeafBoxes final : public LeafTriangles {
public:
    using Id = IndexPolygons::Id;

    /// `leaf` must outlive this.
    explicit LeafBoxes(const IndexedLeaf& leaf);

    [[nodiscard]] const IndexedLeaf& leaf() const { return leaf_; }
    [[nodiscard]] const IndexPolygons& polygons() const { return leaf_.polygons(); }
    /// Empty when no polygon enters the cell.
    [[nodiscard]] const LeafTree& tree() const { return *tree_; }
    /// Of a corner; at most clipped_error times the largest coordinate of the leaf's polygons.
    [[nodiscard]] double error() const { return error_; }
    [[nodiscard]] std::uint32_t triangle_count() const { return tree_->size(); }
    [[nodiscard]] Id polygon_of(std::uint32_t triangle) const {
        return is_whole_ ? triangle : triangle_[triangle].polygon;
    }
    /// As a whole.
    [[nodiscard]] TriangleCorners corners_of(std::uint32_t triangle) const;
    /// Whether its part in the cell is still to be found.
    [[nodiscard]] bool is_clipped_late(std::uint32_t triangle) const;
    /// Appends its part in the cell, as triangles: itself, unless it is clipped late.
    void add_parts(std::uint32_t triangle, std::vector<TriangleCorners>& parts) const;
    /// Whether there is boundary in the cell.
    [[nodiscard]] bool has_parts() const;
    /// Whether nothing but one polygon is within `reach`, in each coordinate, of a point, and that
    /// certainly; false near the walls of the cell.
    [[nodiscard]] bool is_alone_at(Id polygon, const std::array<double, 3>& point,
                                   double reach) const;
    /// The polygons that doubles do not show to be farther than `reach`, in each coordinate, from
    /// a point.
    [[nodiscard]] std::vector<PolygonId> polygons_near(const std::array<double, 3>& point,
                                                       double reach, bool turned) const;
    /// A point of each connected piece of the boundary in the cell; of some pieces several. Made at
    /// the first call.
    [[nodiscard]] std::span<const BoundaryPoint> pieces() const;
    [[nodiscard]] std::size_t bytes() const;

private:
    // Of a polygon; where its corners are.
    struct Triangle {
        enum class Corners : std::uint32_t {
            Source,    // those of the source's triangle, which may reach out of the cell
            Fragment,  // the first of the fragment, number at - 1 and number `at`
            Strip,     // from `at` on in clipped_
            StripBack  // the same, in the other sense of turning
        };
        Id polygon = 0;
        Corners corners : 2 = Corners::Source;
        std::uint32_t at : 30 = 0;

        Triangle() = default;
        Triangle(Id id, Corners where, std::uint32_t place)
            : polygon(id), corners(where), at(place & ((1U << 30U) - 1)) {}
    };
    struct Triangles;
    // Of what the leaf lists along an axis.
    struct Extent {
        double lo = 0;  // walls
        double hi = 0;
        double little = 0;
    };

    void put_corners(std::span<const std::uint32_t> triangles,
                     std::span<std::array<double, 3>> corners) const override;
    void take_polygons();
    void take_polygon(Id id, const ClippedPolygon& part, Triangles& all);
    [[nodiscard]] std::array<Extent, 3> extents() const;
    [[nodiscard]] bool reaches_out_little(Id id, const std::array<Extent, 3>& extents) const;
    [[nodiscard]] double most_error() const;
    [[nodiscard]] LeafTree::Bounds bounds(std::uint32_t count) const;
    [[nodiscard]] std::vector<BoundaryPoint> find_pieces() const;

    const IndexedLeaf& leaf_;
    bool is_whole_ = true;            // the triangles are the polygons, of sources
    std::vector<Triangle> triangle_;  // if not
    std::vector<std::array<double, 3>> clipped_;
    double error_ = 0;
    std::unique_ptr<const LeafTree> tree_;
    mutable std::once_flag pieces_once_;
    mutable std::vector<BoundaryPoint> pieces_;
};

/// A fact of a leaf of the cell tree: its hull, and its boxes from when they are first needed.
class BoxedLeaf final : public NodeFact {
public:
    /// `leaf` must outlive this, and fills the cell.
    BoxedLeaf(const CellNode& leaf, const Cell& cell)
        : leaf_(leaf), cell_(cell), hull_(hull_of(leaf)) {}

    [[nodiscard]] const LeafHull& hull() const { return hull_; }
    [[nodiscard]] const LeafBoxes& boxes() const;
    /// Of memory, the boxes included where they are there. Not while others make them.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(*this) + (boxes_ != nullptr ? boxes_->bytes() : 0);
    }

private:
    const CellNode& leaf_;
    Cell cell_;
    LeafHull hull_;
    mutable std::once_flag once_;
    mutable std::unique_ptr<const LeafBoxes> boxes_;
};

/// Made when it is first needed. \pre the leaf lists something and fills the cell
[[nodiscard]] const BoxedLeaf& boxed_leaf(const CellNode& leaf, const Cell& cell);
/// Of the boxes that hang on a node now.
[[nodiscard]] std::size_t boxes_fact_bytes(const CellNode& node);

}  // namespace trisect::detail
