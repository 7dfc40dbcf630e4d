// SPDX-License-Identifier: Apache-2.0
//
// LeafTree: oriented boxes over triangles, divided when walks come to them.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <trisect/bsp/interference/boxes/obb_parts.h>
#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/bsp/interference/boxes/triangle_filter.h>

namespace trisect::detail {

/// The corners of the triangles of a LeafTree.
class LeafTriangles {
public:
    virtual ~LeafTriangles() = default;
    /// Three for each triangle.
    virtual void put_corners(std::span<const std::uint32_t> triangles,
                             std::span<std::array<double, 3>> corners) const = 0;
};

/// The boxes are those of an ObbTree over the same triangles, as far as some of the triangles show
/// the directions of all. Four bytes a triangle are kept, and the nodes that walks came to; corners
/// are taken from where they are. The lowest boxes, of up to `few` triangles together, are made
/// anew each time. Threads may share it. Making the node below a box of n triangles takes about
/// 0.2 us times n, once.
class LeafTree {
public:
    static constexpr std::uint32_t few = 4;

    /// Up to four boxes.
    class Node {
    public:
        /// Without children.
        [[nodiscard]] const ObbNode& boxes() const { return boxes_; }
        [[nodiscard]] bool is_used(std::uint32_t lane) const { return size_[lane] != 0; }
        /// Whether a lane has so few triangles that no node is below.
        [[nodiscard]] bool has_few(std::uint32_t lane) const { return size_[lane] <= few; }

    private:
        friend class LeafTree;
        ObbNode boxes_;
        std::array<std::uint32_t, 4> begin_{};
        std::array<std::uint32_t, 4> size_{};
        mutable std::array<std::atomic<const Node*>, 4> below_{};
    };

    /// Contains all triangles, with coordinates that are within an error of the exact ones.
    struct Bounds {
        std::array<double, 3> lo{};
        std::array<double, 3> hi{};
        double error = 0;
    };

    /// `triangles` must outlive this.
    LeafTree(const LeafTriangles& triangles, std::uint32_t count, const Bounds& bounds);

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(order_.size()); }
    [[nodiscard]] const std::array<double, 3>& origin() const { return origin_; }
    [[nodiscard]] double unit() const { return unit_; }
    [[nodiscard]] double radius() const { return radius_; }
    /// Boxes that together contain all triangles. \pre size() != 0
    [[nodiscard]] const Node& root() const;
    /// \pre the lane is used and has more than a few triangles
    [[nodiscard]] const Node& below(const Node& node, std::uint32_t lane) const {
        const Node* const known = node.below_[lane].load(std::memory_order_acquire);
        return known != nullptr ? *known : make_below(node, lane);
    }
    /// \pre the lane has few
    [[nodiscard]] std::span<const std::uint32_t> triangles(const Node& node,
                                                           std::uint32_t lane) const {
        return {order_.data() + node.begin_[lane], node.size_[lane]};
    }
    /// Boxes around other triangles, as long as they are within the bounds: four groups at most,
    /// the ends of which are given.
    [[nodiscard]] ObbNode boxes_of(std::span<const TriangleCorners> triangles,
                                   std::span<const std::uint32_t> ends) const;
    [[nodiscard]] std::size_t bytes() const;

private:
    [[nodiscard]] const Node& make_below(const Node& node, std::uint32_t lane) const;
    [[nodiscard]] const Node& divide(std::uint32_t begin, std::uint32_t size,
                                     const AreaFrame* frame) const;
    template <class Put>
    void put_parts(std::size_t triangles, ObbParts& parts, const Put& put) const;

    const LeafTriangles& triangles_;
    std::array<double, 3> origin_{};
    double unit_ = 1;
    double radius_ = 0;
    double slack_ = 0;
    // Nodes are made under the lock. Within the range of a lane that gets a node, the order changes
    // then; ranges of few triangles stay.
    mutable std::mutex dividing_;
    mutable std::vector<std::uint32_t> order_;
    mutable std::vector<std::unique_ptr<const Node>> nodes_;
    mutable std::atomic<const Node*> root_{nullptr};
};

}  // namespace trisect::detail
