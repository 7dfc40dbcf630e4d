// SPDX-License-Identifier: Apache-2.0
//
// Boxes of one size and bounded density meet a bounded number of others, all of them in the cells
// that they reach into themselves. With cells twice as long as the median box, a box of that size
// reaches into 3.4 cells on the average and 8 at most. A hash table of occupied cells takes O(n)
// storage, where an array over the whole scene would take as much as the scene is wide.
//
// A pair comes up in every cell that both reach into. It is kept in the one that contains the lower
// corner of what the two have in common, so no table of pairs is needed.
//
// The hypothesis is in "one size". A box of more than 64 cells is not entered but compared with
// every other one.
#include <algorithm>

#include <trisect/bsp/interference/scene/broad_phases.h>
#include <trisect/bsp/interference/scene/cell_lists.h>
#include <trisect/bsp/interference/scene/packed_phase.h>

namespace trisect::hierarchies {
namespace {

constexpr double most_cells = 64;

class HashGridPhase final : public PackedPhase {
    void pack() override {
        size_ = cell_size();
        cells_.clear();
        large_.clear();
        for (std::uint32_t i = 0; i < boxes().size(); ++i) {
            const CellRange range = range_of(i);
            if (range.count() > most_cells)
                large_.push_back(i);
            else
                range.for_each([this](const CellPlace& c) { cells_.count(c); });
        }
        cells_.allocate();
        for (std::uint32_t i = 0; i < boxes().size(); ++i) {
            const CellRange range = range_of(i);
            if (range.count() <= most_cells)
                range.for_each([this, i](const CellPlace& c) { cells_.add(c, i); });
        }
        counts_.cells = cells_.entry_count() + large_.size();
    }

    void find_pairs() override {
        for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
            const CellPlace& place = cells_.place(cell);
            const auto is_here = [this, &place](const std::array<double, 3>& corner) {
                return CellRange::of(corner, corner, size_).lo == place;
            };
            const auto list = cells_.list(cell);
            for (std::size_t i = 0; i < list.size(); ++i)
                for (std::size_t j = 0; j < i; ++j) compare_in_cell(list[i], list[j], is_here);
        }
        for (const std::uint32_t i : large_) {
            // Of two large ones the first compares with the second.
            std::size_t l = 0;
            for (std::uint32_t j = 0; j < boxes().size(); ++j) {
                while (l < large_.size() && large_[l] < j) ++l;
                const bool is_large = l < large_.size() && large_[l] == j;
                if (!is_large || j > i) compare(i, j);
            }
        }
    }

    [[nodiscard]] std::size_t cell_bytes() const override {
        return cells_.bytes() + large_.size() * sizeof(large_[0]);
    }

    [[nodiscard]] CellRange range_of(std::size_t i) const {
        return CellRange::of(boxes()[i].lo, boxes()[i].hi, size_);
    }

    [[nodiscard]] double cell_size() const {
        std::vector<double> sizes;
        for (const detail::BodyBox& b : boxes()) sizes.push_back(extent(b));
        if (sizes.empty()) return 1;
        const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
        std::nth_element(sizes.begin(), middle, sizes.end());
        if (*middle > 0) return 2 * *middle;
        // More than half of them are points.
        const double largest = *std::max_element(sizes.begin(), sizes.end());
        return largest > 0 ? largest : 1;
    }

    CellLists cells_;
    std::vector<std::uint32_t> large_;  // ascending
    double size_ = 1;
};

}  // namespace

std::unique_ptr<detail::BroadPhase> make_hash_grid() { return std::make_unique<HashGridPhase>(); }

}  // namespace trisect::hierarchies
