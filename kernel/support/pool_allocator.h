// SPDX-License-Identifier: Apache-2.0
//
// PoolAllocator: memory of the BlockPool for vectors.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include <trisect/kernel/support/block_pool.h>

namespace trisect::detail {

/// Takes blocks from the BlockPool but for small ones, which stay in the heap anyway. What lies at
/// the end of the heap is given back to the system whenever it is freed, and a small result then
/// pays for the same pages each time, a twentieth of its whole time, that of a larger one up to a
/// third.
template <class T>
class PoolAllocator {
public:
    using value_type = T;

    PoolAllocator() = default;
    template <class U>
    PoolAllocator(const PoolAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor)

    [[nodiscard]] T* allocate(std::size_t n) {
        static_assert(alignof(T) <= BlockPool::granule);
        if (!is_pooled(n)) return std::allocator<T>().allocate(n);
        if (n > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_alloc();
        return reinterpret_cast<T*>(BlockPool::take(n * sizeof(T)).memory);
    }
    void deallocate(T* p, std::size_t n) noexcept {
        if (!is_pooled(n)) {
            std::allocator<T>().deallocate(p, n);
            return;
        }
        BlockPool::give_back({reinterpret_cast<std::byte*>(p), BlockPool::rounded(n * sizeof(T))});
    }

    friend bool operator==(const PoolAllocator&, const PoolAllocator&) { return true; }

private:
    static constexpr std::size_t least = std::size_t{1} << 13;

    [[nodiscard]] static constexpr bool is_pooled(std::size_t n) { return n >= least / sizeof(T); }
};

/// The same for values that are written before they are read: resize() leaves them as the memory
/// is, so several threads may write them afterwards, each on pages that it is the first to touch.
template <class T>
class UnwrittenPoolAllocator : public PoolAllocator<T> {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    UnwrittenPoolAllocator() = default;
    template <class U>
    UnwrittenPoolAllocator(const UnwrittenPoolAllocator<U>&) noexcept {
    }  // NOLINT(google-explicit-constructor)
    // As the standard library calls them.
    template <class U>
    struct rebind {                               // NOLINT(readability-identifier-naming)
        using other = UnwrittenPoolAllocator<U>;  // NOLINT(readability-identifier-naming)
    };

    template <class U>
    void construct(U* /*place*/) noexcept {}
    template <class U, class First, class... Rest>
    void construct(U* place, First&& first, Rest&&... rest) {
        ::new (static_cast<void*>(place))
            U(std::forward<First>(first), std::forward<Rest>(rest)...);
    }
};

/// A vector that may become large and does not live long.
template <class T>
using PoolVector = std::vector<T, PoolAllocator<T>>;

/// An array without values, of the pool unless it is small.
template <class T>
class PoolArray {
public:
    PoolArray() = default;
    explicit PoolArray(std::size_t size) : size_(size), values_(PoolAllocator<T>().allocate(size)) {
        static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    }
    PoolArray(PoolArray&& other) noexcept
        : size_(std::exchange(other.size_, 0)), values_(std::exchange(other.values_, nullptr)) {}
    PoolArray& operator=(PoolArray&& other) noexcept {
        std::swap(size_, other.size_);
        std::swap(values_, other.values_);
        return *this;
    }
    ~PoolArray() {
        if (values_ != nullptr) PoolAllocator<T>().deallocate(values_, size_);
    }

    [[nodiscard]] T* get() const { return values_; }
    [[nodiscard]] T& operator[](std::size_t i) const { return values_[i]; }

private:
    std::size_t size_ = 0;
    T* values_ = nullptr;
};

}  // namespace trisect::detail
