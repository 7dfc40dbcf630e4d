// SPDX-License-Identifier: Apache-2.0
//
// Buckets: items by numbers, few of which have some.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/kernel/support/pool_allocator.h>
#include <trisect/kernel/support/touched_room.h>

namespace trisect::detail {

/// Items by a number below a limit, those of one in the order in which they were added; keeps its
/// memory. What is done takes time by items, however many numbers there are.
template <class Item>
class Buckets {
public:
    struct Bucket {
        std::uint32_t key = 0;
        std::uint32_t first = 0;  ///< of its items
        std::uint32_t count = 0;
    };
    void clear() {
        for (const Bucket& b : buckets_) place_[b.key] = 0;
        buckets_.clear();
        keys_.clear();
        added_.clear();
    }
    /// For so many. `threads` as for ParallelParts, which make the memory ready.
    void reserve(std::size_t items, std::uint32_t threads) {
        reserve_touched(keys_, items, threads);
        reserve_touched(added_, items, threads);
    }
    void add(std::uint32_t key, const Item& item) {
        keys_.push_back(key);
        added_.push_back(item);
    }
    [[nodiscard]] std::size_t size() const { return added_.size(); }
    /// To be called when all were added.
    void sort(std::size_t limit) {
        if (place_.size() < limit) place_.resize(limit);
        for (const std::uint32_t k : keys_) {
            if (place_[k] == 0) {
                buckets_.push_back({k, 0, 0});
                place_[k] = static_cast<std::uint32_t>(buckets_.size());
            }
            ++buckets_[place_[k] - 1].count;
        }
        std::uint32_t before = 0;
        for (Bucket& b : buckets_) {
            b.first = before;
            before += b.count;
            b.count = 0;
        }
        items_.resize(added_.size());
        for (std::size_t i = 0; i < keys_.size(); ++i) {
            Bucket& b = buckets_[place_[keys_[i]] - 1];
            items_[b.first + b.count++] = added_[i];
        }
    }
    /// Numbers that have items, in the order in which their first ones were added.
    [[nodiscard]] std::span<const Bucket> buckets() const { return buckets_; }
    [[nodiscard]] std::span<Item> of(const Bucket& b) {
        return std::span(items_).subspan(b.first, b.count);
    }
    [[nodiscard]] std::span<Item> of(std::uint32_t key) {
        return place_[key] == 0 ? std::span<Item>() : of(buckets_[place_[key] - 1]);
    }
    [[nodiscard]] bool has(std::uint32_t key) const { return place_[key] != 0; }

private:
    PoolVector<std::uint32_t> keys_;
    PoolVector<Item> added_;
    PoolVector<Bucket> buckets_;
    PoolVector<std::uint32_t> place_;  // among these, from 1 on; 0 where a number has none
    PoolVector<Item> items_;
};

}  // namespace trisect::detail
