// SPDX-License-Identifier: Apache-2.0
//
// One grid suits boxes of one size. Here every power of two has a grid, all of them in one hash
// table, and a box is in the grid whose cells are as long as it is, or up to twice as long, in one
// cell alone: that of its lower corner. Whatever meets a box [lo, hi] from a grid of cells of size
// s has its lower corner within [lo - s, hi]; on grids not finer than its own that are at most
// three cells along an axis, 27 in all. A box looks for partners in its own grid and in coarser
// ones. So each pair comes up once, at the smaller of the two; a giant is found by the dwarfs near
// it and uses none of them.
//
// An update moves an entry from one list to another, if its cell has changed at all. The number of
// grids in use is the logarithm of the ratio of sizes: a constant for similar ones.
//
// Sizes are powers of two, so dividing by them is exact.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <trisect/bsp/interference/scene/broad_phases.h>
#include <trisect/bsp/interference/scene/cell_lists.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::hierarchies {
namespace {

using detail::BodyBox;
using detail::BodyPair;

constexpr std::uint32_t end_of_list = std::numeric_limits<std::uint32_t>::max();
constexpr int unbounded = std::numeric_limits<int>::max();

/// The cell of a box: its grid by the exponent of its size, and where in it.
struct GridCell {
    int level = 0;
    CellPlace place{};
    friend bool operator==(const GridCell&, const GridCell&) = default;
};

detail::Key128 key_of_cell(const GridCell& c) {
    detail::Key128 key = key_of(c.place);
    key.b |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(c.level)) << 32U;
    return key;
}

int exponent_above(double v) {
    int e = 0;
    (void)std::frexp(v, &e);
    return e;  // v < 2^e
}

GridCell cell_of(const BodyBox& b) {
    double size = 0;
    double far = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        size = std::max(size, b.hi[k] - b.lo[k]);
        far = std::max({far, std::abs(b.lo[k]), std::abs(b.hi[k])});
    }
    if (!(far < 0x1p1000)) return {unbounded, {}};
    // The difference is rounded: the next double is an upper bound. Cells are large enough for
    // places to be below 2^28; near to the smallest double all boxes are of one size.
    constexpr int finest = -1000;
    const int level = std::max(
        {exponent_above(std::nextafter(size, HUGE_VAL)), exponent_above(far) - 28, finest});
    GridCell c;
    c.level = level;
    for (std::size_t k = 0; k < 3; ++k) c.place[k] = cell_along(b.lo[k], std::ldexp(1.0, level));
    return c;
}

class HierarchicalGridPhase final : public detail::BroadPhase {
public:
    void insert(std::uint32_t slot, const BodyBox& box) override {
        if (slot >= entries_.size()) entries_.resize(std::size_t{slot} + 1);
        entries_[slot].box = box;
        link(slot, cell_of(box));
        ++size_;
    }

    void update(std::uint32_t slot, const BodyBox& box) override {
        Entry& e = entries_[slot];
        e.box = box;
        const GridCell cell = cell_of(box);
        if (cell == e.cell) return;
        unlink(slot);
        link(slot, cell);
        ++moved_;
    }

    void remove(std::uint32_t slot) override {
        unlink(slot);
        entries_[slot] = {};
        --size_;
    }

    void pairs(std::vector<BodyPair>& out) override {
        counts_ = {};
        out.clear();
        if (heads_.size() > 4 * size_ + 64) rebuild();
        counts_.moves = moved_;
        counts_.cells = size_;
        moved_ = 0;
        for (std::uint32_t slot = 0; slot < entries_.size(); ++slot)
            if (entries_[slot].head != end_of_list) partners_of(slot, out);
        std::sort(out.begin(), out.end());
    }

    [[nodiscard]] std::size_t bytes() const override {
        return entries_.size() * sizeof(Entry) + heads_.size() * sizeof(heads_[0]) +
               numbers_.bytes();
    }

private:
    // A member of a doubly linked list.
    struct Entry {
        BodyBox box;
        GridCell cell;
        std::uint32_t head = end_of_list;  // of its list
        std::uint32_t next = end_of_list;
        std::uint32_t previous = end_of_list;
    };

    void link(std::uint32_t slot, const GridCell& cell) {
        const auto [head, is_new] =
            numbers_.insert(key_of_cell(cell), static_cast<std::int32_t>(heads_.size()));
        if (is_new) heads_.push_back(end_of_list);
        std::uint32_t& first = heads_[static_cast<std::size_t>(head)];
        Entry& e = entries_[slot];
        e.cell = cell;
        e.head = static_cast<std::uint32_t>(head);
        e.previous = end_of_list;
        e.next = first;
        if (first != end_of_list) entries_[first].previous = slot;
        first = slot;
        ++levels_[cell.level];
    }

    void unlink(std::uint32_t slot) {
        Entry& e = entries_[slot];
        if (e.previous == end_of_list)
            heads_[e.head] = e.next;
        else
            entries_[e.previous].next = e.next;
        if (e.next != end_of_list) entries_[e.next].previous = e.previous;
        e.head = end_of_list;
        const auto level = levels_.find(e.cell.level);
        if (--level->second == 0) levels_.erase(level);
    }

    // Forgets cells that have long been left.
    void rebuild() {
        numbers_ = {};
        heads_.clear();
        levels_.clear();
        for (std::uint32_t slot = 0; slot < entries_.size(); ++slot)
            if (entries_[slot].head != end_of_list) link(slot, entries_[slot].cell);
    }

    void partners_of(std::uint32_t slot, std::vector<BodyPair>& out) {
        const Entry& e = entries_[slot];
        for (auto level = levels_.lower_bound(e.cell.level); level != levels_.end(); ++level) {
            CellRange range;
            if (level->first != unbounded) {
                range = CellRange::of(e.box.lo, e.box.hi, std::ldexp(1.0, level->first));
                for (std::int32_t& c : range.lo) --c;
            }
            const bool own = level->first == e.cell.level;
            range.for_each([&](const CellPlace& place) {
                ++counts_.lookups;
                const std::int32_t head = numbers_.find(key_of_cell({level->first, place}));
                if (head < 0) return;
                for (std::uint32_t other = heads_[static_cast<std::size_t>(head)];
                     other != end_of_list; other = entries_[other].next) {
                    if (own && other <= slot) continue;
                    ++counts_.box_tests;
                    if (e.box.meets(entries_[other].box))
                        out.push_back({std::min(slot, other), std::max(slot, other)});
                }
            });
        }
    }

    std::vector<Entry> entries_;         // by slot
    std::vector<std::uint32_t> heads_;   // first slot in a cell
    detail::FlatMap numbers_;            // cells to heads
    std::map<int, std::size_t> levels_;  // in use, with the number of boxes
    std::size_t size_ = 0;
    std::size_t moved_ = 0;
};

}  // namespace

std::unique_ptr<detail::BroadPhase> make_hierarchical_grid() {
    return std::make_unique<HierarchicalGridPhase>();
}

}  // namespace trisect::hierarchies
