// SPDX-License-Identifier: Apache-2.0
//
// Loads and stores of numbers of either byte order at any address.
// The caller has checked bounds.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace trisect::detail {

inline constexpr std::size_t stl_header_size = 84;  // 80 bytes of anything and the count
inline constexpr std::size_t stl_record_size = 50;  // normal, three corners, attribute bytes

/// The value whose bytes are reversed.
template <class T>
[[nodiscard]] inline T reversed(T value) noexcept {
    unsigned char b[sizeof(T)];
    std::memcpy(b, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) {
        const unsigned char t = b[i];
        b[i] = b[sizeof(T) - 1 - i];
        b[sizeof(T) - 1 - i] = t;
    }
    std::memcpy(&value, b, sizeof(T));
    return value;
}

inline constexpr bool host_is_big = std::endian::native == std::endian::big;

template <class T, bool Big>
[[nodiscard]] inline T load(const char* at) noexcept {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    std::memcpy(&value, at, sizeof(T));
    if constexpr (sizeof(T) > 1 && Big != host_is_big) value = reversed(value);
    return value;
}

/// Appends the bytes of `value`.
template <class T>
inline void store(std::string& out, T value, bool big) {
    if (big != host_is_big) value = reversed(value);
    char b[sizeof(T)];
    std::memcpy(b, &value, sizeof(T));
    out.append(b, sizeof(T));
}

/// Writes the bytes of `value` at `to` and moves it behind them.
template <bool Big, class T>
inline void put(char*& to, T value) {
    if constexpr (sizeof(T) > 1 && Big != host_is_big) value = reversed(value);
    std::memcpy(to, &value, sizeof(T));
    to += sizeof(T);
}

}  // namespace trisect::detail
