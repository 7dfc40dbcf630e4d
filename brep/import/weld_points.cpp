// SPDX-License-Identifier: Apache-2.0
//
// An open-addressing table of 32-bit indices, at most half full, is the cheapest way to find equal
// points: one cache line a point. These lines are spread over the whole table, so a block of points
// is hashed and its lines are prefetched before the first of them is needed.
//
// The hash is fixed (results must not depend on a run), so an input can be made whose points all
// collide; the total number of probes is therefore bounded and beyond it the points are sorted
// instead. Both ways give the same numbering.

#include <trisect/brep/import/weld_points.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>

namespace trisect::detail {

namespace {

constexpr std::uint32_t empty_slot = std::numeric_limits<std::uint32_t>::max();

// The bits of small integers are at the upper end of doubles, so they are brought down first.
std::uint64_t hash(const LatticePoint& p) {
    const auto bits = [](Coordinate c) { return std::rotl(c.bits(), 32); };
    auto h = bits(p.x) * 0x9e3779b97f4a7c15U;
    h = std::rotl(h, 29) ^ (bits(p.y) * 0xc2b2ae3d27d4eb4fU);
    h = std::rotl(h, 31) ^ (bits(p.z) * 0x165667b19e3779f9U);
    h ^= h >> 32;
    h *= 0xd6e8feb86659fd93U;
    return h ^ (h >> 29);
}

// Finds, of each point, the first index with the same value.
class FirstByHash {
public:
    FirstByHash(std::span<const LatticePoint> points, std::size_t expected)
        : points_(points),
          table_(std::bit_ceil(2 * std::min(expected, points.size()) + 2), empty_slot),
          probes_left_(static_cast<std::ptrdiff_t>(32 * points.size() + 1024)) {}

    // Fills `first`, or leaves it empty when all points are distinct; false when probing takes too
    // long.
    bool run(std::vector<std::uint32_t>& first) {
        constexpr std::size_t block = 64;
        std::array<std::uint64_t, block> hashes{};
        for (std::size_t begin = 0; begin < points_.size(); begin += block) {
            const std::size_t n = std::min(block, points_.size() - begin);
            make_room(n, begin, first);
            for (std::size_t i = 0; i < n; ++i) {
                hashes[i] = hash(points_[begin + i]);
                __builtin_prefetch(&table_[hashes[i] & (table_.size() - 1)]);
            }
            for (std::size_t i = 0; i < n; ++i) {
                const auto index = static_cast<std::uint32_t>(begin + i);
                const std::uint32_t found = insert(index, hashes[i]);
                if (found != index && first.empty()) begin_list(first, index);
                if (!first.empty()) first[index] = found;
            }
            if (probes_left_ < 0) return false;
        }
        return true;
    }

private:
    std::uint32_t insert(std::uint32_t index, std::uint64_t h) {
        const std::size_t mask = table_.size() - 1;
        std::size_t slot = h & mask;
        while (table_[slot] != empty_slot) {
            if (points_[table_[slot]] == points_[index]) return table_[slot];
            slot = (slot + 1) & mask;
            if (--probes_left_ < 0) return index;  // the result is not used
        }
        table_[slot] = index;
        ++distinct_;
        return index;
    }

    // Keeps the table at most half full while `n` more points come; `done` ones are in it.
    void make_room(std::size_t n, std::size_t done, std::span<const std::uint32_t> first) {
        if (2 * (distinct_ + n) <= table_.size() || 2 * points_.size() <= table_.size()) return;
        table_.assign(std::bit_ceil(std::min(4 * (distinct_ + n), 2 * points_.size())), empty_slot);
        distinct_ = 0;
        for (std::size_t i = 0; i < done; ++i)
            if (first.empty() || first[i] == i)
                insert(static_cast<std::uint32_t>(i), hash(points_[i]));
    }

    void begin_list(std::vector<std::uint32_t>& first, std::uint32_t index) const {
        first.resize(points_.size());
        std::iota(first.begin(), first.begin() + index, 0U);
    }

    std::span<const LatticePoint> points_;
    std::vector<std::uint32_t> table_;
    std::size_t distinct_ = 0;
    std::ptrdiff_t probes_left_;
};

void find_first_by_sorting(std::span<const LatticePoint> points,
                           std::vector<std::uint32_t>& first) {
    std::vector<std::uint32_t> order(points.size());
    first.resize(points.size());
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

// Of each point the first index with the same value; may be empty when all are distinct.
std::vector<std::uint32_t> find_first(std::span<const LatticePoint> points, std::size_t expected) {
    std::vector<std::uint32_t> first;
    if (!FirstByHash(points, expected).run(first)) find_first_by_sorting(points, first);
    return first;
}

}  // namespace

WeldedPoints weld_points(std::span<const LatticePoint> points) {
    WeldedPoints out;
    out.id = find_first(points, points.size());
    if (out.id.empty()) {
        out.id.resize(points.size());
        std::iota(out.id.begin(), out.id.end(), 0U);
        out.points.assign(points.begin(), points.end());
        out.first = out.id;
        return out;
    }
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

std::vector<std::uint32_t> weld_in_place(std::vector<LatticePoint>& points, std::size_t expected) {
    std::vector<std::uint32_t> id = find_first(points, expected);
    if (id.empty()) return id;
    std::uint32_t n = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (id[i] == i) {
            points[n] = points[i];
            id[i] = n++;
        } else {
            id[i] = id[id[i]];
        }
    }
    points.resize(n);
    return id;
}

}  // namespace trisect::detail
