// SPDX-License-Identifier: Apache-2.0
//
// SolidBoundary: a solid's cell tree as a tree of oriented boxes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/interference/relation/boundary.h>
#include <trisect/bsp/interference/tree/leaf_boxes.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

/// The boundary of a solid for one question, or for many of one thread. The upper boxes are those
/// of the cell tree's nodes, along the axes; below are the boxes of leaves (LeafBoxes). Nodes are
/// put together when a walk comes to them, in the units of this tree; what they are made of is kept
/// with the solid. So making this costs what is new in the solid, and a walk what it comes to.
class SolidBoundary final : public Boundary, private ObbSource {
public:
    /// \throw UnsupportedError when the solid is unbounded; what evaluate() throws, for a solid
    /// that must be resolved.
    explicit SolidBoundary(const Solid& solid);
    SolidBoundary(const SolidBoundary&) = delete;
    SolidBoundary& operator=(const SolidBoundary&) = delete;
    ~SolidBoundary() override;

    /// Goes on with another solid, keeping the boxes of all nodes that both have: nearly all after
    /// a cut. Which boxes are other ones; or nothing, and nothing has changed, where a new boundary
    /// should be made: for a solid that is empty or not within the bounds of this one, or on
    /// another lattice, and when too much has been replaced.
    [[nodiscard]] std::optional<ChangedBoxes> replace(const Solid& solid);

    [[nodiscard]] const IndexBase& base() const { return *base_; }
    [[nodiscard]] bool is_empty() const { return boxes.is_empty(); }

    /// Where a triangle is from.
    struct Origin {
        const LeafBoxes* leaf = nullptr;
        std::uint32_t triangle = 0;  ///< of the leaf, as a whole
        bool turned = false;         ///< the leaf is read as that of a complement

        [[nodiscard]] PolygonId polygon() const {
            return {&leaf->leaf(), leaf->polygon_of(triangle), turned};
        }
    };
    [[nodiscard]] Origin origin(std::uint32_t triangle) const;

    [[nodiscard]] TriangleCorners corners_of(std::uint32_t triangle) const override {
        const auto& c = boxes.corners[triangle];
        return {positions[c[0]], positions[c[1]], positions[c[2]]};
    }
    [[nodiscard]] bool is_clear(std::uint32_t /*triangle*/) const override { return false; }
    [[nodiscard]] bool is_alone_at(std::uint32_t triangle, const std::array<double, 3>& point,
                                   double reach) const override;

    /// Boxes that contain the boundary, `most` of them or fewer; of a solid whose tree is one leaf,
    /// those of its points in the cells of a grid. O(most), or O(n) for the latter.
    [[nodiscard]] std::vector<DoubleBox> outline(std::size_t most) const;

    /// The numbers of all triangles, every node being made now: [0, what is returned).
    [[nodiscard]] std::uint32_t open_all() const;

    /// A leaf of the cell tree that lists something, with its cell.
    struct LeafAt {
        const CellNode* node = nullptr;
        Cell cell;
        bool turned = false;
        [[nodiscard]] const BoxedLeaf& boxed() const { return boxed_leaf(*node, cell); }
    };
    /// The node of the cell tree that a box is around. \pre one of the upper boxes
    [[nodiscard]] const LeafAt& node_of(ObbId id) const { return parts_[part_of_[id.index]].at; }
    /// The leaf of which a box is the hull; null for boxes above. \pre one of these
    [[nodiscard]] const LeafAt* leaf_of_hull(ObbId id) const {
        const Part& p = parts_[part_of_[id.index]];
        return p.is_hull ? &p.at : nullptr;
    }

private:
    // A node of the cell tree.
    struct Part {
        LeafAt at;  // or an inner node
        DoubleBox box;
        bool is_hull = false;  // of a leaf, after its bounds
        [[nodiscard]] bool is_empty() const {
            return box.lo[0] > box.hi[0] || box.lo[1] > box.hi[1] || box.lo[2] > box.hi[2];
        }
    };
    // What is below a box of a leaf that is still closed.
    struct Inner {
        std::uint32_t leaf = 0;  // of leaves_
        const LeafTree::Node* node = nullptr;
        std::uint32_t lane = 0;
    };
    struct OpenedLeaf {
        const LeafBoxes* boxes = nullptr;
        bool turned = false;
    };
    struct TriangleOf {
        std::uint32_t leaf = 0;  // of leaves_
        std::uint32_t triangle = 0;
    };
    // Of the arrays that grow with what is opened.
    struct Memory {
        std::vector<ObbNode> nodes;
        std::vector<std::uint32_t> parent;
        std::vector<std::uint32_t> order;
        std::vector<std::array<std::uint32_t, 3>> corners;
        std::vector<std::array<double, 3>> positions;
        std::vector<Part> parts;
        std::vector<std::uint32_t> part_of;
        std::vector<OpenedLeaf> leaves;
        std::vector<Inner> inner;
        std::vector<TriangleOf> triangle_of;
        std::vector<TriangleCorners> clipped;

        void clear();
        [[nodiscard]] std::size_t bytes() const;
    };
    static constexpr std::uint32_t none = 0xffffffffU;

    void swap_with(Memory& memory) noexcept;
    std::uint32_t open(ObbId id) override;
    void find_bounds();
    void set_frame();
    [[nodiscard]] static Part part(const IndexBase& base, const CellNode& node, const Cell& cell,
                                   bool turned);
    [[nodiscard]] Part part(const CellNode& node, const Cell& cell, bool turned) const {
        return part(*base_, node, cell, turned);
    }
    void update(ObbId id, const Part& next, ChangedBoxes& changed);
    [[nodiscard]] bool update_cells(std::uint32_t node, const Part& next, ChangedBoxes& changed);
    void drop(std::uint32_t node, ChangedBoxes& changed);
    [[nodiscard]] std::uint32_t add_node(ObbId above);
    void open_cells(const Part& part, std::uint32_t node);
    void open_hull(const Part& part, std::uint32_t node);
    void open_leaf(const Part& part, std::uint32_t node);
    void take_node(std::uint32_t leaf, const LeafTree::Node& from, std::uint32_t node);
    void take_few(std::uint32_t leaf, std::span<const std::uint32_t> triangles, std::uint32_t node);
    void put_lane(const LeafTree& tree, const ObbNode& from, std::uint32_t node,
                  std::uint32_t lane);
    void put_box(std::uint32_t node, std::uint32_t lane, const DoubleBox& box);
    [[nodiscard]] bool put_box(std::uint32_t node, std::uint32_t lane,
                               const std::array<double, 3>& origin, double unit,
                               const OrientedBox& box);
    std::uint32_t add_triangle(std::uint32_t leaf, std::uint32_t triangle,
                               const TriangleCorners& corners);

    std::unique_ptr<const IndexBase> base_;
    std::uint32_t dropped_ = 0;  // nodes that are no more
    std::vector<Part> parts_;
    std::vector<std::uint32_t> part_of_;  // of parts_, by the index of an ObbId; or none
    std::vector<OpenedLeaf> leaves_;
    std::vector<Inner> inner_;              // what is pending below boxes of leaves
    std::vector<TriangleOf> triangle_of_;   // of leaves, by the numbers here
    std::vector<TriangleCorners> clipped_;  // for one node
};

}  // namespace trisect::detail
