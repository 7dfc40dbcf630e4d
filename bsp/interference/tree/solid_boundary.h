// SPDX-License-Identifier: Apache-2.0
//
// SolidBoundary: a solid's cell tree as a tree of oriented boxes.
#pragma once

#include <array>
#include <cstdint>
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

    [[nodiscard]] const IndexBase& base() const { return base_; }
    [[nodiscard]] bool is_empty() const { return boxes.is_empty(); }

    /// Where a triangle is from.
    struct Origin {
        const LeafBoxes* leaf = nullptr;
        std::uint32_t place = 0;  ///< in the order of the leaf's tree
        bool turned = false;      ///< the leaf is read as that of a complement

        [[nodiscard]] PolygonId polygon() const {
            return {&leaf->leaf(), leaf->polygon_of(place), turned};
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

    /// The numbers of all triangles, every node being made now: [0, what is returned).
    [[nodiscard]] std::uint32_t open_all() const;

    /// A leaf of the cell tree that lists something, with its cell.
    struct LeafAt {
        const CellNode* node = nullptr;
        Cell cell;
        bool turned = false;
        [[nodiscard]] const LeafBoxes& boxes() const { return leaf_boxes(*node, cell); }
    };
    /// What is below a box: the one leaf of the cell tree, or null where there is an inner node of
    /// it. \pre the box is one of the upper ones
    [[nodiscard]] const LeafAt* leaf_below(ObbId id) const;
    /// Whether the box is that of a node of the cell tree.
    [[nodiscard]] bool is_upper(ObbId id) const { return part_of_[id.index] != none; }

private:
    // A node of the cell tree.
    struct Part {
        LeafAt at;  // or an inner node
        DoubleBox box;
    };
    // Of a leaf's tree, below a box that is still closed.
    struct Inner {
        std::uint32_t leaf = 0;  // of leaves_
        std::uint32_t node = 0;
    };
    // Triangles from `first` on are of this leaf.
    struct OpenedLeaf {
        const LeafBoxes* boxes = nullptr;
        bool turned = false;
    };
    static constexpr std::uint32_t none = 0xffffffffU;

    std::uint32_t open(ObbId id) override;
    void find_bounds();
    void set_frame();
    [[nodiscard]] Part part(const CellNode& node, const Cell& cell, bool turned) const;
    [[nodiscard]] std::uint32_t add_node(ObbId above);
    void open_cells(const Part& part, std::uint32_t node);
    void open_leaf(const Part& part, std::uint32_t node);
    void open_inner(const Inner& inner, std::uint32_t node);
    void put_box(std::uint32_t node, std::uint32_t lane, const DoubleBox& box);
    [[nodiscard]] bool put_box(std::uint32_t node, std::uint32_t lane, const ObbTree& tree,
                               const OrientedBox& box);

    IndexBase base_;
    std::vector<Part> parts_;
    std::vector<std::uint32_t> part_of_;  // of parts_, by the index of an ObbId; or none
    std::vector<OpenedLeaf> leaves_;
    std::vector<Inner> inner_;            // what is pending below boxes of leaves
    std::vector<std::uint32_t> leaf_of_;  // of leaves_, by triangle
    std::vector<std::uint32_t> place_of_;  // in the leaf's tree, by triangle
};

}  // namespace trisect::detail
