// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/support/block_pool.h>

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <mutex>

#include <trisect/kernel/support/page_regions.h>
#include <trisect/kernel/support/ready_memory.h>
#endif

namespace trisect::detail {

#if defined(__linux__)

namespace {

struct SharedRegions {
    std::mutex mutex;
    PageRegions regions{BlockPool::ready_bytes};
};

// Never destroyed: what ends after main() may still take blocks and give them back.
SharedRegions& shared() {
    static SharedRegions& the_regions = *new SharedRegions;
    return the_regions;
}

}  // namespace

MemoryBlock BlockPool::take(std::size_t bytes) {
    const std::size_t size = rounded(bytes);
    if (size < bytes) throw std::bad_alloc();
    const PageRegions::Taken taken = [&] {
        SharedRegions& all = shared();
        const std::lock_guard lock(all.mutex);
        return all.regions.take(size);
    }();
    // New pages take far longer than to be found: other threads do not wait for them.
    if (!taken.is_ready) make_ready(taken.block.memory, taken.block.size);
    return taken.block;
}

void BlockPool::give_back(const MemoryBlock& block) noexcept {
    SharedRegions& all = shared();
    const std::lock_guard lock(all.mutex);
    all.regions.give_back(block);
}

#else

MemoryBlock BlockPool::take(std::size_t bytes) {
    const std::size_t size = rounded(bytes);
    auto* const memory = static_cast<std::byte*>(std::aligned_alloc(granule, size));
    if (size < bytes || memory == nullptr) throw std::bad_alloc();
    return {memory, size};
}

void BlockPool::give_back(const MemoryBlock& block) noexcept { std::free(block.memory); }

#endif

}  // namespace trisect::detail
