// SPDX-License-Identifier: Apache-2.0
//
// One long part costs a pass over what lies beside it.
#include "clash_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trisect::app {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t sweep_axis(std::span<const ClashBox> boxes) {
    std::array<double, 3> lo{infinity, infinity, infinity};
    std::array<double, 3> hi{-infinity, -infinity, -infinity};
    std::array<double, 3> sum{};
    for (const ClashBox& b : boxes)
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], b.box.lo[k]);
            hi[k] = std::max(hi[k], b.box.hi[k]);
            sum[k] += b.box.hi[k] - b.box.lo[k];
        }
    std::size_t best = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (sum[k] * (hi[best] - lo[best]) < sum[best] * (hi[k] - lo[k])) best = k;
    return best;
}

// Whether the sum of the first two, rounded upwards, is less: rarely is that near.
bool is_less(double hi, double within, double lo) {
    return hi + within < lo && next_above(hi + within) < lo;
}

bool meet(const Bounds& a, const Bounds& b, double within) {
    for (std::size_t k = 0; k < 3; ++k)
        if (is_less(a.hi[k], within, b.lo[k]) || is_less(b.hi[k], within, a.lo[k])) return false;
    return true;
}

bool has_place_in(const Bounds& cell, const Bounds& a, const Bounds& b) {
    for (std::size_t k = 0; k < 3; ++k) {
        const double corner = std::max(a.lo[k], b.lo[k]);
        if (corner < cell.lo[k] || !(corner < cell.hi[k])) return false;
    }
    return true;
}

}  // namespace

Bounds posed_box(const Bounds& box, const std::array<double, 12>& pose) {
    Bounds out;
    for (std::size_t i = 0; i < 3; ++i) {
        double lo = pose[4 * i + 3];
        double hi = lo;
        double size = std::fabs(lo);
        for (std::size_t j = 0; j < 3; ++j) {
            const double p = pose[4 * i + j] * next_below(box.lo[j]);
            const double q = pose[4 * i + j] * next_above(box.hi[j]);
            lo += std::min(p, q);
            hi += std::max(p, q);
            size += std::max(std::fabs(p), std::fabs(q));
        }
        const double error = size * 0x1p-49;
        out.lo[i] = next_below(lo - error);
        out.hi[i] = next_above(hi + error);
    }
    return out;
}

ClashLimits::ClashLimits(std::span<const ClashSet> sets, std::size_t groups)
    : groups_(groups), limits_(groups * groups, -1) {
    for (std::uint32_t g = 0; g < groups_; ++g)
        for (std::uint32_t h = 0; h < groups_; ++h)
            for (const ClashSet& set : sets)
                if (set.has(g, h))
                    limits_[g * groups_ + h] = std::max(limits_[g * groups_ + h], set.clearance);
    for (const double limit : limits_) most_ = std::max(most_, limit);
}

bool is_candidate(const ClashLimits& limits, const ClashBox& a, const ClashBox& b) {
    const double limit = limits.of(a.group, b.group);
    return limit >= 0 && meet(a.box, b.box, limit);
}

// Where lower ends are the same, by place, so that shares of other processes are the same.
ClashSweep::ClashSweep(const ClashLimits& limits, std::span<const ClashBox> boxes) {
    const std::size_t axis = sweep_axis(boxes);
    items_.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        items_.push_back(
            {boxes[i].box.lo[axis], next_above(boxes[i].box.hi[axis] + limits.most()), i});
    std::ranges::sort(items_, {}, [](const Item& item) { return std::pair(item.lo, item.at); });
}

void ClashSweep::add_candidates(const ClashLimits& limits, std::span<const ClashBox> boxes,
                                const Bounds& cell, const ClashShare& share,
                                std::vector<ClashCandidate>& out) const {
    for (std::size_t i = share.number; i < items_.size(); i += share.count)
        for (std::size_t j = i + 1; j < items_.size() && items_[j].lo <= items_[i].hi; ++j) {
            const ClashBox& p = boxes[items_[i].at];
            const ClashBox& q = boxes[items_[j].at];
            if (!is_candidate(limits, p, q) || !has_place_in(cell, p.box, q.box)) continue;
            out.push_back({std::min(p.part, q.part), std::max(p.part, q.part)});
        }
}

void add_candidates(const ClashLimits& limits, std::span<const ClashBox> boxes, const Bounds& cell,
                    std::vector<ClashCandidate>& out) {
    ClashSweep(limits, boxes).add_candidates(limits, boxes, cell, {}, out);
}

}  // namespace trisect::app
