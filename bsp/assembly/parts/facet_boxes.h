// SPDX-License-Identifier: Apache-2.0
//
// FacetBoxes: a tree of boxes of facets, to find those around a segment.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Around points that are known up to an error.
struct FacetBox {
    std::array<double, 3> lo{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    std::array<double, 3> hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    std::int32_t facet = -1;

    void add(const Approximation& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], p.c[k] - error_slack * p.error);
            hi[k] = std::max(hi[k], p.c[k] + error_slack * p.error);
        }
    }
    void add(const FacetBox& box) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], box.lo[k]);
            hi[k] = std::max(hi[k], box.hi[k]);
        }
    }
    [[nodiscard]] bool meets(const FacetBox& box) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (box.hi[k] < lo[k] || box.lo[k] > hi[k]) return false;
        return true;
    }
    [[nodiscard]] bool may_contain(const Approximation& p) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (p.c[k] + error_slack * p.error < lo[k] || p.c[k] - error_slack * p.error > hi[k])
                return false;
        return true;
    }
};

/// Boxes are halved along the longest side of what is around them.
class FacetBoxes {
public:
    /// O(n log n)
    explicit FacetBoxes(PoolVector<FacetBox> boxes) : boxes_(std::move(boxes)) {
        if (!boxes_.empty()) (void)build(0, boxes_.size());
    }
    /// Calls `visit` with boxes that may contain both points, and ends where it returns false.
    template <class Visit>
    [[nodiscard]] bool all_around(const Approximation& a, const Approximation& b,
                                  const Visit& visit) const {
        return boxes_.empty() || all_around(0, a, b, visit);
    }

    /// Calls `visit` with the facets of all boxes that meet this one.
    template <class Visit>
    void for_each_meeting(const FacetBox& box, const Visit& visit) const {
        if (!boxes_.empty()) for_each_meeting(0, box, visit);
    }

private:
    static constexpr std::size_t leaf_boxes = 8;
    struct Node {
        FacetBox around;
        std::size_t begin = 0;
        std::size_t end = 0;
        std::size_t second = 0;  // child; the first one comes next; 0: a leaf
    };
    std::size_t build(std::size_t begin, std::size_t end) {
        const std::size_t number = nodes_.size();
        FacetBox around;
        for (std::size_t i = begin; i < end; ++i) around.add(boxes_[i]);
        nodes_.push_back({around, begin, end, 0});
        if (end - begin <= leaf_boxes) return number;
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (around.hi[k] - around.lo[k] > around.hi[axis] - around.lo[axis]) axis = k;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t i) {
            return boxes_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        std::nth_element(at(begin), at(middle), at(end), [&](const auto& a, const auto& b) {
            return a.lo[axis] + a.hi[axis] < b.lo[axis] + b.hi[axis];
        });
        (void)build(begin, middle);
        nodes_[number].second = build(middle, end);
        return number;
    }
    template <class Visit>
    [[nodiscard]] bool all_around(std::size_t number, const Approximation& a,
                                  const Approximation& b, const Visit& visit) const {
        const Node& node = nodes_[number];
        if (!node.around.may_contain(a) || !node.around.may_contain(b)) return true;
        if (node.second != 0)
            return all_around(number + 1, a, b, visit) && all_around(node.second, a, b, visit);
        return std::ranges::all_of(
            std::span(boxes_).subspan(node.begin, node.end - node.begin), [&](const FacetBox& box) {
                return !box.may_contain(a) || !box.may_contain(b) || visit(box.facet);
            });
    }

    template <class Visit>
    void for_each_meeting(std::size_t number, const FacetBox& box, const Visit& visit) const {
        const Node& node = nodes_[number];
        if (!node.around.meets(box)) return;
        if (node.second != 0) {
            for_each_meeting(number + 1, box, visit);
            return for_each_meeting(node.second, box, visit);
        }
        for (std::size_t i = node.begin; i < node.end; ++i)
            if (boxes_[i].meets(box)) visit(boxes_[i].facet);
    }

    PoolVector<FacetBox> boxes_;
    std::vector<Node> nodes_;
};

}  // namespace trisect::detail
