// SPDX-License-Identifier: Apache-2.0
//
// BranchBlock: three levels of a cell tree in two cache lines.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/query/index/index_point.h>
#include <trisect/bsp/query/index/indexed_leaf.h>

namespace trisect::detail {

/// What a descent for a point reads of an inner node and the two levels below it. A fact of the
/// node: all below is immutable.
class alignas(64) BranchBlock final : public NodeFact {
public:
    /// What comes after the three levels, in one word.
    class Next {
    public:
        Next() = default;
        [[nodiscard]] static Next empty(bool inside) { return Next(inside ? 5U : 4U); }
        [[nodiscard]] static Next block(const BranchBlock& b, bool turned) {
            return Next(reinterpret_cast<std::uintptr_t>(&b) | (turned ? 1U : 0U));
        }
        [[nodiscard]] static Next leaf(const IndexedLeaf& l, bool turned) {
            return Next(reinterpret_cast<std::uintptr_t>(&l) | 2U | (turned ? 1U : 0U));
        }
        [[nodiscard]] bool is_known() const { return word_ != 0; }
        [[nodiscard]] bool is_empty() const { return (word_ & 4U) != 0; }
        [[nodiscard]] bool is_leaf() const { return (word_ & 2U) != 0; }
        /// Of an empty cell: it is inside. Otherwise: it is to be read as that of a complement.
        [[nodiscard]] bool turned() const { return (word_ & 1U) != 0; }
        [[nodiscard]] const BranchBlock& block() const {
            return *reinterpret_cast<const BranchBlock*>(word_ & ~std::uintptr_t{7});
        }
        [[nodiscard]] const IndexedLeaf& leaf() const {
            return *reinterpret_cast<const IndexedLeaf*>(word_ & ~std::uintptr_t{7});
        }

    private:
        friend class BranchBlock;
        explicit Next(std::uintptr_t word) : word_(word) {}
        std::uintptr_t word_ = 0;
    };

    /// Of an inner node, made when it is first needed.
    [[nodiscard]] static const BranchBlock& of(const CellNode& node);

    explicit BranchBlock(const CellNode& node);

    /// The number of the way that a point takes; -1 where it is on a splitting plane or so near to
    /// one that doubles do not decide.
    [[nodiscard]] int way_of(const IndexPoint& p) const {
        const double slack = 2 * p.error();
        std::size_t at = 0;
        for (int level = 0; level < 3; ++level) {
            const double wall = walls_[at];
            const double d = p[std::bit_cast<std::uint64_t>(wall) & 3U] - wall;
            const double e = slack + std::fabs(wall) * wall_error;
            if (!(d > e || d < -e)) return -1;
            at = 2 * at + (d > 0 ? 2 : 1);
        }
        return static_cast<int>(at - 7);
    }
    /// Unknown where it is a leaf without an index.
    [[nodiscard]] Next next(int way) const {
        const std::uintptr_t word =
            next_[static_cast<std::size_t>(way)].load(std::memory_order_acquire);
        return word != 0 ? Next(word) : find_next(way);
    }

private:
    [[nodiscard]] Next find_next(int way) const;

    // Of the last bits of a wall, and of rounding.
    static constexpr double wall_error = 0x1p-49;

    // In the order of a heap; the last two bits are the axis. Where a leaf comes before the third
    // level, the walls below it are so far that all points are on the lower side.
    std::array<double, 7> walls_{};
    mutable std::array<std::atomic<std::uintptr_t>, 8> next_{};
    const CellNode& node_;
};

}  // namespace trisect::detail
