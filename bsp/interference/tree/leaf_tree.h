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
#include <vector>

#include <trisect/bsp/interference/boxes/obb_parts.h>
#include <trisect/bsp/interference/boxes/obb_tree.h>

namespace trisect::detail {

/// The boxes are those of an ObbTree over the same triangles, one triangle a leaf. Threads may
/// share it. Building one takes some ten nanoseconds a triangle; making the node below a box of n
/// triangles about 0.2 us times n, once.
class LeafTree {
public:
    /// Up to four boxes. Of a lane with one triangle nothing is below.
    class Node {
    public:
        /// Without children.
        [[nodiscard]] const ObbNode& boxes() const { return boxes_; }
        [[nodiscard]] bool is_used(std::uint32_t lane) const { return size_[lane] != 0; }
        [[nodiscard]] bool is_leaf(std::uint32_t lane) const { return size_[lane] == 1; }

    private:
        friend class LeafTree;
        ObbNode boxes_;
        std::array<std::uint32_t, 4> begin_{};
        std::array<std::uint32_t, 4> size_{};
        mutable std::array<std::atomic<const Node*>, 4> below_{};
    };

    LeafTree() = default;
    /// As ObbParts, but without triangles it is empty.
    LeafTree(std::span<const std::array<double, 3>> positions, double error,
             std::vector<std::array<std::uint32_t, 3>> triangles);

    [[nodiscard]] std::uint32_t size() const { return parts_.size(); }
    [[nodiscard]] const std::array<double, 3>& origin() const { return parts_.origin(); }
    [[nodiscard]] double unit() const { return parts_.unit(); }
    [[nodiscard]] double radius() const { return parts_.radius(); }
    /// Boxes that together contain all triangles. \pre size() != 0
    [[nodiscard]] const Node& root() const;
    /// \pre the lane is used and no leaf
    [[nodiscard]] const Node& below(const Node& node, std::uint32_t lane) const {
        const Node* const known = node.below_[lane].load(std::memory_order_acquire);
        return known != nullptr ? *known : make_below(node, lane);
    }
    /// \pre is_leaf(lane)
    [[nodiscard]] std::uint32_t triangle(const Node& node, std::uint32_t lane) const {
        return parts_.triangle(node.begin_[lane]);
    }
    [[nodiscard]] const std::array<std::uint32_t, 3>& corners(std::uint32_t triangle) const {
        return parts_.corners(triangle);
    }
    [[nodiscard]] std::size_t bytes() const;

private:
    [[nodiscard]] const Node& make_below(const Node& node, std::uint32_t lane) const;
    [[nodiscard]] const Node& divide(const ObbParts::Part& part) const;

    // Nodes are made under the lock. Within the range of a lane that has a node below, what is not
    // yet divided is permuted then; ranges of one triangle stay.
    mutable std::mutex dividing_;
    mutable ObbParts parts_;
    mutable std::vector<std::unique_ptr<const Node>> nodes_;
    mutable std::atomic<const Node*> root_{nullptr};
};

}  // namespace trisect::detail
