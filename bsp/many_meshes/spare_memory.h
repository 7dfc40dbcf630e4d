// SPDX-License-Identifier: Apache-2.0
//
// SpareMemory: vectors that were used up, for the next ones.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace trisect::detail {

/// Each step of an evaluation leaves the vectors of two solids behind and wants those of one. From
/// the system they would come as pages that are cleared each time.
template <class Vector>
class SpareMemory {
public:
    /// An empty one with room for so many.
    [[nodiscard]] Vector take(std::size_t count) {
        Vector* best = nullptr;
        for (Vector& v : spare_)
            if (v.capacity() >= count && v.capacity() <= most_unused * count &&
                (best == nullptr || v.capacity() < best->capacity()))
                best = &v;
        Vector out;
        if (best != nullptr) out = std::move(*best);
        out.clear();
        out.reserve(count);
        return out;
    }
    void give_back(Vector&& v) {
        if (v.capacity() < least) return;
        Vector& smallest = *std::min_element(
            spare_.begin(), spare_.end(),
            [](const Vector& a, const Vector& b) { return a.capacity() < b.capacity(); });
        if (v.capacity() > smallest.capacity()) smallest = std::move(v);
    }

private:
    static constexpr std::size_t least = 64;       // what is smaller the heap has at once
    static constexpr std::size_t most_unused = 3;  // times what is wanted
    std::array<Vector, 4> spare_;
};

}  // namespace trisect::detail
