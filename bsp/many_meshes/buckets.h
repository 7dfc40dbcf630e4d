// SPDX-License-Identifier: Apache-2.0
//
// Buckets: items by small numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace trisect::detail {

/// Items by a number below a limit, those of one in the order in which they were added; keeps its
/// memory.
template <class Item>
class Buckets {
public:
    void clear() {
        keys_.clear();
        added_.clear();
    }
    void add(std::uint32_t key, const Item& item) {
        keys_.push_back(key);
        added_.push_back(item);
    }
    /// To be called when all were added.
    void sort(std::size_t limit) {
        // A number's end moves on to where it ends, which is where the next one begins.
        first_.assign(limit + 2, 0);
        for (const std::uint32_t k : keys_) ++first_[k + 2];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        items_.resize(added_.size());
        for (std::size_t i = 0; i < keys_.size(); ++i) items_[first_[keys_[i] + 1]++] = added_[i];
    }
    [[nodiscard]] std::span<Item> of(std::uint32_t key) {
        return std::span(items_).subspan(first_[key], first_[key + 1] - first_[key]);
    }
    [[nodiscard]] bool has(std::uint32_t key) const { return first_[key] != first_[key + 1]; }

private:
    std::vector<std::uint32_t> keys_;
    std::vector<Item> added_;
    std::vector<std::uint32_t> first_;
    std::vector<Item> items_;
};

}  // namespace trisect::detail
