// SPDX-License-Identifier: Apache-2.0
//
// Traversal of proof trees over ranges of triangles and of time.
// It is for the checkers. The makers of such trees share no code with it on purpose
// (proof_tree.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/interference_certificate.h>

namespace trisect::detail::certified {

/// Ranges of triangles of A and of B, and a range of time where the proof has one.
template <class Time>
struct WalkRange {
    std::size_t a0 = 0;
    std::size_t a1 = 0;
    std::size_t b0 = 0;
    std::size_t b1 = 0;
    Time from{};
    Time to{};

    /// What a node's children have; or why there is no such node. Time may be split strictly within
    /// the range.
    template <class Node>
    [[nodiscard]] std::string divide(const Node& node, WalkRange& first, WalkRange& second) const {
        using Kind = typename Node::Kind;
        first = second = *this;
        if constexpr (requires { Kind::SplitTime; }) {
            if (node.kind == Kind::SplitTime) {
                if (!(from < node.time && node.time < to)) return "a time is not in its range";
                first.to = second.from = node.time;
                return {};
            }
        }
        if ((node.kind == Kind::SplitA ? a1 - a0 : b1 - b0) < 2)
            return "the tree splits a single triangle";
        if (node.kind == Kind::SplitA)
            first.a1 = second.a0 = (a0 + a1) / 2;
        else
            first.b1 = second.b0 = (b0 + b1) / 2;
        return {};
    }
};

/// For proofs without time.
struct NoTime {};

/// Why a tree proves nothing, or "": every node is visited once, ranges are divided as nodes say,
/// and `wrong_leaf(node, range)` says why a leaf is wrong, or "".
template <class Node, class Range, class WrongLeaf>
[[nodiscard]] std::string wrong_tree(const std::vector<Node>& nodes, Range whole,
                                     const WrongLeaf& wrong_leaf) {
    std::vector<bool> seen(nodes.size(), false);
    std::vector<std::pair<std::size_t, Range>> open;
    open.emplace_back(0, std::move(whole));
    while (!open.empty()) {
        const auto [at, range] = std::move(open.back());
        open.pop_back();
        if (at >= nodes.size() || seen[at]) return "the tree is no tree";
        seen[at] = true;
        const Node& node = nodes[at];
        if (node.kind == Node::Kind::Separated) {
            if (std::string wrong = wrong_leaf(node, range); !wrong.empty()) return wrong;
            continue;
        }
        Range first;
        Range second;
        if (std::string wrong = range.divide(node, first, second); !wrong.empty()) return wrong;
        open.emplace_back(at + 1, std::move(first));
        open.emplace_back(node.other, std::move(second));
    }
    return {};
}

/// The vertices of a range of triangles, each once, in the order of their numbers.
[[nodiscard]] inline std::vector<std::uint32_t> corners_of(
    std::span<const CertifiedTriangle> triangles) {
    std::vector<std::uint32_t> r;
    r.reserve(3 * triangles.size());
    for (const CertifiedTriangle& t : triangles)
        for (const VertexId v : t.vertex) r.push_back(v.index);
    std::ranges::sort(r);
    r.erase(std::unique(r.begin(), r.end()), r.end());
    return r;
}

/// Of A's triangles in a range, or B's.
template <class Time>
[[nodiscard]] std::vector<std::uint32_t> corners_of_a(
    const std::vector<CertifiedTriangle>& triangles, const WalkRange<Time>& r) {
    return corners_of(std::span(triangles).subspan(r.a0, r.a1 - r.a0));
}
template <class Time>
[[nodiscard]] std::vector<std::uint32_t> corners_of_b(
    const std::vector<CertifiedTriangle>& triangles, const WalkRange<Time>& r) {
    return corners_of(std::span(triangles).subspan(r.b0, r.b1 - r.b0));
}

}  // namespace trisect::detail::certified
