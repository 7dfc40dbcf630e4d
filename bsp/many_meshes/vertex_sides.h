// SPDX-License-Identifier: Apache-2.0
//
// VertexSides: sides of vertices of another solid.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>

#include <trisect/bsp/many_meshes/outlines/boundary_sides.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Of vertices that are in use; keeps its memory.
class VertexSides {
public:
    using Side = OutlineSide;

    void start(std::size_t vertex_count) {
        if (parents_.size() >= vertex_count) return;
        parents_.resize(vertex_count);
        sides_.resize(vertex_count);
        uses_.resize(vertex_count);
    }
    /// Begins with vertices from `first` on, none of which is in use. Others keep their sides.
    void start_list(std::size_t first, std::size_t end) {
        first_ = first;
        end_ = end;
        const auto fill = [&](auto& of, auto value) {
            std::fill(of.begin() + static_cast<std::ptrdiff_t>(first),
                      of.begin() + static_cast<std::ptrdiff_t>(end), value);
        };
        fill(uses_, Use());
        fill(sides_, Side::Unknown);
        std::iota(parents_.begin() + static_cast<std::ptrdiff_t>(first),
                  parents_.begin() + static_cast<std::ptrdiff_t>(end),
                  static_cast<std::uint32_t>(first));
    }
    /// \pre one of those; so for all that follows
    void use(std::uint32_t v) { uses_[v].is = true; }
    /// Both are in use and lie on one side.
    void join(std::uint32_t a, std::uint32_t b) {
        if (parents_[a] == parents_[b]) return;
        a = root(a);
        b = root(b);
        if (a != b) parents_[std::max(a, b)] = std::min(a, b);
    }
    /// Whether that was found before; not always when it was.
    [[nodiscard]] bool are_joined(std::uint32_t a, std::uint32_t b) const {
        return parents_[a] == parents_[b];
    }

    /// Lists those in use, ascending. To be called when all are joined.
    void list() {
        if (listed_.size() < end_ - first_) listed_.resize(end_ - first_);
        count_ = 0;
        constexpr std::size_t at_once = 8;
        for (std::size_t v = first_; v < end_;) {
            std::uint64_t some = 1;
            if (v + at_once <= end_) std::memcpy(&some, &uses_[v], at_once);
            const std::size_t end = std::min(end_, v + at_once);
            // Without a branch by each of them.
            for (; some != 0 && v < end; ++v) {
                listed_[count_] = static_cast<std::uint32_t>(v);
                count_ += uses_[v].is ? 1 : 0;
                // A root is the least.
                parents_[v] = parents_[parents_[v]];
            }
            v = end;
        }
    }
    [[nodiscard]] std::span<const std::uint32_t> listed() const {
        return std::span(listed_).first(count_);
    }
    /// The least of those that are joined to it. \pre listed
    [[nodiscard]] std::uint32_t root_of(std::uint32_t v) const { return parents_[v]; }

    [[nodiscard]] Side& of(std::uint32_t v) { return sides_[v]; }
    [[nodiscard]] Side of(std::uint32_t v) const { return sides_[v]; }
    /// False where it has another one.
    [[nodiscard]] bool mark(std::uint32_t v, Side side) {
        Side& known = sides_[v];
        if (known == Side::Unknown) known = side;
        return known == side;
    }

private:
    // No number of eight bits: what is written as one may be a part of anything else.
    struct Use {
        bool is = false;
    };
    [[nodiscard]] std::uint32_t root(std::uint32_t v) {
        while (parents_[v] != v) v = parents_[v] = parents_[parents_[v]];
        return v;
    }

    PoolVector<std::uint32_t> parents_;  // by vertex; not above it
    PoolVector<Side> sides_;
    PoolVector<Use> uses_;
    PoolVector<std::uint32_t> listed_;
    std::size_t count_ = 0;  // of these
    std::size_t first_ = 0;
    std::size_t end_ = 0;
};

}  // namespace trisect::detail
