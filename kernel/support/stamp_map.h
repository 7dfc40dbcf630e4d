// SPDX-License-Identifier: Apache-2.0
//
// StampMap: a small open-addressing map that is cleared in constant time.
// It serves look-ups in one leaf after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace trisect::detail {

/// Insert-only map from 96-bit keys to numbers. Entries carry the stamp of the filling that they
/// belong to, so that emptying the map is a matter of taking the next stamp. Iteration order does
/// not exist, so hashing cannot leak into results.
class StampMap {
public:
    struct Key {
        std::uint64_t a = 0;
        std::uint32_t b = 0;
        friend bool operator==(const Key&, const Key&) = default;
    };

    StampMap() : slots_(std::size_t{1} << 6) {}

    void clear() {
        size_ = 0;
        if (++stamp_ != 0) return;
        for (Slot& s : slots_) s.stamp = 0;
        stamp_ = 1;
    }
    [[nodiscard]] std::size_t size() const { return size_; }

    /// The number stored for the key; stores `value` first if there is none. Second: inserted?
    std::pair<std::int32_t, bool> insert(const Key& key, std::int32_t value) {
        if (2 * (size_ + 1) > slots_.size()) grow();
        Slot& s = find(key);
        if (s.stamp == stamp_) return {s.value, false};
        s = {key, stamp_, value};
        ++size_;
        return {value, true};
    }

private:
    struct Slot {
        Key key;
        std::uint32_t stamp = 0;
        std::int32_t value = 0;
    };

    // Fibonacci hashing (Knuth, vol. 3, 6.4) of both parts of the key.
    [[nodiscard]] Slot& find(const Key& key) {
        const std::size_t mask = slots_.size() - 1;
        const std::uint64_t h = (key.a ^ (std::uint64_t{key.b} << 40)) * 0x9e3779b97f4a7c15ULL;
        std::size_t i = static_cast<std::size_t>(h ^ (h >> 32)) & mask;
        while (slots_[i].stamp == stamp_ && !(slots_[i].key == key)) i = (i + 1) & mask;
        return slots_[i];
    }
    void grow() {
        std::vector<Slot> old(2 * slots_.size());
        old.swap(slots_);
        for (const Slot& s : old)
            if (s.stamp == stamp_) find(s.key) = s;
    }

    std::vector<Slot> slots_;
    std::size_t size_ = 0;
    std::uint32_t stamp_ = 1;
};

}  // namespace trisect::detail
