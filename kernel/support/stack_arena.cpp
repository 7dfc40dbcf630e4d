// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/support/stack_arena.h>

#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <trisect/kernel/support/ready_memory.h>

namespace trisect::detail {

namespace {

constexpr std::size_t small_page = 4096;
constexpr std::size_t huge_page = std::size_t{1} << 21;

class Pool {
public:
    /// The smallest one that is large enough and no more than four times that; empty if there is
    /// none.
    MemoryBlock take(std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        auto best = blocks_.end();
        for (auto b = blocks_.begin(); b != blocks_.end(); ++b)
            if (b->size >= bytes && b->size / 4 <= bytes &&
                (best == blocks_.end() || b->size < best->size))
                best = b;
        if (best == blocks_.end()) return {};
        const MemoryBlock out = *best;
        *best = blocks_.back();
        blocks_.pop_back();
        kept_like(out).bytes -= out.size;
        return out;
    }

    /// False when it keeps enough already, or has never seen one as large: a single evaluation
    /// wants the memory back.
    bool keep(const MemoryBlock& block) noexcept {
        const std::lock_guard lock(mutex_);
        if (block.size > largest_) {
            largest_ = block.size;
            return false;
        }
        Kept& kept = kept_like(block);
        if (kept.bytes + block.size > kept.most) return false;
        try {
            blocks_.push_back(block);
        } catch (const std::bad_alloc&) {
            return false;
        }
        kept.bytes += block.size;
        return true;
    }

    [[nodiscard]] std::size_t kept_large() {
        const std::lock_guard lock(mutex_);
        return large_.bytes;
    }

private:
    struct Kept {
        std::size_t most = 0;
        std::size_t bytes = 0;
    };
    Kept& kept_like(const MemoryBlock& block) {
        if (block.size < BlockPool::small_block) return small_;
        return block.size < BlockPool::large_block ? medium_ : large_;
    }

    std::mutex mutex_;
    std::vector<MemoryBlock> blocks_;
    Kept small_{BlockPool::kept_small_bytes};
    Kept medium_{BlockPool::kept_medium_bytes};
    Kept large_{BlockPool::kept_bytes};
    std::size_t largest_ = 0;  // that was given back
};

#if defined(__linux__)

// Of their own, so that the heap is not divided by them: what others allocate finds the places that
// it had before.
std::byte* map_pages(std::size_t size, std::size_t alignment) {
    const std::size_t all = size + alignment - small_page;
    void* const p = mmap(nullptr, all, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == MAP_FAILED) return nullptr;
    auto* const begin = static_cast<std::byte*>(p);
    const std::size_t before = -reinterpret_cast<std::uintptr_t>(p) & (alignment - 1);
    if (before != 0) (void)munmap(begin, before);
    if (const std::size_t after = all - before - size; after != 0)
        (void)munmap(begin + before + size, after);
    return begin + before;
}

std::byte* get_pages(std::size_t size, std::size_t alignment) {
    if (size >= BlockPool::small_block) return map_pages(size, alignment);
    return static_cast<std::byte*>(std::aligned_alloc(alignment, size));
}

void free_pages(const MemoryBlock& block) noexcept {
    if (block.size >= BlockPool::small_block) {
        (void)munmap(block.memory, block.size);
    } else {
        std::free(block.memory);
    }
}

#else

std::byte* get_pages(std::size_t size, std::size_t alignment) {
    return static_cast<std::byte*>(std::aligned_alloc(alignment, size));
}
void free_pages(const MemoryBlock& block) noexcept { std::free(block.memory); }

#endif

// Never destroyed: what ends after main() may still take blocks and give them back.
Pool& pool() {
    static Pool& the_pool = *new Pool;
    return the_pool;
}

}  // namespace

MemoryBlock BlockPool::take(std::size_t bytes) {
    const std::size_t page = bytes < huge_page ? small_page : huge_page;
    const std::size_t size = (bytes + page - 1) & ~(page - 1);
    if (const MemoryBlock kept = pool().take(size); kept.memory != nullptr) return kept;
    auto* const p = get_pages(size, page);
    if (p == nullptr) throw std::bad_alloc();
    make_ready(p, size);
    return {p, size};
}

void BlockPool::give_back(const MemoryBlock& block) noexcept {
#if defined(__linux__) && defined(MADV_FREE)
    // Before others may have it.
    if (block.size >= huge_page && pool().kept_large() + block.size > ready_bytes)
        (void)madvise(block.memory, block.size, MADV_FREE);
#endif
    if (!pool().keep(block)) free_pages(block);
}

}  // namespace trisect::detail
