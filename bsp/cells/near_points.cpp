// SPDX-License-Identifier: Apache-2.0
//
// Every point has an enclosure, its doubles with their error. Enclosures of equal points overlap
// along all three axes. A hash table over the cells of a fine grid finds what may overlap: nearly
// all points are alone in their cell, and most others have a few equal ones for company. Only where
// many points share cells: sort along an axis and cut where a gap
// shows; enclosures that chain together stay in one group. Go on with the next axis within each
// group, until no axis cuts.
//
// A sweep along one axis alone compares every pair that overlaps there, which on models with axis
// parallel faces, where a tenth of all vertices may share one x, is quadratic.

#include <trisect/bsp/cells/near_points.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

// Somewhat wider than the error bound, for the rounding of its ends.
double reach(const Approximation& a, std::size_t axis) {
    return error_slack * a.error + 0x1p-50 * std::fabs(a.c[axis]);
}

// Connects the points that share a cell of a grid. An enclosure belongs to all cells that it meets,
// so those that overlap have a cell in common. Cells are some dozens of times larger than the
// largest enclosure, so nearly all enclosures meet one cell, and still far smaller than what models
// are made of, so that few points share one without need. Cells of equal hashes count as one; that
// costs time only.
class Neighbours {
public:
    Neighbours(const Workbench& bench, std::uint32_t threads)
        : bench_(bench), per_unit_(1 / size_of_cell(bench, threads)), root_(bench.point_count()) {
        const ParallelParts parts(bench.point_count(), threads, least_points);
        std::vector<PoolVector<Entry>> entries(parts.count());
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            entries[part].reserve(end - begin + (end - begin) / 4);
            for (std::size_t p = begin; p < end; ++p) {
                add(static_cast<PointId>(p), entries[part]);
                root_[p] = static_cast<PointId>(p);
            }
        });
        connect(entries, threads);
    }

    /// The groups of two and more, one after the other, each in the order of ids.
    [[nodiscard]] PoolVector<PointId> grouped() {
        PoolVector<std::pair<PointId, PointId>> order;  // smallest of the group, point
        for (std::size_t p = 0; p < root_.size(); ++p) {
            const PointId r = root(static_cast<PointId>(p));
            if (as_index(r) == p) continue;
            order.emplace_back(r, static_cast<PointId>(p));
        }
        std::sort(order.begin(), order.end());
        PoolVector<PointId> out;
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (i == 0 || order[i].first != order[i - 1].first) out.push_back(order[i].first);
            out.push_back(order[i].second);
        }
        return out;
    }
    /// The smallest point of a point's group.
    [[nodiscard]] PointId root(PointId p) {
        while (root_[as_index(p)] != p)
            p = root_[as_index(p)] = root_[as_index(root_[as_index(p)])];
        return p;
    }

private:
    struct Entry {
        std::uint64_t cell = 0;  // hash
        PointId point = -1;
    };

    static constexpr std::size_t least_points = 8192;  // fewer are not worth a part

    static double size_of_cell(const Workbench& bench, std::uint32_t threads) {
        const ParallelParts parts(bench.point_count(), threads, least_points);
        std::vector<double> of_parts(parts.count());
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            double widest = 0;
            for (std::size_t p = begin; p < end; ++p) {
                const Approximation& a = bench.approximation(static_cast<PointId>(p));
                for (std::size_t k = 0; k < 3; ++k) widest = std::max(widest, reach(a, k));
            }
            of_parts[part] = widest;
        });
        const double widest = std::ranges::max(of_parts);
        return widest > 0 ? 64 * widest : 1;
    }

    // The number of a cell along an axis; the one around zero is twice as wide. At most 2^44, as
    // the largest coordinate reaches 2^-50 of it.
    [[nodiscard]] std::int64_t cell_at(double c) const {
        return static_cast<std::int64_t>(c * per_unit_);
    }

    void add(PointId p, PoolVector<Entry>& entries) const {
        const Approximation& a = bench_.approximation(p);
        std::array<std::int64_t, 3> lo{};
        std::array<std::int64_t, 3> hi{};
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = cell_at(a.c[k] - reach(a, k));
            hi[k] = cell_at(a.c[k] + reach(a, k));
        }
        for (std::int64_t x = lo[0]; x <= hi[0]; ++x)
            for (std::int64_t y = lo[1]; y <= hi[1]; ++y)
                for (std::int64_t z = lo[2]; z <= hi[2]; ++z) entries.push_back({hash(x, y, z), p});
    }

    static std::uint64_t hash(std::int64_t x, std::int64_t y, std::int64_t z) {
        constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;
        return mix64(static_cast<std::uint64_t>(x) +
                     odd * (static_cast<std::uint64_t>(y) + odd * static_cast<std::uint64_t>(z)));
    }

    // Which points have a cell in common is found by several threads, each of which has a table of
    // some of the cells. The smallest point of a group is the same in whatever order they come.
    void connect(std::span<const PoolVector<Entry>> entries, std::uint32_t threads) {
        std::size_t all = 0;
        for (const auto& part : entries) all += part.size();
        const std::size_t count =
            entries.size() == 1 ? 1 : parts_by_thread(all, threads, least_points).count();
        std::vector<PoolVector<std::pair<PointId, PointId>>> pairs(count);
        ParallelParts(count, count == 1 ? 1 : threads, 1)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t t = begin; t < end; ++t)
                    find_pairs(entries, {t, count}, all, pairs[t]);
            });
        for (const auto& list : pairs)
            for (const auto& [p, q] : list) {
                const PointId a = root(p);
                const PointId b = root(q);
                root_[as_index(std::max(a, b))] = std::min(a, b);
            }
    }

    // One of so many tables.
    struct Table {
        std::size_t number = 0;
        std::size_t count = 1;
        [[nodiscard]] bool has(std::uint64_t cell) const {
            return count == 1 || (cell >> 32U) % count == number;
        }
    };
    // A table holds entries, one for each cell.
    static void find_pairs(std::span<const PoolVector<Entry>> entries, const Table& of,
                           std::size_t all, PoolVector<std::pair<PointId, PointId>>& pairs) {
        std::size_t own = all;
        if (of.count != 1) {
            own = 0;
            for (const auto& part : entries)
                for (const Entry& e : part) own += of.has(e.cell) ? 1 : 0;
        }
        PoolVector<const Entry*> table(std::bit_ceil(2 * own + 1), nullptr);
        const std::size_t mask = table.size() - 1;
        for (const auto& part : entries)
            for (const Entry& e : part) {
                if (!of.has(e.cell)) continue;
                std::size_t i = e.cell & mask;
                while (table[i] != nullptr && table[i]->cell != e.cell) i = (i + 1) & mask;
                if (table[i] == nullptr) {
                    table[i] = &e;
                } else {
                    pairs.emplace_back(table[i]->point, e.point);
                }
            }
    }

    const Workbench& bench_;
    double per_unit_;
    PoolVector<PointId> root_;
};

