// SPDX-License-Identifier: Apache-2.0
//
// BoundQueue: pairs of boxes in the order of their bounds, nearly.
//
// Bounds of a sixteenth of an octave are one list, and the last pair that was put there comes
// first. So what is equally near is searched in depth: it comes to triangles at once, and the queue
// stays short. A heap would order what needs no order, and costs more than the tests of boxes.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/boxes/obb_tree.h>

namespace trisect::detail {

/// A pair of boxes that are not nearer than `bound`, in units of A.
struct BoundedPair {
    float bound = 0;
    ObbId a;
    ObbId b;
};

class BoundQueue {
public:
    void clear() {
        for (; first_ <= last_; ++first_) heads_[first_] = none;
        first_ = list_count;
        last_ = 0;
        entries_.clear();
        free_ = none;
    }
    /// \pre bound >= 0
    void push(const BoundedPair& pair) {
        const std::size_t list = list_of(pair.bound);
        std::uint32_t at = free_;
        if (at == none) {
            at = static_cast<std::uint32_t>(entries_.size());
            entries_.emplace_back();
        } else {
            free_ = entries_[at].next;
        }
        entries_[at] = {pair, heads_[list]};
        heads_[list] = at;
        if (list < first_) first_ = list;
        if (list > last_) last_ = list;
    }
    /// Whether there is a next pair, which is then taken.
    [[nodiscard]] bool pop(BoundedPair& pair) {
        while (first_ <= last_ && heads_[first_] == none) ++first_;
        if (first_ > last_) return false;
        const std::uint32_t at = heads_[first_];
        pair = entries_[at].pair;
        heads_[first_] = entries_[at].next;
        entries_[at].next = free_;
        free_ = at;
        return true;
    }
    [[nodiscard]] std::size_t bytes() const { return entries_.capacity() * sizeof(Entry); }

    BoundQueue() { heads_.fill(none); }

private:
    static constexpr std::uint32_t none = 0xffffffffU;
    static constexpr std::size_t list_count = 512;
    // The lists begin at 2^-24 of A's extent; boxes are at most a few extents apart, or all far.
    static constexpr std::uint32_t least = (127 - 24) << 4;
    struct Entry {
        BoundedPair pair;
        std::uint32_t next = none;
    };
    [[nodiscard]] static std::size_t list_of(float bound) {
        const std::uint32_t step = std::bit_cast<std::uint32_t>(bound) >> 19;
        if (step < least) return 0;
        return step - least < list_count - 1 ? step - least + 1 : list_count - 1;
    }

    std::array<std::uint32_t, list_count> heads_{};
    std::size_t first_ = list_count;  // no list before it, and none after the last, has a pair
    std::size_t last_ = 0;
    std::vector<Entry> entries_;
    std::uint32_t free_ = none;
};

}  // namespace trisect::detail
