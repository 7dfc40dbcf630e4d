// SPDX-License-Identifier: Apache-2.0
//
// DisjointSets: which of n numbers were joined.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace manifold {

class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : parent_(n) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// The smaller root stays one.
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        if (a < b)
            parent_[b] = a;
        else
            parent_[a] = b;
    }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace manifold
