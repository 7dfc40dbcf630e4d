// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/tree/leaf_tree.h>

#include <utility>

#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

LeafTree::LeafTree(std::span<const std::array<double, 3>> positions, double error,
                   std::vector<std::array<std::uint32_t, 3>> triangles) {
    if (!triangles.empty()) parts_ = ObbParts(positions, error, std::move(triangles));
}

const LeafTree::Node& LeafTree::divide(const ObbParts::Part& part) const {
    check_stop(part.size());
    std::array<ObbParts::Part, 4> parts;
    const std::size_t count = parts_.divide(part, 1, parts);
    auto node = std::make_unique<Node>();
    close_lanes(node->boxes_, count);
    for (std::uint32_t i = 0; i < count; ++i) {
        parts_.put(parts[i], node->boxes_, i);
        node->begin_[i] = parts[i].begin;
        node->size_[i] = parts[i].size();
    }
    nodes_.push_back(std::move(node));
    return *nodes_.back();
}

const LeafTree::Node& LeafTree::root() const {
    if (const Node* const known = root_.load(std::memory_order_acquire)) return *known;
    const std::lock_guard lock(dividing_);
    if (const Node* const known = root_.load(std::memory_order_relaxed)) return *known;
    const Node& made = divide(parts_.whole());
    root_.store(&made, std::memory_order_release);
    return made;
}

// The frame is that of the box, whose floats are all that division looks at.
const LeafTree::Node& LeafTree::make_below(const Node& node, std::uint32_t lane) const {
    const std::lock_guard lock(dividing_);
    if (const Node* const known = node.below_[lane].load(std::memory_order_relaxed)) return *known;
    ObbParts::Part part{node.begin_[lane], node.begin_[lane] + node.size_[lane], {}};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            part.frame.axis[i][k] = static_cast<double>(node.boxes_.axis[i][k][lane]);
    const Node& made = divide(part);
    node.below_[lane].store(&made, std::memory_order_release);
    return made;
}

std::size_t LeafTree::bytes() const {
    const std::lock_guard lock(dividing_);
    return parts_.bytes() + nodes_.size() * (sizeof(Node) + sizeof(void*));
}

}  // namespace trisect::detail
