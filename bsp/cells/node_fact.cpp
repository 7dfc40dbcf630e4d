// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/node_fact.h>

#include <array>
#include <cstdint>

#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

std::mutex& FactSlot::mutex_of(const void* slot) {
    static std::array<std::mutex, 64> mutexes;
    return mutexes[mix64(reinterpret_cast<std::uintptr_t>(slot)) % mutexes.size()];
}

}  // namespace trisect::detail
