// SPDX-License-Identifier: Apache-2.0
//
// Sorting by integer keys, without comparisons.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace trisect::detail {

/// Sorts by 64-bit keys, stable, `key(item)` being called a few times for every item. Goes through
/// the items once for each eleven bits in which keys differ; takes as much memory again.
template <class Item, class Memory, class Key>
void radix_sort(std::vector<Item, Memory>& items, const Key& key) {
    constexpr unsigned bits = 11;
    constexpr std::size_t few = 256;
    if (items.size() < few) {
        std::ranges::stable_sort(items, {}, key);
        return;
    }
    std::uint64_t differ = 0;
    const std::uint64_t first = key(items.front());
    for (const Item& i : items) differ |= key(i) ^ first;
    std::vector<Item, Memory> sorted(items.size());
    std::array<std::size_t, std::size_t{1} << bits> place;
    for (unsigned shift = 0; shift < 64 && differ >> shift != 0; shift += bits) {
        if ((differ >> shift) % place.size() == 0) continue;
        const auto digit = [&](const Item& i) { return (key(i) >> shift) % place.size(); };
        place.fill(0);
        for (const Item& i : items) ++place[digit(i)];
        std::size_t before = 0;
        for (std::size_t& p : place) before += std::exchange(p, before);
        for (const Item& i : items) sorted[place[digit(i)]++] = i;
        items.swap(sorted);
    }
}

}  // namespace trisect::detail
