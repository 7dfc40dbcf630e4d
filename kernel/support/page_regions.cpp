// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/support/page_regions.h>

#if defined(__linux__)

#include <algorithm>
#include <iterator>
#include <new>

#include <sys/mman.h>

namespace trisect::detail {

namespace {

// Regions double up to this: many small programs take one large page only.
constexpr std::size_t most_region = std::size_t{1} << 25;

// Null if there is no memory.
std::byte* map_large_pages(std::size_t size) {
    const std::size_t all = size + PageRegions::large_page - BlockPool::granule;
    void* const p = mmap(nullptr, all, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == MAP_FAILED) return nullptr;
    auto* const begin = static_cast<std::byte*>(p);
    const std::size_t before = -reinterpret_cast<std::uintptr_t>(p) & (PageRegions::large_page - 1);
    if (before != 0) (void)munmap(begin, before);
    if (const std::size_t after = all - before - size; after != 0)
        (void)munmap(begin + before + size, after);
    (void)madvise(begin + before, size, MADV_HUGEPAGE);
    return begin + before;
}

// Calls each(page, bytes of the block in it).
template <class Page, class Each>
void for_each_page(std::vector<Page>& pages, const std::byte* region, const MemoryBlock& block,
                   const Each& each) {
    auto at = static_cast<std::size_t>(block.memory - region);
    const std::size_t end = at + block.size;
    while (at < end) {
        const std::size_t number = at / PageRegions::large_page;
        const std::size_t next = std::min(end, (number + 1) * PageRegions::large_page);
        each(pages[number], number, static_cast<std::uint32_t>(next - at));
        at = next;
    }
}

}  // namespace

PageRegions::~PageRegions() {
    for (const auto& [begin, region] : regions_) (void)munmap(begin, region.size);
}

PageRegions::Taken PageRegions::take(std::size_t size) {
    auto found = by_size_.lower_bound({size, nullptr});
    if (found == by_size_.end()) {
        add_region(size);
        found = by_size_.lower_bound({size, nullptr});
    }
    const MemoryBlock block{found->second, size};
    const auto span = free_.find(block.memory);
    if (span->second > size) {
        change_free(span, {block.memory + size, span->second - size});
    } else {
        remove_free(span);
    }
    return {block, use(region_of(block.memory)->second, block)};
}

void PageRegions::give_back(const MemoryBlock& block) noexcept {
    const auto region = region_of(block.memory);
    leave(region->second, block);
    try {
        add_free(region->second, block);
    } catch (const std::bad_alloc&) {
        return;  // the block serves no more
    }
    drop_if_unused(region);
}

void PageRegions::add_region(std::size_t size) {
    const std::size_t least = (size + large_page - 1) & ~(large_page - 1);
    if (least < size) throw std::bad_alloc();
    std::size_t bytes = std::max(least, std::clamp(mapped_, large_page, most_region));
    std::byte* begin = map_large_pages(bytes);
    if (begin == nullptr && bytes > least) begin = map_large_pages(bytes = least);
    if (begin == nullptr) throw std::bad_alloc();
    try {
        std::vector<LargePage> pages(bytes / large_page);
        const auto region = regions_.emplace(begin, Region{begin, bytes, std::move(pages)}).first;
        add_free(region->second, {begin, bytes});
    } catch (const std::bad_alloc&) {
        regions_.erase(begin);
        (void)munmap(begin, bytes);
        throw;
    }
    mapped_ += bytes;
}

// Whether all of its pages may have memory.
bool PageRegions::use(Region& region, const MemoryBlock& block) {
    bool is_ready = true;
    for_each_page(region.pages, region.begin, block,
                  [&](LargePage& page, std::size_t, std::uint32_t bytes) {
                      if (page.is_ready && page.used == 0) --ready_;
                      is_ready &= page.is_ready;
                      page.is_ready = true;
                      page.used += bytes;
                  });
    return is_ready;
}

void PageRegions::leave(Region& region, const MemoryBlock& block) noexcept {
    for_each_page(region.pages, region.begin, block,
                  [&](LargePage& page, std::size_t number, std::uint32_t bytes) {
                      page.used -= bytes;
                      if (page.used != 0) return;
                      if (ready_ < most_ready_) {
                          ++ready_;
                          return;
                      }
                      (void)madvise(region.begin + number * large_page, large_page, MADV_DONTNEED);
                      page.is_ready = false;
                  });
}

// Joins it with its neighbours. Takes memory only where there are none.
void PageRegions::add_free(const Region& region, const MemoryBlock& span) {
    const auto after = free_.lower_bound(span.memory);
    const bool joins_after = after != free_.end() && after->first == span.memory + span.size &&
                             after->first != region.begin + region.size;
    if (after != free_.begin() && span.memory != region.begin) {
        const auto before = std::prev(after);
        if (before->first + before->second == span.memory) {
            std::size_t size = before->second + span.size;
            if (joins_after) {
                size += after->second;
                remove_free(after);
            }
            change_free(before, {before->first, size});
            return;
        }
    }
    if (joins_after) {
        change_free(after, {span.memory, span.size + after->second});
        return;
    }
    const auto added = free_.emplace(span.memory, span.size).first;
    try {
        by_size_.emplace(span.size, span.memory);
    } catch (const std::bad_alloc&) {
        free_.erase(added);
        throw;
    }
}

void PageRegions::change_free(Free::iterator span, const MemoryBlock& now) noexcept {
    auto by_size = by_size_.extract({span->second, span->first});
    by_size.value() = {now.size, now.memory};
    by_size_.insert(std::move(by_size));
    auto by_address = free_.extract(span);
    by_address.key() = now.memory;
    by_address.mapped() = now.size;
    free_.insert(std::move(by_address));
}

void PageRegions::remove_free(Free::iterator span) noexcept {
    by_size_.erase({span->second, span->first});
    free_.erase(span);
}

// When all of it went back to the system.
void PageRegions::drop_if_unused(Regions::iterator region) noexcept {
    const Region& r = region->second;
    const auto span = free_.find(r.begin);
    if (span == free_.end() || span->second != r.size) return;
    const auto is_ready = [](const LargePage& page) { return page.is_ready; };
    if (std::any_of(r.pages.begin(), r.pages.end(), is_ready)) return;
    remove_free(span);
    mapped_ -= r.size;
    (void)munmap(r.begin, r.size);
    regions_.erase(region);
}

PageRegions::Regions::iterator PageRegions::region_of(std::byte* memory) {
    return std::prev(regions_.upper_bound(memory));
}

}  // namespace trisect::detail

#endif
