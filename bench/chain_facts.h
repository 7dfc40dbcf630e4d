// SPDX-License-Identifier: Apache-2.0
//
// Bytes of facts that a version of a solid adds to those of the version before.
#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/interference/tree/leaf_boxes.h>
#include <trisect/bsp/query/index/fact_bytes.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/solid.h>

class ChainFacts {
public:
    explicit ChainFacts(const trisect::Solid& first) { (void)added_by(first); }

    /// Facts that questions have hung on the next version, on nodes of its own and on old ones.
    std::size_t added_by(const trisect::Solid& next) {
        Weights weights;
        std::size_t added = 0;
        for_nodes(next, [&](const Node& node) {
            const std::size_t bytes =
                trisect::detail::query_fact_bytes(node) + trisect::detail::boxes_fact_bytes(node);
            if (!weights.emplace(&node, bytes).second) return;
            const auto before = weights_.find(&node);
            const std::size_t old = before != weights_.end() ? before->second : 0;
            if (bytes > old) added += bytes - old;
        });
        weights_ = std::move(weights);
        version_ = next;  // keeps its nodes, so that no new one has the address of an old one
        return added;
    }

private:
    using Node = trisect::detail::CellNode;
    using Weights = std::unordered_map<const Node*, std::size_t>;

    template <class Visit>
    static void for_nodes(const trisect::Solid& solid, const Visit& visit) {
        const trisect::detail::IndexBase base(solid);
        std::vector<const Node*> pending{base.root().node.get()};
        while (!pending.empty()) {
            const Node& node = *pending.back();
            pending.pop_back();
            visit(node);
            if (const Node& n = trisect::detail::refined(node); &n != &node) {
                pending.push_back(&n);
            } else if (!n.is_leaf()) {
                for (int i = 0; i < 2; ++i) pending.push_back(n.child(i).node.get());
            }
        }
    }

    Weights weights_;
    trisect::Solid version_;
};
