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
#include <atomic>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t empty_slot = std::numeric_limits<std::uint32_t>::max();

// Fewer are not worth a look at the hashes of all.
constexpr std::size_t least_hashed_points = 8192;

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

// A set of points by their values, as indices: of equal ones the one that came first.
class PointSet {
public:
    PointSet(std::span<const LatticePoint> points, std::size_t expected, std::size_t most)
        : points_(points),
          most_(most),
          table_(std::bit_ceil(2 * std::min(expected, most) + 2), empty_slot),
          probes_left_(static_cast<std::ptrdiff_t>(32 * most + 1024)) {}

    [[nodiscard]] bool takes_too_long() const { return probes_left_ < 0; }
    void prefetch(std::uint64_t h) const { __builtin_prefetch(&table_[h & (table_.size() - 1)]); }

    // The first one with the value, which may be this one.
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

    // Keeps the table at most half full while `n` more points come.
    void make_room(std::size_t n) {
        if (2 * (distinct_ + n) <= table_.size() || 2 * most_ <= table_.size()) return;
        const std::vector<std::uint32_t> old = std::exchange(
            table_, std::vector<std::uint32_t>(
                        std::bit_ceil(std::min(4 * (distinct_ + n), 2 * most_)), empty_slot));
        distinct_ = 0;
        for (const std::uint32_t i : old)
            if (i != empty_slot) insert(i, hash(points_[i]));
    }

private:
    std::span<const LatticePoint> points_;
    std::size_t most_;
    std::vector<std::uint32_t> table_;
    std::size_t distinct_ = 0;
    std::ptrdiff_t probes_left_;
};

constexpr std::size_t hash_block = 64;

// Fills `first` with the first index of the same value, or leaves it empty when all points are
// distinct; false when probing takes too long.
bool find_first_by_hash(std::span<const LatticePoint> points, std::size_t expected,
                        std::vector<std::uint32_t>& first) {
    PointSet set(points, expected, points.size());
    std::array<std::uint64_t, hash_block> hashes{};
    for (std::size_t begin = 0; begin < points.size(); begin += hash_block) {
        const std::size_t n = std::min(hash_block, points.size() - begin);
        set.make_room(n);
        for (std::size_t i = 0; i < n; ++i) {
            hashes[i] = hash(points[begin + i]);
            set.prefetch(hashes[i]);
        }
        for (std::size_t i = 0; i < n; ++i) {
            const auto index = static_cast<std::uint32_t>(begin + i);
            const std::uint32_t found = set.insert(index, hashes[i]);
            if (found != index && first.empty()) {
                first.resize(points.size());
                std::iota(first.begin(), first.begin() + index, 0U);
            }
            if (!first.empty()) first[index] = found;
        }
        if (set.takes_too_long()) return false;
    }
    return true;
}

// A point that is equal to an earlier one, the first of them.
using Repeated = std::pair<std::uint32_t, std::uint32_t>;

// Those among the points whose hashes lie in one of several equal ranges; false when probing takes
// too long.
bool find_repeated(std::span<const LatticePoint> points, std::span<const std::uint64_t> hashes,
                   std::size_t range, std::size_t ranges, std::size_t expected,
                   std::vector<Repeated>& repeated) {
    PointSet set(points, expected / ranges, points.size());
    std::array<std::uint32_t, hash_block> block{};
    for (std::size_t at = 0; at < points.size();) {
        std::size_t n = 0;
        for (; at < points.size() && n < hash_block; ++at) {
            block[n] = static_cast<std::uint32_t>(at);
            n += (hashes[at] >> 32) * ranges >> 32 == range ? 1 : 0;
        }
        set.make_room(n);
        for (std::size_t i = 0; i < n; ++i) set.prefetch(hashes[block[i]]);
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint32_t found = set.insert(block[i], hashes[block[i]]);
            if (found != block[i]) repeated.emplace_back(block[i], found);
        }
        if (set.takes_too_long()) return false;
    }
    return true;
}

// Equal points have equal hashes, so each thread has the points of a range of these.
bool find_first_on_threads(std::span<const LatticePoint> points, std::size_t expected,
                           const ParallelParts& parts, std::vector<std::uint32_t>& first) {
    const PoolArray<std::uint64_t> hashes(points.size());
    parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) hashes[i] = hash(points[i]);
    });
    std::vector<std::vector<Repeated>> repeated(parts.count());
    std::atomic<bool> done{true};
    parts.for_each([&](std::size_t part, std::size_t, std::size_t) {
        if (!find_repeated(points, {hashes.get(), points.size()}, part, parts.count(), expected,
                           repeated[part]))
            done = false;
    });
    if (!done) return false;
    if (std::ranges::all_of(repeated, &std::vector<Repeated>::empty)) return true;
    first.resize(points.size());
    std::iota(first.begin(), first.end(), 0U);
    for (const auto& of_part : repeated)
        for (const auto& [index, of_first] : of_part) first[index] = of_first;
    return true;
}

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
std::vector<std::uint32_t> find_first(std::span<const LatticePoint> points, std::size_t expected,
                                      std::uint32_t threads = 1) {
    std::vector<std::uint32_t> first;
    const ParallelParts parts = parts_by_thread(points.size(), threads, least_hashed_points);
    const bool done = parts.count() == 1 ? find_first_by_hash(points, expected, first)
                                         : find_first_on_threads(points, expected, parts, first);
    if (!done) find_first_by_sorting(points, first);
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

std::vector<std::uint32_t> weld_in_place(std::vector<LatticePoint>& points, std::size_t expected,
                                         std::uint32_t threads) {
    std::vector<std::uint32_t> id = find_first(points, expected, threads);
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
