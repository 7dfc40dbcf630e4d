// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/support/large_pages.h>

#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace trisect::detail {

#if defined(__linux__)

void wish_for_large_pages(void* memory, std::size_t bytes) noexcept {
    if (bytes < least_for_large_pages) return;
    // Whole small pages, which is what the system takes.
    constexpr std::uintptr_t page = 4096;
    const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) & ~(page - 1);
    const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) & ~(page - 1);
    if (begin < end) (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

#else

void wish_for_large_pages(void* /*memory*/, std::size_t /*bytes*/) noexcept {}

#endif

}  // namespace trisect::detail
