// SPDX-License-Identifier: Apache-2.0
#include "failing_new.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

constinit thread_local std::int64_t allocations_left = -1;  // negative: none fails
constinit thread_local bool failed = false;
constinit thread_local std::int64_t live = 0;

// Of all threads together.
constinit std::atomic<std::int64_t> left_anywhere{-1};
constinit std::atomic<std::int64_t> asked_anywhere{0};
constinit std::atomic<std::int64_t> live_anywhere{0};

void count_block(std::int64_t change) {
    live += change;
    live_anywhere.fetch_add(change, std::memory_order_relaxed);
}

bool fails_now() {
    asked_anywhere.fetch_add(1, std::memory_order_relaxed);
    if (left_anywhere.load(std::memory_order_relaxed) >= 0 &&
        left_anywhere.fetch_sub(1, std::memory_order_relaxed) == 0)
        return true;
    if (allocations_left < 0) return false;
    if (allocations_left-- > 0) return false;
    failed = true;
    return true;
}

void* allocate(std::size_t size, std::size_t alignment) {
    if (fails_now()) return nullptr;
    if (size == 0) size = 1;
    void* p = nullptr;
    if (alignment <= alignof(std::max_align_t)) {
        p = std::malloc(size);
    } else {
        p = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    }
    if (p != nullptr) count_block(1);
    return p;
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
    void* p = allocate(size, alignment);
    if (p == nullptr) throw std::bad_alloc();
    return p;
}

void release(void* p) noexcept {
    if (p != nullptr) count_block(-1);
    std::free(p);
}

constexpr std::size_t usual = alignof(std::max_align_t);

}  // namespace

namespace trisect::test {

FailingAllocation::FailingAllocation(std::int64_t n) {
    failed = false;
    allocations_left = n;
}
FailingAllocation::~FailingAllocation() { allocations_left = -1; }
bool FailingAllocation::has_failed() const { return failed; }

FailingAllocationAnywhere::FailingAllocationAnywhere(std::int64_t n) { left_anywhere = n; }
FailingAllocationAnywhere::~FailingAllocationAnywhere() { left_anywhere = -1; }

std::int64_t live_blocks() { return live; }
std::int64_t live_blocks_anywhere() { return live_anywhere; }
std::int64_t allocations_anywhere() { return asked_anywhere; }

}  // namespace trisect::test

void* operator new(std::size_t n) { return allocate_or_throw(n, usual); }
void* operator new[](std::size_t n) { return allocate_or_throw(n, usual); }
void* operator new(std::size_t n, std::align_val_t a) {
    return allocate_or_throw(n, static_cast<std::size_t>(a));
}
void* operator new[](std::size_t n, std::align_val_t a) {
    return allocate_or_throw(n, static_cast<std::size_t>(a));
}
void* operator new(std::size_t n, const std::nothrow_t&) noexcept { return allocate(n, usual); }
void* operator new[](std::size_t n, const std::nothrow_t&) noexcept { return allocate(n, usual); }
void* operator new(std::size_t n, std::align_val_t a, const std::nothrow_t&) noexcept {
    return allocate(n, static_cast<std::size_t>(a));
}
void* operator new[](std::size_t n, std::align_val_t a, const std::nothrow_t&) noexcept {
    return allocate(n, static_cast<std::size_t>(a));
}
void operator delete(void* p) noexcept { release(p); }
void operator delete[](void* p) noexcept { release(p); }
void operator delete(void* p, std::size_t) noexcept { release(p); }
void operator delete[](void* p, std::size_t) noexcept { release(p); }
void operator delete(void* p, std::align_val_t) noexcept { release(p); }
void operator delete[](void* p, std::align_val_t) noexcept { release(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { release(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { release(p); }
void operator delete(void* p, const std::nothrow_t&) noexcept { release(p); }
void operator delete[](void* p, const std::nothrow_t&) noexcept { release(p); }
