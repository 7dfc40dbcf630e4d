// SPDX-License-Identifier: Apache-2.0
//
// Heap memory of what a chain of cuts leaves.
#pragma once

#include <malloc.h>

#include <cstddef>

/// Bytes of the heap that are in use.
inline std::size_t heap_in_use() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

/// What `made` takes on the heap, by what letting it go gives back.
template <class T>
std::size_t heap_of(T& made) {
    const std::size_t before = heap_in_use();
    made = T();
    return before - heap_in_use();
}
