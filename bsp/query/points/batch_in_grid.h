// SPDX-License-Identifier: Apache-2.0
//
// BatchInGrid: location of many points in the grid of one leaf.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/query/index/index_counters.h>
#include <trisect/bsp/query/points/mixed_points.h>

namespace trisect::detail {

/// Points in cells without polygons need no more than what fits into a small cache and are found at
/// once; the others are to be sorted by leaf first, so that neighbours come after each other.
template <class Sink>
class BatchInGrid {
public:
    using Points = std::span<const std::array<double, 3>>;
    struct PointOfLeaf {
        std::uint32_t leaf;
        std::uint32_t point;
    };

    BatchInGrid(const IndexBase& index, const IndexedLeaf& leaf, Points points, const Sink& sink)
        : index_(index),
          leaf_(leaf),
          grid_(*leaf.grid()),
          turned_(index.root().complemented),
          beyond_(index.is_inside_beyond()),
          lattice_(index.lattice()),
          points_(points),
          sink_(sink),
          mixed_(index, points, sink) {}

    /// Points from begin on: those in cells without polygons are found at once, in their own order;
    /// the others are left in `mixed`, with their leaves.
    void find_empty(std::size_t begin, std::size_t end, std::vector<PointOfLeaf>& mixed) {
        std::uint64_t empty = 0;
        Descent d;
        for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
            descend(d, i);
            if (d.state == State::Known) {
                ++empty;
                sink_.off(i, d.inside);
            } else {
                mixed.push_back({d.state == State::Mixed ? d.cell.leaf : 0, i});
            }
        }
        index_counters().empty += empty;
    }

    /// The others, in the order of their leaves.
    void find_mixed(std::span<const std::uint32_t> order) {
        constexpr std::size_t together = MixedPoints<Sink>::together;
        Descent d;
        for (std::size_t i = 0; i < order.size(); i += together) {
            const std::size_t end = std::min(i + together, order.size());
            for (std::size_t j = end; j < std::min(end + together, order.size()); ++j) {
                __builtin_prefetch(points_[order[j]].data());
                __builtin_prefetch(points_[order[j]].data() + 2);
            }
            for (std::size_t j = i; j < end; ++j) {
                descend(d, order[j]);
                if (d.state == State::Mixed) {
                    mixed_.add(order[j], leaf_, turned_, d.cell, d.at);
                } else {
                    mixed_.add_alone(order[j]);
                }
            }
            mixed_.locate();
        }
    }

private:
    enum class State : std::uint8_t { Known, Mixed, Alone };
    struct Descent {
        State state = State::Known;
        bool inside = false;
        IndexGrid::Position at;
        IndexedLeaf::Cell cell;
    };

    void descend(Descent& d, std::uint32_t number) const {
        d.state = State::Alone;
        std::array<double, 3> p{};
        if (!IndexPoint::to_lattice(points_[number], lattice_, p)) return;
        d.state = State::Known;
        for (std::size_t k = 0; k < 3; ++k)
            if (p[k] > index_.hi()[k] || p[k] < index_.lo()[k]) {
                d.inside = beyond_;
                return;
            }
        if (!grid_.find_position(p, d.at)) {
            d.state = State::Alone;
            return;
        }
        d.cell = leaf_.cell_at(d.at);
        d.inside = d.cell.is_inside() != turned_;
        if (d.cell.is_mixed()) d.state = State::Mixed;
    }

    const IndexBase& index_;
    const IndexedLeaf& leaf_;
    const IndexGrid& grid_;
    const bool turned_;
    const bool beyond_;
    const Lattice lattice_;
    Points points_;
    const Sink& sink_;
    MixedPoints<Sink> mixed_;
};

}  // namespace trisect::detail
