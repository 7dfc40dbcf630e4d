// SPDX-License-Identifier: Apache-2.0
//
// A wish for large pages behind large arrays.
//
// The system makes memory ready page by page, when it is touched for the first time. For arrays of
// megabytes that are written once this takes longer than the writing: with pages of 4 kB a quarter
// to a half of an import or an export of a million triangles, on a virtual machine more. Where
// large pages are given to programs that ask for them, which is how Debian and Ubuntu are set up,
// one call is enough.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace trisect::detail {

/// Smaller arrays are left alone: at both ends up to a large page (2 MiB) has none.
inline constexpr std::size_t least_for_large_pages = std::size_t{4} << 20;

/// For memory that was not touched yet. Does nothing where the system has no such pages.
void wish_for_large_pages(void* memory, std::size_t bytes) noexcept;

/// Room for so many values, not touched yet where it is new.
template <class T>
void reserve_large(std::vector<T>& values, std::size_t size) {
    values.reserve(size);
    wish_for_large_pages(static_cast<void*>(values.data() + values.size()),
                         (size > values.size() ? size - values.size() : 0) * sizeof(T));
}

/// An array without values.
template <class T>
[[nodiscard]] std::unique_ptr<T[]> make_large_array(std::size_t size) {
    static_assert(std::is_trivially_destructible_v<T>);
    auto array = std::make_unique_for_overwrite<T[]>(size);
    wish_for_large_pages(static_cast<void*>(array.get()), size * sizeof(T));
    return array;
}

}  // namespace trisect::detail
