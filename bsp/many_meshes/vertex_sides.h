// SPDX-License-Identifier: Apache-2.0
//
// VertexSides: sides of vertices of another solid.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/many_meshes/outlines/boundary_sides.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Of vertices that are listed; keeps its memory, and what is done takes time by these.
class VertexSides {
public:
    using Side = OutlineSide;

    void start(std::size_t vertex_count) {
        if (marks_.size() < vertex_count) marks_.resize(vertex_count);
        ++turn_;
    }
    /// Begins a list. What was listed before since start() keeps its sides.
    void start_list() { count_ = 0; }
    /// A vertex may come more than once. Without a branch by whether it does.
    void list(std::uint32_t v) {
        if (count_ == listed_.size()) listed_.resize(2 * count_ + 64);
        Mark& m = marks_[v];
        const std::uint32_t is_new = m.turn != turn_ ? 1 : 0;
        const std::uint32_t old = is_new - 1;  // all bits or none
        const auto side = static_cast<std::uint32_t>(m.side) & old;
        m = {turn_, (m.parent & old) | (v & ~old), static_cast<Side>(side)};
        listed_[count_] = v;
        count_ += is_new;
    }
    /// Each once, in the order in which they came first.
    [[nodiscard]] std::span<const std::uint32_t> listed() const {
        return std::span(listed_).first(count_);
    }

    /// \pre listed; so for all that follows
    [[nodiscard]] Side& of(std::uint32_t v) { return marks_[v].side; }
    [[nodiscard]] Side of(std::uint32_t v) const { return marks_[v].side; }
    /// False where it has another one.
    [[nodiscard]] bool mark(std::uint32_t v, Side side) {
        Side& known = marks_[v].side;
        if (known == Side::Unknown) known = side;
        return known == side;
    }
    /// Both lie on one side.
    void join(std::uint32_t a, std::uint32_t b) {
        if (marks_[a].parent == marks_[b].parent) return;
        a = root(a);
        b = root(b);
        if (a != b) marks_[std::max(a, b)].parent = std::min(a, b);
    }
    /// The least of those that are joined to it.
    [[nodiscard]] std::uint32_t root(std::uint32_t v) {
        while (marks_[v].parent != v) {
            std::uint32_t& parent = marks_[v].parent;
            v = parent = marks_[parent].parent;
        }
        return v;
    }

private:
    struct Mark {
        std::uint32_t turn = 0;  // in which it was listed last
        std::uint32_t parent = 0;
        Side side = Side::Unknown;
    };
    PoolVector<Mark> marks_;  // by vertex
    std::vector<std::uint32_t> listed_;
    std::size_t count_ = 0;  // of these
    std::uint32_t turn_ = 0;
};

}  // namespace trisect::detail
