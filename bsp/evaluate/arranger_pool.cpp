// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/arranger_pool.h>

#include <array>
#include <cstddef>
#include <mutex>
#include <utility>

namespace trisect::detail {

namespace {

// What arrangers keep after leaves of this size is some hundred kilobytes.
constexpr std::size_t largest_kept_leaf = 200;

struct Pool {
    std::mutex mutex;
    std::array<std::unique_ptr<LeafArrangers>, 8> kept;
};

// Never destroyed: a solid may be evaluated, or end, after main().
Pool& pool() {
    static Pool& the_pool = *new Pool;
    return the_pool;
}

}  // namespace

std::unique_ptr<LeafArrangers> ArrangerPool::take() {
    {
        const std::lock_guard lock(pool().mutex);
        for (auto& kept : pool().kept)
            if (kept != nullptr) return std::move(kept);
    }
    return std::make_unique<LeafArrangers>();
}

void ArrangerPool::give_back(std::unique_ptr<LeafArrangers> arrangers) noexcept {
    if (arrangers->largest_leaf > largest_kept_leaf) return;
    const std::lock_guard lock(pool().mutex);
    for (auto& kept : pool().kept) {
        if (kept != nullptr) continue;
        kept = std::move(arrangers);
        return;
    }
}

}  // namespace trisect::detail
