// SPDX-License-Identifier: Apache-2.0
//
// Dividing space is the other way round from bounding volumes: cells do not move with the body, so
// what moves has to be entered anew. We divide for A, take poses relative, and pay an update for
// every triangle of B where a hierarchy pays one for each volume that it comes to. That is the
// price that the cost function shows.
//
// For distances the triangles of B come in the order of their distance from A's bounds, so the
// limit is good early, and those beyond it end the search.

#include <trisect/bsp/hierarchies/partitions/partition.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <trisect/bsp/interference/boxes/box_gap.h>

namespace trisect::hierarchies {

void Partition::update(CostCounters& counters) {
    moved_.move(data_b(), placement());
    counters.updates += moved_.size();
}

void Partition::next_stamp() {
    if (++stamp_ != 0) return;
    std::fill(stamps_.begin(), stamps_.end(), 0);
    stamp_ = 1;
}

bool Partition::find_candidates(PairVisit visit, CostCounters& counters) {
    ++counters.volume_tests;
    if (!fixed_.bounds().meets(moved_.bounds())) return false;
    for (std::uint32_t b = 0; b < moved_.size(); ++b) {
        const Box& box = moved_[b];
        ++counters.volume_tests;
        if (!box.meets(fixed_.bounds())) continue;
        next_stamp();
        const auto offer = [&](std::uint32_t a) {
            if (!is_first(a)) return false;
            ++counters.volume_tests;
            return fixed_[a].meets(box) && visit(a, b);
        };
        if (find_for(b, offer, counters)) return true;
    }
    return false;
}

void Partition::find_near(double limit, NearVisit visit, CostCounters& counters) {
    std::vector<std::pair<double, std::uint32_t>> order(moved_.size());
    for (std::uint32_t b = 0; b < moved_.size(); ++b)
        order[b] = {gap_between(moved_[b], fixed_.bounds()), b};
    counters.volume_tests += order.size();
    std::sort(order.begin(), order.end());
    for (const auto& [least, b] : order) {
        if (least > limit) return;
        const Box& box = moved_[b];
        next_stamp();
        const auto offer = [&, number = b](std::uint32_t a) {
            if (!is_first(a)) return limit;
            ++counters.volume_tests;
            if (!(gap_between(fixed_[a], box) > limit)) limit = visit(a, number);
            return limit;
        };
        find_near_cells(box, limit, offer, counters);
    }
}

VolumeOutline Partition::outline_of(const Box& cell, unsigned level, bool is_leaf) const {
    VolumeOutline out;
    out.level = level;
    out.is_leaf = is_leaf;
    const int exponent = model_a().lattice().exponent;
    for (std::size_t k = 0; k < 3; ++k) {
        Slab slab{{}, std::ldexp(cell.lo[k], exponent), std::ldexp(cell.hi[k], exponent)};
        slab.direction[k] = 1;
        out.slabs.push_back(slab);
    }
    return out;
}

}  // namespace trisect::hierarchies
