// SPDX-License-Identifier: Apache-2.0
//
// CornerFans: facets of two meshes around the corners that both have.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <trisect/bsp/two_meshes/conforming/corner_names.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

class CornerFans {
public:
    /// A corner of an item.
    struct Corner {
        std::uint32_t item_and_place;
        [[nodiscard]] std::uint32_t item() const { return item_and_place >> 2; }
        [[nodiscard]] std::size_t place() const { return item_and_place & 3U; }
    };
    static constexpr std::uint32_t most_items = std::uint32_t{1} << 30;

    /// Memory is the arena's. \pre at most `most_items`. O(n)
    CornerFans(const CornerNames& names, StackArena& arena);

    /// Those of a mesh's items that have the name; none where it is not common.
    [[nodiscard]] std::span<const Corner> around(std::size_t mesh, std::uint32_t name) const {
        return {corners_[mesh] + begins_[mesh][name], corners_[mesh] + begins_[mesh][name + 1]};
    }

private:
    std::array<std::uint32_t*, 2> begins_{};
    std::array<Corner*, 2> corners_{};
};

}  // namespace trisect::detail
