// SPDX-License-Identifier: Apache-2.0
//
// Edges that have looked for vertices inside them, with what they found.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/bsp/assembly/parts/boundary_facet.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A hash table of edges by their ends, either way, and the vertices inside each, along it.
class LookedEdges {
public:
    struct Inside {
        PointId from = -1;  ///< the edge that has looked
        PointId to = -1;
        std::uint32_t first = 0;  ///< of its vertices
        std::uint32_t count = 0;
    };

    [[nodiscard]] static std::uint64_t hash_of(const BoundaryEdge& e) {
        return mix64(static_cast<std::uint64_t>(std::min(e.from, e.to)) << 32U |
                     static_cast<std::uint32_t>(std::max(e.from, e.to)));
    }

    void clear() {
        inside_.clear();
        known_.clear();
        slots_.clear();
    }
    /// For so many edges; more may come.
    void reserve(std::size_t edges) {
        make_slots(2 * edges);
        known_.reserve(edges);
    }
    /// The number of an edge; for the first one with these ends look(e, inside) appends the
    /// vertices inside it.
    template <class Look>
    std::uint32_t number_of(const BoundaryEdge& e, const Look& look) {
        if (2 * (known_.size() + 1) > slots_.size()) make_slots(2 * slots_.size());
        std::uint32_t& slot = slot_of(e);
        if (slot == 0) {
            const auto first = static_cast<std::uint32_t>(inside_.size());
            look(e, inside_);
            const auto end = static_cast<std::uint32_t>(inside_.size());
            known_.push_back({e.from, e.to, first, end - first});
            slot = static_cast<std::uint32_t>(known_.size());
        }
        return slot - 1;
    }
    [[nodiscard]] const Inside& operator[](std::uint32_t number) const { return known_[number]; }
    [[nodiscard]] std::span<const PointId> vertices_of(const Inside& inside) const {
        return std::span(inside_).subspan(inside.first, inside.count);
    }

private:
    // Of the edge between two points, either way; else a free one.
    [[nodiscard]] std::uint32_t& slot_of(const BoundaryEdge& e) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t i = static_cast<std::size_t>(hash_of(e)) & mask;
        const auto is_other = [&](const Inside& known) {
            return (known.from != e.from || known.to != e.to) &&
                   (known.from != e.to || known.to != e.from);
        };
        while (slots_[i] != 0 && is_other(known_[slots_[i] - 1])) i = (i + 1) & mask;
        return slots_[i];
    }
    void make_slots(std::size_t n) {
        slots_.assign(std::max<std::size_t>(std::bit_ceil(n), 64), 0);
        for (std::uint32_t k = 0; k < known_.size(); ++k)
            slot_of({known_[k].from, known_[k].to, -1, {}}) = k + 1;
    }

    PoolVector<PointId> inside_;  // edge after edge
    PoolVector<Inside> known_;
    PoolVector<std::uint32_t> slots_;  // 1 more than a place in known_, or 0
};

}  // namespace trisect::detail