struct PointRange {
    double low = 0;
    double high = 0;
    PointId point = -1;
};

class Groups {
public:
    Groups(const Workbench& bench, const std::function<void(std::span<const PointId>)>& visit)
        : bench_(bench), visit_(visit) {}

    /// Points that may be equal only among themselves, in the order of ids.
    void divide(std::span<const PointId> points) {
        if (points.size() <= few) return visit_(points);
        ranges_.clear();
        for (const PointId p : points) ranges_.push_back({0, 0, p});
        part(ranges_, 0, 0);
    }

private:
    // `uncut`: how many axes before this one left the group as it is.
    void part(std::span<PointRange> group, std::size_t axis, int uncut);
    void measure(std::span<PointRange> group, std::size_t axis) const;
    void emit(std::span<const PointRange> group);

    static constexpr std::size_t few = 16;
    const Workbench& bench_;
    const std::function<void(std::span<const PointId>)>& visit_;
    std::vector<PointRange> ranges_;
    std::vector<PointId> points_;
};

void Groups::measure(std::span<PointRange> group, std::size_t axis) const {
    for (PointRange& r : group) {
        const Approximation& a = bench_.approximation(r.point);
        r.low = a.c[axis] - reach(a, axis);
        r.high = a.c[axis] + reach(a, axis);
    }
    std::sort(group.begin(), group.end(), [](const PointRange& a, const PointRange& b) {
        return std::tie(a.low, a.point) < std::tie(b.low, b.point);
    });
}

void Groups::part(std::span<PointRange> group, std::size_t axis, int uncut) {
    if (group.size() < 2) return;
    if (uncut == 3) return emit(group);
    measure(group, axis);
    for (std::size_t begin = 0; begin < group.size();) {
        double high = group[begin].high;
        std::size_t end = begin + 1;
        for (; end < group.size() && group[end].low <= high; ++end)
            high = std::max(high, group[end].high);
        const bool whole = end - begin == group.size();
        part(group.subspan(begin, end - begin), (axis + 1) % 3, whole ? uncut + 1 : 1);
        begin = end;
    }
}

void Groups::emit(std::span<const PointRange> group) {
    points_.clear();
    for (const PointRange& r : group) points_.push_back(r.point);
    std::sort(points_.begin(), points_.end());
    visit_(points_);
}

}  // namespace

void for_each_near_group(const Workbench& bench,
                         const std::function<void(std::span<const PointId>)>& visit,
                         std::uint32_t threads) {
    Neighbours neighbours(bench, threads);
    Groups groups(bench, visit);
    const PoolVector<PointId> points = neighbours.grouped();
    for (std::size_t i = 0; i < points.size();) {
        std::size_t j = i + 1;
        while (j < points.size() && neighbours.root(points[j]) == points[i]) ++j;
        groups.divide(std::span(points).subspan(i, j - i));
        i = j;
    }
}

}  // namespace trisect::detail
