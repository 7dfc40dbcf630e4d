// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/support/ready_memory.h>

#include <cstdint>
#include <cstdlib>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace trisect::detail {

#if defined(__linux__)

namespace {

constexpr std::uintptr_t large_page = std::uintptr_t{1} << 21;
// Of smaller arrays too much at both ends has no large page, unless they begin with one.
constexpr std::size_t least_for_large_pages = std::size_t{4} << 20;

// Since Linux 5.14; the headers may be older. Systems without it refuse.
constexpr int populate_write = 23;

constexpr std::uintptr_t page = 4096;

// Of memory that the heap had before, which is ready as a whole or at its beginning.
bool is_ready(std::uintptr_t begin, std::uintptr_t end) {
    const auto has_page = [](std::uintptr_t at) {
        unsigned char state = 0;
        return mincore(reinterpret_cast<void*>(at), page, &state) == 0 && (state & 1) != 0;
    };
    return has_page(end - page) && has_page(begin + (end - begin) / (2 * page) * page);
}

}  // namespace

void keep_heap() noexcept {
    [[maybe_unused]] static const bool is_kept = [] {
        // The largest one that counts.
        constexpr std::size_t most_mapped = (std::size_t{1} << 25) - 2 * page;
        void* volatile const array = std::malloc(most_mapped);
        std::free(array);
        return true;
    }();
}

void make_ready(void* memory, std::size_t bytes) noexcept {
    if (bytes < least_to_make_ready) return;
    // Whole small pages, which is what the system takes.
    const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) & ~(page - 1);
    const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) & ~(page - 1);
    if (begin >= end || is_ready(begin, end)) return;
    auto* const first = reinterpret_cast<void*>(begin);
    const bool begins_with_one = begin % large_page == 0 && bytes >= large_page;
    if (bytes >= least_for_large_pages || begins_with_one) {
        // What is written takes memory, a large page at a time.
        (void)madvise(first, end - begin, MADV_HUGEPAGE);
    } else {
        (void)madvise(first, end - begin, populate_write);
    }
}

#else

void keep_heap() noexcept {}
void make_ready(void* /*memory*/, std::size_t /*bytes*/) noexcept {}

#endif

}  // namespace trisect::detail
