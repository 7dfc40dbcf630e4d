// SPDX-License-Identifier: Apache-2.0
//
// NativeTree: nodes of a tree in the order of a file.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>

namespace trisect::detail {

/// Views of a tree that outlives it. Deferred leaves are arranged on the way.
class NativeTree {
public:
    struct Node {
        const CellNode* node = nullptr;
        std::uint64_t above = 0;  ///< number of the node above the splitting plane
        std::uint64_t leaf = 0;   ///< the first leaf there; of a leaf its own number
    };

    NativeTree(const CellNode& root, bool refined);

    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
    [[nodiscard]] const std::vector<const CellNode*>& leaves() const { return leaves_; }
    /// By serial; sources of one serial by their first appearance.
    [[nodiscard]] const std::vector<const Source*>& sources() const { return sources_; }
    [[nodiscard]] const std::vector<const Fragment*>& fragments() const { return fragments_; }
    [[nodiscard]] std::uint64_t depth() const { return depth_; }
    [[nodiscard]] std::uint32_t number_of(const Source* source) const {
        return source_numbers_.at(source);
    }
    [[nodiscard]] std::uint32_t number_of(const Fragment* fragment) const {
        return fragment_numbers_.at(fragment);
    }

private:
    void visit(const CellNode& root, bool refined);
    void add_leaf(const CellNode& leaf);
    void add(const Source* source);
    void add(const Fragment* fragment);

    std::vector<Node> nodes_;
    std::vector<const CellNode*> leaves_;
    std::vector<const Source*> sources_;
    std::vector<const Fragment*> fragments_;
    std::unordered_map<const Source*, std::uint32_t> source_numbers_;
    std::unordered_map<const Fragment*, std::uint32_t> fragment_numbers_;
    std::uint64_t depth_ = 0;
};

}  // namespace trisect::detail
