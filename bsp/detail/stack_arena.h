// SPDX-License-Identifier: Apache-2.0
//
// StackArena: memory that a recursion takes on its way down and gives back on its way up.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace trisect::detail {

/// Blocks of memory used as one stack. Objects are trivially destructible and are not initialised;
/// memory is aligned to 16 bytes. One thread at a time.
class StackArena {
public:
    StackArena() = default;
    StackArena(const StackArena&) = delete;
    StackArena& operator=(const StackArena&) = delete;

    /// Everything taken after a mark was made is given back by release().
    struct Mark {
        std::size_t block = 0;
        std::size_t used = 0;
    };
    [[nodiscard]] Mark mark() const { return {block_, used_}; }
    void release(const Mark& m) {
        block_ = m.block;
        used_ = m.used;
    }

    template <class T>
    [[nodiscard]] T* take(std::size_t count) {
        static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= 16);
        const std::size_t bytes = (count * sizeof(T) + 15) & ~std::size_t{15};
        if (blocks_.empty() || used_ + bytes > blocks_[block_].size) next_block(bytes);
        T* at = reinterpret_cast<T*>(blocks_[block_].memory.get() + used_);
        used_ += bytes;
        return at;
    }
    /// Gives back the end of what was taken last.
    template <class T>
    void shrink(const T* end) {
        used_ = static_cast<std::size_t>(reinterpret_cast<const std::byte*>(end) -
                                         blocks_[block_].memory.get());
        used_ = (used_ + 15) & ~std::size_t{15};
    }
    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = 0;
        for (const Block& b : blocks_) sum += b.size;
        return sum;
    }

private:
    static constexpr std::size_t huge_page = std::size_t{1} << 21;

    struct Free {
        void operator()(std::byte* p) const { std::free(p); }
    };
    struct Block {
        std::unique_ptr<std::byte, Free> memory;
        std::size_t size = 0;
    };

    void next_block(std::size_t bytes) {
        const std::size_t next = blocks_.empty() ? 0 : block_ + 1;
        // A block above that is too small holds nothing now: replace it and those above.
        if (next < blocks_.size() && blocks_[next].size < bytes) blocks_.resize(next);
        if (next >= blocks_.size()) {
            const std::size_t least = blocks_.empty() ? std::size_t{1} << 18 : blocks_.back().size;
            const std::size_t page = std::max(bytes, least) < huge_page ? 4096 : huge_page;
            const std::size_t size = (std::max(bytes, least) + page - 1) & ~(page - 1);
            auto* p = static_cast<std::byte*>(std::aligned_alloc(page, size));
            if (p == nullptr) throw std::bad_alloc();
#if defined(__linux__)
            // Fresh memory costs a fault a page, otherwise a tenth of an evaluation. A wish only.
            if (page == huge_page) (void)madvise(p, size, MADV_HUGEPAGE);
#endif
            blocks_.push_back({std::unique_ptr<std::byte, Free>(p), size});
        }
        block_ = next;
        used_ = 0;
    }

    std::vector<Block> blocks_;
    std::size_t block_ = 0;
    std::size_t used_ = 0;
};

}  // namespace trisect::detail
