// SPDX-License-Identifier: Apache-2.0
//
// An open-addressing table of 32-bit indices, half empty, is the cheapest way to find equal points:
// one cache line a point. The hash is fixed (results must not depend on a run), so an input can be
// made whose points all collide; the total number of probes is therefore bounded and beyond it the
// points are sorted instead. Both ways give the same numbering.

#include <trisect/brep/detail/weld_points.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace trisect::detail {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

std::uint64_t hash(const LatticePoint& p) {
    auto h = static_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15U;
    h = std::rotl(h, 29) ^ (static_cast<std::uint64_t>(p.y) * 0xc2b2ae3d27d4eb4fU);
    h = std::rotl(h, 31) ^ (static_cast<std::uint64_t>(p.z) * 0x165667b19e3779f9U);
    h ^= h >> 32;
    h *= 0xd6e8feb86659fd93U;
    return h ^ (h >> 29);
}

// Of each point, the first index with the same value; false when probing takes too long.
bool find_first_by_hash(std::span<const LatticePoint> points, std::vector<std::uint32_t>& first) {
    const std::size_t capacity = std::bit_ceil(points.size() * 2 + 2);
    const std::size_t mask = capacity - 1;
    std::vector<std::uint32_t> table(capacity, none);
    std::size_t probes_left = 32 * points.size() + 1024;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::size_t slot = hash(points[i]) & mask;
        while (table[slot] != none && points[table[slot]] != points[i]) {
            slot = (slot + 1) & mask;
            if (--probes_left == 0) return false;
        }
        if (table[slot] == none) table[slot] = static_cast<std::uint32_t>(i);
        first[i] = table[slot];
    }
    return true;
}

void find_first_by_sorting(std::span<const LatticePoint> points,
                           std::vector<std::uint32_t>& first) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto c = points[a] <=> points[b];
        return c != 0 ? c < 0 : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
}

}  // namespace

WeldedPoints weld_points(std::span<const LatticePoint> points) {
    WeldedPoints out;
    out.id.resize(points.size());
    if (!find_first_by_hash(points, out.id)) find_first_by_sorting(points, out.id);
    out.points.reserve(points.size());
    out.first.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (out.id[i] == i) {
            out.id[i] = static_cast<std::uint32_t>(out.points.size());
            out.points.push_back(points[i]);
            out.first.push_back(static_cast<std::uint32_t>(i));
        } else {
            out.id[i] = out.id[out.id[i]];  // an earlier point, numbered already
        }
    }
    return out;
}

}  // namespace trisect::detail
