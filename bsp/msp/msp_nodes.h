// SPDX-License-Identifier: Apache-2.0
//
// NodeList: the nodes of an MspTree under construction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/msp_tree.h>
#include <trisect/kernel/error.h>

namespace trisect::detail::msp {

/// Which child of which node something will be; the root without a node.
struct Slot {
    MspTree::Ref MspTree::Node::*child = nullptr;
    std::uint32_t node = 0;
};

/// Children have larger numbers than their parents.
class NodeList {
public:
    /// Adds a node whose children are not known yet, and makes it that child.
    std::uint32_t add(int dimension, std::uint32_t plane, const Slot& slot) {
        const std::size_t id = nodes_.size();
        if (id >= MspTree::Ref::limit) throw LimitError("MSP tree: more than 2^29 nodes");
        nodes_.push_back({plane, {}, {}, {}});
        dimensions_.push_back(static_cast<std::uint8_t>(dimension));
        set(slot, MspTree::Ref::node(id));
        return static_cast<std::uint32_t>(id);
    }
    void set(const Slot& slot, MspTree::Ref ref) {
        if (slot.child == nullptr) {
            root_ = ref;
        } else {
            nodes_[slot.node].*slot.child = ref;
        }
    }

    [[nodiscard]] MspTree::Ref root() const { return root_; }
    [[nodiscard]] const std::vector<MspTree::Node>& nodes() const { return nodes_; }
    [[nodiscard]] const std::vector<std::uint8_t>& dimensions() const { return dimensions_; }

private:
    std::vector<MspTree::Node> nodes_;
    std::vector<std::uint8_t> dimensions_;
    MspTree::Ref root_;
};

}  // namespace trisect::detail::msp
