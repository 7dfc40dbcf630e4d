// SPDX-License-Identifier: Apache-2.0
//
// StackArena: memory of a recursion, in stack order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include <trisect/kernel/support/block_pool.h>

namespace trisect::detail {

/// Blocks of memory used as one stack. Objects are trivially destructible and are not initialised;
/// memory is aligned to 16 bytes. One thread at a time.
class StackArena {
public:
    StackArena() = default;
    StackArena(const StackArena&) = delete;
    StackArena& operator=(const StackArena&) = delete;
    ~StackArena() { keep_blocks(0); }

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
        T* at = reinterpret_cast<T*>(blocks_[block_].memory + used_);
        used_ += bytes;
        return at;
    }
    /// Gives back the end of what was taken last.
    template <class T>
    void shrink(const T* end) {
        used_ = static_cast<std::size_t>(reinterpret_cast<const std::byte*>(end) -
                                         blocks_[block_].memory);
        used_ = (used_ + 15) & ~std::size_t{15};
    }
    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = 0;
        for (const MemoryBlock& b : blocks_) sum += b.size;
        return sum;
    }

private:
    static constexpr std::size_t least_block = std::size_t{1} << 18;

    void keep_blocks(std::size_t count) {
        for (std::size_t i = count; i < blocks_.size(); ++i) BlockPool::give_back(blocks_[i]);
        blocks_.resize(std::min(count, blocks_.size()));
    }

    void next_block(std::size_t bytes) {
        const std::size_t next = blocks_.empty() ? 0 : block_ + 1;
        // A block above that is too small holds nothing now: replace it and those above.
        if (next < blocks_.size() && blocks_[next].size < bytes) keep_blocks(next);
        if (next >= blocks_.size()) {
            const std::size_t least = blocks_.empty() ? least_block : blocks_.back().size;
            blocks_.reserve(next + 1);
            blocks_.push_back(BlockPool::take(std::max(bytes, least)));
        }
        block_ = next;
        used_ = 0;
    }

    std::vector<MemoryBlock> blocks_;
    std::size_t block_ = 0;
    std::size_t used_ = 0;
};

}  // namespace trisect::detail
