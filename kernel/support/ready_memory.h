// SPDX-License-Identifier: Apache-2.0
//
// Memory that is made ready before it is written.
//
// The system gives out new memory page by page, when each is touched for the first time. On a
// virtual machine such a fault takes ten microseconds and more, longer than all that is done with
// the page. After one call for a whole array the first touch takes a third to a half of that: the
// machine below still has to find the page. Arrays of several megabytes get large pages where the
// system gives these to programs that wish for them, which is how Debian and Ubuntu are set up;
// they take a hundredth. What is ready already costs next to nothing, so it is better to keep
// memory (pool_allocator.h).
#pragma once

#include <cstddef>
#include <vector>

namespace trisect::detail {

/// Smaller arrays are left alone: the heap often has them at once.
inline constexpr std::size_t least_to_make_ready = std::size_t{1} << 16;

/// Before large arrays are allocated. The GNU library gives the end of the heap back to the system
/// whenever more than 128 kB of it are free, and maps arrays of that size by themselves, until one
/// of these is freed: since then the limits are its size and twice that. A program that works on
/// meshes of megabytes comes there sooner or later; until it does, each result pays for the same
/// pages again. The first call brings it there, by an array of 32 MB that is never touched.
void keep_heap() noexcept;

/// For memory that will be written soon, nearly all of it. A wish only.
void make_ready(void* memory, std::size_t bytes) noexcept;

/// Room for so many values, ready.
template <class T, class A>
void reserve_ready(std::vector<T, A>& values, std::size_t size) {
    if (size <= values.capacity()) return;
    if (size * sizeof(T) >= least_to_make_ready) keep_heap();
    values.reserve(size);
    make_ready(static_cast<void*>(values.data() + values.size()),
               (size - values.size()) * sizeof(T));
}

template <class T, class A>
void resize_ready(std::vector<T, A>& values, std::size_t size) {
    reserve_ready(values, size);
    values.resize(size);
}

}  // namespace trisect::detail
