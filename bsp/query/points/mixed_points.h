// SPDX-License-Identifier: Apache-2.0
//
// MixedPoints: a few dozen points in cells with polygons, located together.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/query/points/index_in_leaf.h>

namespace trisect::detail {

/// A point alone waits for memory most of its time: leaf, planes, corners of the mesh, one after
/// the other. Here every step is done for all points before the next one, and prefetches the memory
/// of the next one.
template <class Sink>
class MixedPoints {
public:
    static constexpr std::size_t together = 32;
    using Points = std::span<const std::array<double, 3>>;

    MixedPoints(const IndexBase& index, Points points, const Sink& sink)
        : index_(index), lattice_(index.lattice()), points_(points), sink_(sink) {}

    /// A point in a mixed cell; its place in the grid is known to 2^-23 of the cell.
    /// \pre fewer than `together` since the last locate().
    void add(std::uint32_t number, const IndexedLeaf& leaf, bool turned,
             const IndexedLeaf::Cell& cell, const IndexGrid::Position& at) {
        Item& item = all_[count_++];
        item.number = number;
        item.state = State::Mixed;
        item.turned = turned;
        item.leaf = &leaf;
        item.at = at;
        item.cell = cell;
        __builtin_prefetch(&leaf.leaf(cell.leaf));
    }
    /// A point of which nothing is known yet.
    void add_alone(std::uint32_t number) {
        Item& item = all_[count_++];
        item.number = number;
        item.state = State::Alone;
    }

    /// Passes on where they are, and forgets them.
    void locate() {
        for_those(State::Mixed, [&](Item& d) {
            d.leaf->prefetch(d.leaf->leaf(d.cell.leaf));
            d.in_leaf.begin(*d.leaf, d.turned, d.cell, d.at, true);
        });
        for_those(State::Mixed, [&](Item& d) {
            const PointInLeaf::Answer a = d.in_leaf.decide();
            d.state = a == PointInLeaf::Answer::Open ? State::Open : State::Known;
            d.inside = (a == PointInLeaf::Answer::Inside) != d.turned;
        });
        fetch_corners();
        for (std::size_t i = 0; i < count_; ++i) finish(all_[i]);
        count_ = 0;
    }

private:
    enum class State : std::uint8_t { Known, Mixed, Open, Alone };
    struct Item {
        std::uint32_t number = 0;
        State state = State::Known;
        bool turned = false;
        bool inside = false;
        const IndexedLeaf* leaf = nullptr;
        IndexGrid::Position at;
        IndexedLeaf::Cell cell;
        PointInLeaf in_leaf;
    };

    void finish(Item& d) {
        if (d.state == State::Known) {
            sink_.off(d.number, d.inside);
            return;
        }
        on_.clear();
        const IndexPoint p = IndexPoint::from_user(points_[d.number], lattice_);
        bool inside = false;
        int rank = 0;
        if (d.state == State::Alone) {
            inside = locate_polygons(index_, p, on_) == Location::Inside;
        } else {
            inside = d.in_leaf.finish(p, on_) != d.turned;
            if (!on_.empty()) rank = d.in_leaf.rank();
        }
        if (on_.empty()) {
            sink_.off(d.number, inside);
        } else {
            sink_.on(d.number, p, on_, rank);
        }
    }

    template <class Work>
    void for_those(State state, const Work& work) {
        for (std::size_t i = 0; i < count_; ++i)
            if (all_[i].state == state) work(all_[i]);
    }
    template <class Work>
    void for_wanted(const Work& work) {
        for_those(State::Open, [&](const Item& d) {
            const Source* const source = d.leaf->polygons().only_source();
            if (source == nullptr) return;
            const auto listed = d.leaf->listed(d.leaf->leaf(d.cell.leaf));
            for (std::uint64_t left = d.in_leaf.wanted(); left != 0; left &= left - 1)
                work(*source, listed[static_cast<std::size_t>(std::countr_zero(left))]);
        });
    }
    void fetch_corners() {
        for_those(State::Open, [&](const Item& d) {
            __builtin_prefetch(d.leaf->listed(d.leaf->leaf(d.cell.leaf)).data());
        });
        for_wanted([&](const Source& source, IndexedLeaf::Id id) {
            __builtin_prefetch(&source.mesh().triangles[id]);
        });
        for_wanted([&](const Source& source, IndexedLeaf::Id id) {
            for (int i = 0; i < 3; ++i) __builtin_prefetch(&source.corner(id, i));
        });
    }

    const IndexBase& index_;
    const Lattice lattice_;
    Points points_;
    const Sink& sink_;
    std::array<Item, together> all_;
    std::size_t count_ = 0;
    std::vector<PolygonId> on_;
};

}  // namespace trisect::detail
