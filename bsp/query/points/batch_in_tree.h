// SPDX-License-Identifier: Apache-2.0
//
// BatchInTree: many points of a solid whose tree has several leaves.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

#include <trisect/bsp/query/index/branch_block.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/query/index/index_counters.h>
#include <trisect/bsp/query/points/mixed_points.h>

namespace trisect::detail {

/// A few dozen points go down the tree side by side: while the memory of one's next block is on its
/// way the others take their step.
template <class Sink>
class BatchInTree {
public:
    using Points = std::span<const std::array<double, 3>>;

    /// \pre the index is bounded, and its tree has inner nodes.
    BatchInTree(const IndexBase& index, Points points, const Sink& sink)
        : index_(index),
          beyond_(index.is_inside_beyond()),
          lattice_(index.lattice()),
          points_(points),
          sink_(sink),
          mixed_(index, points, sink) {}

    /// Points, best in an order in which neighbours come after each other.
    void find(std::span<const std::uint32_t> order) {
        for (std::size_t i = 0; i < order.size(); i += together) {
            const std::size_t end = std::min(i + together, order.size());
            for (std::size_t j = end; j < std::min(end + together, order.size()); ++j) {
                __builtin_prefetch(points_[order[j]].data());
                __builtin_prefetch(points_[order[j]].data() + 2);
            }
            count_ = 0;
            for (std::size_t j = i; j < end; ++j) begin(order[j]);
            go_down();
            enter_leaves();
            mixed_.locate();
        }
        index_counters().empty += empty_;
        empty_ = 0;
    }

private:
    static constexpr std::size_t together = MixedPoints<Sink>::together;
    struct Descent {
        std::uint32_t number = 0;
        bool turned = false;
        const BranchBlock* block = nullptr;
        const IndexedLeaf* leaf = nullptr;
        std::array<double, 3> point{};
        WallPoint at;
        IndexGrid::Position position;
    };

    void found(std::uint32_t number, bool inside) {
        ++empty_;
        sink_.off(number, inside);
    }
    void begin(std::uint32_t number) {
        std::array<double, 3> p{};
        if (!IndexPoint::to_lattice(points_[number], lattice_, p)) {
            mixed_.add_alone(number);
            return;
        }
        for (std::size_t k = 0; k < 3; ++k)
            if (p[k] > index_.hi()[k] || p[k] < index_.lo()[k]) {
                found(number, beyond_);
                return;
            }
        if (const auto inside = far_side(index_, p)) {
            found(number, *inside);
            return;
        }
        Descent& d = all_[count_++];
        d.number = number;
        d.turned = index_.root().complemented;
        d.block = index_.root_block();
        d.leaf = nullptr;
        d.point = p;
        d.at = WallPoint(p, 0);
    }
    void go_down() {
        std::array<std::uint8_t, together> going{};
        std::iota(going.begin(), going.end(), std::uint8_t{0});
        for (std::size_t n = count_; n != 0;) {
            std::size_t kept = 0;
            for (std::size_t i = 0; i < n; ++i)
                if (step(all_[going[i]])) going[kept++] = going[i];
            n = kept;
        }
    }
    // False when the descent has ended; in a leaf if it has polygons.
    [[nodiscard]] bool step(Descent& d) {
        const int way = d.block->way_of(d.at);
        const BranchBlock::Next next = way < 0 ? BranchBlock::Next() : d.block->next(way);
        if (!next.is_known()) {
            mixed_.add_alone(d.number);
            return false;
        }
        if (next.is_empty()) {
            found(d.number, next.turned() != d.turned);
            return false;
        }
        d.turned = d.turned != next.turned();
        if (next.is_leaf()) {
            d.leaf = &next.leaf();
            d.leaf->prefetch();
            return false;
        }
        d.block = &next.block();
        d.block->prefetch();
        return true;
    }
    void enter_leaves() {
        for (Descent& d : std::span(all_).first(count_))
            if (d.leaf != nullptr && !find_position(d)) d.leaf = nullptr;
        for (const Descent& d : std::span(all_).first(count_)) {
            if (d.leaf == nullptr) continue;
            const IndexedLeaf::Cell cell = d.leaf->cell_at(d.position);
            if (cell.is_mixed()) {
                mixed_.add(d.number, *d.leaf, d.turned, cell, d.position);
            } else {
                found(d.number, cell.is_inside() != d.turned);
            }
        }
    }
    // False when the point is located, or for one without a sure place in a grid.
    [[nodiscard]] bool find_position(Descent& d) {
        const IndexedLeaf& leaf = d.leaf->divided();
        if (const auto inside = leaf.beyond(d.point, 0)) {
            found(d.number, *inside != d.turned);
            return false;
        }
        if (leaf.grid() == nullptr || !leaf.grid()->find_position(d.point, d.position)) {
            mixed_.add_alone(d.number);
            return false;
        }
        leaf.prefetch_root(d.position);
        leaf.prefetch_cells();
        return true;
    }

    const IndexBase& index_;
    const bool beyond_;
    const Lattice lattice_;
    Points points_;
    const Sink& sink_;
    MixedPoints<Sink> mixed_;
    std::array<Descent, together> all_;
    std::size_t count_ = 0;
    std::uint64_t empty_ = 0;
};

}  // namespace trisect::detail
