// SPDX-License-Identifier: Apache-2.0
//
// Destruction of a graph of owning nodes, without recursion and without memory.
//
// Destroying the last owner of a chain of a hundred thousand nodes recurses a hundred thousand
// times when left to the language. The usual cure, a list of nodes to come, needs memory, in a
// destructor, perhaps just because there is none. Here the way back is kept in the nodes
// themselves: on the way down a parent takes the place of one of its grandchildren, which moves up
// to where the child was (the pointer reversal of Schorr and Waite 1967, for nodes that die).
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace trisect::detail {

/// Clears `children`. Nodes without other owners are destroyed; Node has a member `children` of the
/// same type. \pre the nodes do not change at the same time.
template <class Node>
void end_children(std::vector<std::shared_ptr<const Node>>& children) noexcept {
    const auto is_inner = [](const std::shared_ptr<const Node>& n) {
        return n != nullptr && n.use_count() == 1 && !n->children.empty();
    };
    // Nobody else sees a node that has one owner.
    const auto children_of = [](const std::shared_ptr<const Node>& n) -> auto& {
        return const_cast<Node&>(*n).children;
    };
    for (auto& top : children) {
        if (!is_inner(top)) continue;
        std::shared_ptr<const Node> at = std::move(top);
        while (!children_of(at).empty()) {
            auto& here = children_of(at);
            std::shared_ptr<const Node> next = std::move(here.back());
            here.pop_back();
            if (!is_inner(next)) continue;
            if (!here.empty()) {
                auto& below = children_of(next);
                here.push_back(std::move(below.front()));  // there is room: one went
                below.front() = std::move(at);
            }
            at = std::move(next);
        }
    }
    children.clear();
}

}  // namespace trisect::detail
