// SPDX-License-Identifier: Apache-2.0
//
// Counting first, then filling one array: no cell has an allocation of its own, and cells are
// numbered in the order in which they are first met, so hashing cannot leak into an answer.

#include <trisect/bsp/interference/scene/cell_lists.h>

namespace trisect::hierarchies {

void CellLists::clear() {
    numbers_.clear();
    places_.clear();
    first_.clear();
    entries_.clear();
    filled_.clear();
}

void CellLists::count(const CellPlace& place) {
    const auto [cell, is_new] =
        numbers_.insert(key_of(place), static_cast<std::int32_t>(places_.size()));
    if (is_new) {
        places_.push_back(place);
        filled_.push_back(0);
    }
    ++filled_[static_cast<std::size_t>(cell)];
}

void CellLists::allocate() {
    first_.assign(1, 0);
    for (std::uint32_t& n : filled_) {
        first_.push_back(first_.back() + n);
        n = 0;
    }
    entries_.resize(first_.back());
}

void CellLists::add(const CellPlace& place, std::uint32_t number) {
    const auto cell = static_cast<std::size_t>(numbers_.find(key_of(place)));
    entries_[first_[cell] + filled_[cell]++] = number;
}

}  // namespace trisect::hierarchies
