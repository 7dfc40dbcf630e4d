// SPDX-License-Identifier: Apache-2.0
//
// Sorts of arrays in little code: libc++'s take a kilobyte for each kind of item and order, of
// which the library has four hundred. Included by libcxx14.h.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>

namespace trisect_small_sort {

constexpr std::ptrdiff_t few = 16;

/// Stable.
template <class T, class Less>
inline void insert_in_order(T* first, T* last, Less& less) {
    for (T* next = first + 1; next < last; ++next) {
        if (!less(*next, *(next - 1))) continue;
        T item = std::move(*next);
        T* hole = next;
        do {
            *hole = std::move(*(hole - 1));
            --hole;
        } while (hole != first && less(item, *(hole - 1)));
        *hole = std::move(item);
    }
}

/// Quick sort. Pivots are drawn: no order of the input is slow, and no second algorithm is needed
/// for one.
template <class T, class Less>
[[gnu::noinline]] void sort_unless_sorted(T* first, T* last, Less& less) {
    using std::swap;
    T* sorted = first;
    if (first != last)
        for (++sorted; sorted != last && !less(*sorted, *(sorted - 1));) ++sorted;
    if (sorted == last) return;
    unsigned drawn = 1;
    while (last - first > few) {
        const auto quarter = static_cast<std::size_t>(last - first) / 4;
        drawn = drawn * 1664525U + 1013904223U;
        T* const a = first + (drawn >> 8) % quarter;
        T* b = a + quarter;
        T* const c = b + quarter;
        if (less(*b, *a)) {
            if (less(*c, *b))
                ;
            else if (less(*c, *a))
                b = c;
            else
                b = a;
        } else if (less(*c, *b)) {
            b = less(*c, *a) ? a : c;
        }
        swap(*first, *b);
        T* low = first;
        T* high = last;
        for (;;) {
            while (++low != last && less(*low, *first)) continue;
            while (less(*first, *--high)) continue;
            if (low >= high) break;
            swap(*low, *high);
        }
        swap(*first, *high);
        // The smaller part is put off to a call, so that these do not nest deeply.
        if (high - first < last - high - 1) {
            sort_unless_sorted(first, high, less);
            first = high + 1;
        } else {
            sort_unless_sorted(high + 1, last, less);
            last = high;
        }
    }
    insert_in_order(first, last, less);
}

/// `more` has place for half of the items.
template <class T, class Less>
[[gnu::noinline]] void sort_stably(T* first, T* last, T* more, Less& less) {
    if (last - first <= few) {
        if (first != last) insert_in_order(first, last, less);
        return;
    }
    T* const middle = first + (last - first) / 2;
    sort_stably(first, middle, more, less);
    sort_stably(middle, last, more, less);
    if (!less(*middle, *(middle - 1))) return;
    const auto half = static_cast<std::size_t>(middle - first);
    std::memcpy(static_cast<void*>(more), first, half * sizeof(T));
    T* const end = more + half;
    for (T* right = middle; more != end; ++first)
        *first = right != last && less(*right, *more) ? *right++ : *more++;
}

template <class T, class Less>
inline void stable_sort(T* first, T* last, Less& less) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto half = static_cast<std::size_t>(last - first) / 2;
    const std::unique_ptr<unsigned char[]> more(static_cast<std::ptrdiff_t>(half) * 2 > few - 1
                                                    ? new unsigned char[half * sizeof(T)]
                                                    : nullptr);
    sort_stably(first, last, reinterpret_cast<T*>(more.get()), less);
}

}  // namespace trisect_small_sort
