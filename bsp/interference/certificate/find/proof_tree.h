// SPDX-License-Identifier: Apache-2.0
//
// Construction of proof trees over ranges of triangles and of time.
// It is for the search for certificates. Checkers share no code with it on purpose
// (certified_walk.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace trisect::detail {

/// For proofs without time.
struct NoTime {};

/// Ranges of triangles of A and of B, and a range of time where the proof has one.
template <class Time = NoTime>
struct ProofRange {
    std::size_t a0 = 0;
    std::size_t a1 = 0;
    std::size_t b0 = 0;
    std::size_t b1 = 0;
    Time from{};
    Time to{};

    [[nodiscard]] bool is_single() const { return a1 - a0 == 1 && b1 - b0 == 1; }
};

/// What a proof by ranges may cost.
struct ProofLimits {
    std::size_t nodes = 1000000;
    int depth = 300;
};

/// A tree of nodes in preorder, whose leaves `search.separate(range, node)` fills in, true where it
/// succeeds. Where it does not, the time is split if `search.time_to_split(range)` has one, else
/// the larger one of the ranges of triangles. Nothing where that comes to an end.
template <class Node, class Time, class Search>
class ProofTree {
public:
    ProofTree(Search& search, ProofLimits limits) : search_(search), limits_(limits) {}

    [[nodiscard]] std::optional<std::vector<Node>> build(const ProofRange<Time>& whole) {
        nodes_.clear();
        if (!add(whole, 0)) return std::nullopt;
        return std::move(nodes_);
    }

private:
    bool add(const ProofRange<Time>& r, int depth) {
        if (nodes_.size() >= limits_.nodes || depth > limits_.depth) return false;
        const std::size_t at = nodes_.size();
        nodes_.emplace_back();
        if (search_.separate(r, nodes_[at])) return true;
        ProofRange<Time> first = r;
        ProofRange<Time> second = r;
        if (!split_time(nodes_[at], r, first, second)) {
            if (r.is_single()) return false;
            if (r.a1 - r.a0 >= r.b1 - r.b0) {
                nodes_[at].kind = Node::Kind::SplitA;
                first.a1 = second.a0 = (r.a0 + r.a1) / 2;
            } else {
                nodes_[at].kind = Node::Kind::SplitB;
                first.b1 = second.b0 = (r.b0 + r.b1) / 2;
            }
        }
        if (!add(first, depth + 1)) return false;
        nodes_[at].other = static_cast<std::uint32_t>(nodes_.size());
        return add(second, depth + 1);
    }
    bool split_time([[maybe_unused]] Node& node, [[maybe_unused]] const ProofRange<Time>& r,
                    [[maybe_unused]] ProofRange<Time>& first,
                    [[maybe_unused]] ProofRange<Time>& second) {
        if constexpr (std::is_same_v<Time, NoTime>) {
            return false;
        } else {
            const std::optional<Time> time = search_.time_to_split(r);
            if (!time) return false;
            node.kind = Node::Kind::SplitTime;
            search_.set_time(node, *time);
            first.to = second.from = *time;
            return true;
        }
    }

    Search& search_;
    ProofLimits limits_;
    std::vector<Node> nodes_;
};

}  // namespace trisect::detail
