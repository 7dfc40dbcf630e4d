// SPDX-License-Identifier: Apache-2.0
//
// FlatMap: a small open-addressing map from 128-bit keys to indices.
// Keys are names of planes and points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

struct Key128 {
    std::uint64_t a = 0;
    std::uint64_t b = 0;
    friend bool operator==(const Key128&, const Key128&) = default;
};

/// The finaliser of splitmix64: every input bit reaches every output bit.
[[nodiscard]] constexpr std::uint64_t mix64(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ULL;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

/// Insert-only. Iteration order is never used, so hashing cannot leak into results.
/// Without memory until the first key: of the maps that a small result makes most stay empty.
class FlatMap {
public:
    // Keeps its capacity while that is moderate: the next leaf is about as large as the last.
    void clear() {
        if (size_ == 0) return;
        if (slots_.size() > most_kept) slots_.resize(usual_slots);
        std::fill(slots_.begin(), slots_.end(), Slot{});
        size_ = 0;
    }
    void reserve(std::size_t n) {
        std::size_t want = usual_slots;
        while (want < 2 * n) want *= 2;
        if (want > slots_.size()) rehash(want);
    }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const { return slots_.size() * sizeof(Slot); }

    /// The value stored for the key; stores `value` first if there is none. Second: inserted?
    std::pair<std::int32_t, bool> insert(const Key128& key, std::int32_t value) {
        if (2 * (size_ + 1) > slots_.size()) [[unlikely]]
            grow();
        Slot& s = slots_[find_slot(key)];
        if (s.value >= 0) return {s.value, false};
        s = {key, value};
        ++size_;
        return {value, true};
    }
    /// -1 when absent.
    [[nodiscard]] std::int32_t find(const Key128& key) const {
        return size_ == 0 ? -1 : slots_[find_slot(key)].value;
    }
    /// \pre the key is present.
    void assign(const Key128& key, std::int32_t value) { slots_[find_slot(key)].value = value; }

private:
    struct Slot {
        Key128 key;
        std::int32_t value = -1;
    };
    using Slots = std::vector<Slot, PoolAllocator<Slot>>;
    static constexpr std::size_t first_slots = 16;
    static constexpr std::size_t usual_slots = 64;
    static constexpr std::size_t most_kept = 4096;
    [[nodiscard]] std::size_t find_slot(const Key128& key) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t i =
            static_cast<std::size_t>(mix64(key.a ^ mix64(key.b + 0x9e3779b97f4a7c15ULL)));
        for (i &= mask; slots_[i].value >= 0 && !(slots_[i].key == key); i = (i + 1) & mask) {
        }
        return i;
    }
    // Apart, so that insert() stays small enough to be compiled where it is called.
    [[gnu::noinline]] void grow() {
        if (slots_.size() < usual_slots) {
            rehash(slots_.empty() ? first_slots : usual_slots);
        } else {
            rehash(2 * slots_.size());
        }
    }
    void rehash(std::size_t n) {
        Slots old(n);
        old.swap(slots_);
        for (const Slot& s : old)
            if (s.value >= 0) slots_[find_slot(s.key)] = s;
    }
    Slots slots_;
    std::size_t size_ = 0;
};

}  // namespace trisect::detail
