// SPDX-License-Identifier: Apache-2.0
//
// Cached results of traces in leaves.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include <trisect/bsp/query/index/index_leaf.h>

namespace trisect::detail {

// Points that are surely above the same planes of a leaf and surely below all others are in one
// convex region without polygons. A leaf without LeafCorners, where a trace is dear, remembers of
// the last two regions what a trace found. A region is one word, so that threads never see half of
// one: a bit for each plane, one for inside, one that the word is used.
inline constexpr std::uint64_t region_used = std::uint64_t{1} << 63U;
inline constexpr std::uint64_t region_inside = std::uint64_t{1} << 62U;

/// Whether points above these planes are inside, if that is remembered.
[[nodiscard]] inline std::optional<bool> remembered(const IndexLeaf& leaf, std::uint64_t above) {
    if (leaf.has_corners() || above >= region_inside) return std::nullopt;
    for (std::uint64_t& word : leaf.regions) {
        const std::uint64_t v =
            std::atomic_ref<std::uint64_t>(word).load(std::memory_order_relaxed);
        if ((v | region_inside) == (region_used | region_inside | above))
            return (v & region_inside) != 0;
    }
    return std::nullopt;
}

inline void remember(const IndexLeaf& leaf, std::uint64_t above, bool inside) {
    if (leaf.has_corners() || above >= region_inside) return;
    const std::uint64_t v = region_used | (inside ? region_inside : 0) | above;
    const std::atomic_ref<std::uint64_t> first(leaf.regions[0]);
    const std::atomic_ref<std::uint64_t> second(leaf.regions[1]);
    second.store(first.load(std::memory_order_relaxed), std::memory_order_relaxed);
    first.store(v, std::memory_order_relaxed);
}

}  // namespace trisect::detail
