// SPDX-License-Identifier: Apache-2.0
//
// sort_few(): a stable sort of mostly a handful of items.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace trisect::detail {

/// As std::stable_sort, which takes memory for any two. Stays within the range, whatever the
/// answers of `is_less`.
template <class Item, class IsLess>
void sort_few(std::span<Item> items, const IsLess& is_less) {
    constexpr std::size_t few = 12;
    if (items.size() > few) {
        std::stable_sort(items.begin(), items.end(), is_less);
        return;
    }
    for (std::size_t i = 1; i < items.size(); ++i) {
        if (!is_less(items[i], items[i - 1])) continue;
        const Item item = std::move(items[i]);
        std::size_t at = i;
        do {
            items[at] = std::move(items[at - 1]);
            --at;
        } while (at > 0 && is_less(item, items[at - 1]));
        items[at] = item;
    }
}

}  // namespace trisect::detail
