// SPDX-License-Identifier: Apache-2.0
//
// A map that is emptied again and again.
#pragma once

#include <cstddef>

#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

/// Empties it. Clearing writes all of it, which is much after a large use: then a small one is
/// taken anew.
inline void empty(FlatMap& map) {
    constexpr std::size_t most_bytes = 4096;
    constexpr std::size_t bytes_of_one = 256;
    if (map.bytes() > most_bytes + bytes_of_one * map.size()) {
        map = FlatMap();
    } else {
        map.clear();
    }
}

}  // namespace trisect::detail
