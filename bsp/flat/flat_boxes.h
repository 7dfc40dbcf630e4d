// SPDX-License-Identifier: Apache-2.0
//
// FlatBoxes: a tree over boxes of the plane.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace trisect::detail {

struct FlatBox {
    std::array<double, 2> lo{};
    std::array<double, 2> hi{};

    [[nodiscard]] bool meets(const FlatBox& o) const {
        return lo[0] <= o.hi[0] && o.lo[0] <= hi[0] && lo[1] <= o.hi[1] && o.lo[1] <= hi[1];
    }
    void add(const FlatBox& o) {
        for (std::size_t k = 0; k < 2; ++k) {
            lo[k] = std::min(lo[k], o.lo[k]);
            hi[k] = std::max(hi[k], o.hi[k]);
        }
    }
};

/// Halved by centres along the longer side until few are left. O(n log n) to make. For boxes that
/// are short beside all of them, pairs take O(n log n + k).
class FlatBoxes {
public:
    explicit FlatBoxes(const std::vector<FlatBox>& boxes);

    /// visit(i, j) once for each pair of boxes that meet, in no order.
    template <class Visit>
    void for_each_pair(const Visit& visit) const {
        if (!nodes_.empty()) within(0, visit);
    }
    /// visit(i) for the boxes that meet this one.
    template <class Visit>
    void for_each_meeting(const FlatBox& box, const Visit& visit) const {
        if (!nodes_.empty()) meeting(0, box, visit);
    }

private:
    static constexpr std::uint32_t leaf_size = 6;
    struct Node {
        FlatBox box;
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::uint32_t second = 0;  // child; the first one follows; 0: a leaf
    };

    struct Item {
        FlatBox box;
        std::uint32_t number = 0;
    };

    FlatBox make(std::uint32_t begin, std::uint32_t end);

    template <class Visit>
    void within(std::uint32_t n, const Visit& visit) const {
        const Node& node = nodes_[n];
        if (node.second == 0) {
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                for (std::uint32_t j = i + 1; j < node.end; ++j) test(i, j, visit);
            return;
        }
        within(n + 1, visit);
        within(node.second, visit);
        between(n + 1, node.second, visit);
    }
    template <class Visit>
    void between(std::uint32_t m, std::uint32_t n, const Visit& visit) const {
        const Node& a = nodes_[m];
        const Node& b = nodes_[n];
        if (!a.box.meets(b.box)) return;
        if (a.second == 0 && b.second == 0) {
            for (std::uint32_t i = a.begin; i < a.end; ++i) {
                if (!items_[i].box.meets(b.box)) continue;
                for (std::uint32_t j = b.begin; j < b.end; ++j) test(i, j, visit);
            }
        } else if (b.second == 0 || (a.second != 0 && a.end - a.begin >= b.end - b.begin)) {
            between(m + 1, n, visit);
            between(a.second, n, visit);
        } else {
            between(m, n + 1, visit);
            between(m, b.second, visit);
        }
    }
    template <class Visit>
    void test(std::uint32_t i, std::uint32_t j, const Visit& visit) const {
        if (items_[i].box.meets(items_[j].box)) visit(items_[i].number, items_[j].number);
    }
    template <class Visit>
    void meeting(std::uint32_t n, const FlatBox& box, const Visit& visit) const {
        const Node& node = nodes_[n];
        if (!node.box.meets(box)) return;
        if (node.second == 0) {
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                if (items_[i].box.meets(box)) visit(items_[i].number);
            return;
        }
        meeting(n + 1, box, visit);
        meeting(node.second, box, visit);
    }

    std::vector<Item> items_;  // those of a leaf follow each other
    std::vector<Node> nodes_;
};

}  // namespace trisect::detail
