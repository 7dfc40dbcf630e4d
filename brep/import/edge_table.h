// SPDX-License-Identifier: Apache-2.0
//
// EdgeTable: all traversals of every undirected edge, side by side.
//
// Traversals are dealt to the lower end of their edge by counting, and each short list is sorted by
// the upper end. Unlike hashing this is deterministic, cannot be attacked, and runs through memory
// nearly in order, because the faces of a mesh mostly are near their neighbours in the file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace trisect::detail {

/// One traversal of an edge by a face's loop.
struct EdgeUse {
    std::uint32_t high;  ///< the upper end of the edge
    std::uint32_t key;   ///< 2·face + 1 from low to high, 2·face from high to low

    [[nodiscard]] std::uint32_t face() const { return key / 2; }
    [[nodiscard]] bool is_forward() const { return (key & 1U) != 0; }
};

class EdgeTable {
public:
    /// Loops as in PolygonMesh; sides that join a point to itself are left out.
    /// \pre fewer than 2^31 loops. Cost: O(n), and O(d log d) at a vertex of degree d.
    EdgeTable(std::size_t point_count, std::span<const std::uint32_t> loop_begin,
              std::span<const std::uint32_t> corners)
        : begin_(point_count + 2, 0) {
        count_uses(loop_begin, corners);
        deal_uses(loop_begin, corners);
        for (std::size_t v = 0; v + 1 < begin_.size(); ++v)
            sort_uses({uses_.data() + begin_[v], uses_.data() + begin_[v + 1]});
    }

    /// Calls visit(low, high, uses) for every edge, in lexicographic order.
    template <class Visit>
    void for_each_edge(Visit&& visit) const {
        for (std::size_t v = 0; v + 1 < begin_.size(); ++v) {
            std::size_t i = begin_[v];
            while (i < begin_[v + 1]) {
                std::size_t end = i + 1;
                while (end < begin_[v + 1] && uses_[end].high == uses_[i].high) ++end;
                visit(static_cast<std::uint32_t>(v), uses_[i].high,
                      std::span<const EdgeUse>(uses_.data() + i, end - i));
                i = end;
            }
        }
    }

private:
    template <class Visit>
    static void for_each_side(std::span<const std::uint32_t> loop_begin,
                              std::span<const std::uint32_t> corners, Visit&& visit) {
        for (std::size_t f = 0; f + 1 < loop_begin.size(); ++f) {
            if (loop_begin[f] == loop_begin[f + 1]) continue;
            std::uint32_t a = corners[loop_begin[f + 1] - 1];
            for (std::size_t i = loop_begin[f]; i < loop_begin[f + 1]; ++i) {
                const std::uint32_t b = corners[i];
                if (a != b) visit(static_cast<std::uint32_t>(f), a, b);
                a = b;
            }
        }
    }
    void count_uses(std::span<const std::uint32_t> loop_begin,
                    std::span<const std::uint32_t> corners) {
        for_each_side(loop_begin, corners, [this](std::uint32_t, std::uint32_t a, std::uint32_t b) {
            ++begin_[std::size_t{std::min(a, b)} + 2];
        });
        for (std::size_t v = 2; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    }
    // Uses begin_[v + 1] as the place for the next use of v, which makes it the end of v's list.
    void deal_uses(std::span<const std::uint32_t> loop_begin,
                   std::span<const std::uint32_t> corners) {
        uses_.resize(begin_.back());
        for_each_side(loop_begin, corners,
                      [this](std::uint32_t f, std::uint32_t a, std::uint32_t b) {
                          const bool forward = a < b;
                          uses_[begin_[std::size_t{forward ? a : b} + 1]++] = {
                              forward ? b : a, 2 * f + (forward ? 1U : 0U)};
                      });
        begin_.pop_back();
    }
    static void sort_uses(std::span<EdgeUse> uses) {
        const auto less = [](const EdgeUse& a, const EdgeUse& b) {
            return a.high != b.high ? a.high < b.high : a.key < b.key;
        };
        if (uses.size() > 16) {
            std::sort(uses.begin(), uses.end(), less);
            return;
        }
        for (std::size_t i = 1; i < uses.size(); ++i)
            for (std::size_t k = i; k > 0 && less(uses[k], uses[k - 1]); --k)
                std::swap(uses[k], uses[k - 1]);
    }

    std::vector<std::uint32_t> begin_;
    std::vector<EdgeUse> uses_;
};

}  // namespace trisect::detail
