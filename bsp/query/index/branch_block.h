// SPDX-License-Identifier: Apache-2.0
//
// BranchBlock: three levels of a cell tree in two cache lines.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/query/index/index_point.h>
#include <trisect/bsp/query/index/indexed_leaf.h>

namespace trisect::detail {

/// Where a point is along each axis, up to all errors of a comparison with a wall.
class WallPoint {
public:
    WallPoint() = default;
    explicit WallPoint(const IndexPoint& p) : WallPoint(p.approximate(), p.error()) {}
    /// A point within `error` of `p` in each coordinate.
    WallPoint(const std::array<double, 3>& p, double error) {
        for (std::size_t k = 0; k < 3; ++k) {
            // Walls are rounded by 2^-50 of themselves. Those that are not as large as the
            // coordinate, up to a factor of two, are far away.
            const double slack = 2 * error + std::fabs(p[k]) * 0x1p-48;
            const bool finite = slack < HUGE_VAL;
            at_[k] = {finite ? p[k] - slack : -HUGE_VAL, finite ? p[k] + slack : HUGE_VAL};
        }
    }
    /// Relative to a wall: 3 when surely above it, 0 when surely below it, otherwise 2.
    [[nodiscard]] unsigned side_of(double wall) const {
        const std::size_t axis = std::bit_cast<std::uint64_t>(wall) & 3U;
#if defined(__SSE2__)
        const __m128d ends = _mm_load_pd(at_[axis].data());
        return static_cast<unsigned>(_mm_movemask_pd(_mm_cmplt_pd(_mm_set1_pd(wall), ends)));
#else
        const Ends& ends = at_[axis];
        return (wall < ends[0] ? 1U : 0U) | (wall < ends[1] ? 2U : 0U);
#endif
    }

private:
    using Ends = std::array<double, 2>;
    alignas(16) std::array<Ends, 3> at_{};
};

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
    /// one that doubles do not decide. All walls are compared: that takes less time than to wait
    /// for one result after the other.
    [[nodiscard]] int way_of(const WallPoint& p) const {
        unsigned sides = 0;
        for (std::size_t i = 0; i < 7; ++i) sides |= p.side_of(walls_[i]) << (2 * i);
        const unsigned first = sides & 3U;
        const unsigned second = sides >> (2 + (first & 2U)) & 3U;
        const unsigned third = sides >> (6 + 2 * (first & 2U) + (second & 2U)) & 3U;
        const unsigned doubt =
            (first ^ first >> 1U) | (second ^ second >> 1U) | (third ^ third >> 1U);
        if ((doubt & 1U) != 0) return -1;
        return static_cast<int>((first & 2U) << 1U | (second & 2U) | third >> 1U);
    }
    /// Asks for what follows the walls in memory.
    void prefetch() const {
        __builtin_prefetch(this);
        __builtin_prefetch(&next_);
    }
    /// Unknown where it is a leaf without an index.
    [[nodiscard]] Next next(int way) const {
        const std::uintptr_t word =
            next_[static_cast<std::size_t>(way)].load(std::memory_order_acquire);
        return word != 0 ? Next(word) : find_next(way);
    }

    /// Of the root of a tree: what is derived of it as that.
    [[nodiscard]] const FactSlot& root_fact() const { return root_fact_; }

private:
    [[nodiscard]] Next find_next(int way) const;

    // In the order of a heap; the last two bits are the axis. Where a leaf comes before the third
    // level, the walls below it are so far that all points are on the lower side.
    std::array<double, 7> walls_{};
    mutable std::array<std::atomic<std::uintptr_t>, 8> next_{};
    const CellNode& node_;
    FactSlot root_fact_;
};

}  // namespace trisect::detail
