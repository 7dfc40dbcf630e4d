// SPDX-License-Identifier: Apache-2.0
//
// Many points at once, in an order in which neighbours come after each other: by leaf of the grid
// where there is one, otherwise by place. On several threads, too, all of them are sorted together:
// were each part sorted by itself, every thread would walk through the whole tree.

#include <algorithm>
#include <bit>
#include <vector>

#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/query/points/batch_in_grid.h>
#include <trisect/bsp/query/points/batch_in_tree.h>
#include <trisect/bsp/query/points/batch_sinks.h>
#include <trisect/bsp/query/points/place_order.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

using Points = std::span<const std::array<double, 3>>;

// Numbers of the points of all lists, by leaf: a counting sort by the leading bits of the leaf.
template <class PointOfLeaf>
std::vector<std::uint32_t> in_order_of_leaves(const std::vector<std::vector<PointOfLeaf>>& lists) {
    std::size_t count = 0;
    std::uint32_t last = 0;
    for (const auto& list : lists) {
        count += list.size();
        for (const auto& [leaf, point] : list) last = std::max(last, leaf);
    }
    const auto width = [](std::size_t v) { return static_cast<int>(std::bit_width(v)); };
    const int wanted = std::min(14, width(count));
    const auto shift = static_cast<unsigned>(std::max(width(last) - wanted, 0));
    std::vector<std::uint32_t> begin((std::size_t{last} >> shift) + 2, 0);
    for (const auto& list : lists)
        for (const auto& [leaf, point] : list) ++begin[(leaf >> shift) + 1];
    for (std::size_t b = 1; b < begin.size(); ++b) begin[b] += begin[b - 1];
    std::vector<std::uint32_t> order(count);
    for (const auto& list : lists)
        for (const auto& [leaf, point] : list) order[begin[leaf >> shift]++] = point;
    return order;
}

template <class Sink>
void locate_in_grid(const IndexBase& index, const IndexedLeaf& leaf, Points points,
                    unsigned threads, const Sink& sink) {
    const ParallelParts parts(points.size(), threads);
    std::vector<std::vector<typename BatchInGrid<Sink>::PointOfLeaf>> mixed(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        BatchInGrid<Sink>(index, leaf, points, sink).find_empty(begin, end, mixed[part]);
    });
    const std::vector<std::uint32_t> order = in_order_of_leaves(mixed);
    ParallelParts(order.size(), threads)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            BatchInGrid<Sink>(index, leaf, points, sink)
                .find_mixed(std::span(order).subspan(begin, end - begin));
        });
}

template <class Sink>
void locate_in_tree(const IndexBase& index, Points points, unsigned threads, const Sink& sink) {
    const std::vector<std::uint32_t> order = in_order_of_places(index, points, threads);
    ParallelParts(order.size(), threads)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            BatchInTree<Sink>(index, points, sink)
                .find(std::span(order).subspan(begin, end - begin));
        });
}

template <class Sink>
void locate_one_by_one(const IndexBase& index, Points points, unsigned threads, const Sink& sink) {
    ParallelParts(points.size(), threads)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            std::vector<PolygonId> on;
            for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
                const IndexPoint p = IndexPoint::from_user(points[i], index.lattice());
                const Location l = locate_polygons(index, p, on);
                if (on.empty()) {
                    sink.off(i, l == Location::Inside);
                } else {
                    sink.on(i, p, on, 0);
                }
            }
        });
}

template <class Sink>
void locate_all(const IndexBase& index, Points points, unsigned threads, const Sink& sink) {
    if (points.size() >= 0xffffffffU) throw LimitError("more than 2^32 points at once");
    const IndexedLeaf* const leaf = index.is_bounded() ? index.only_leaf() : nullptr;
    if (leaf != nullptr && leaf->grid() != nullptr) {
        locate_in_grid(index, *leaf, points, threads, sink);
    } else if (index.is_bounded() && index.root_block() != nullptr) {
        locate_in_tree(index, points, threads, sink);
    } else {
        locate_one_by_one(index, points, threads, sink);
    }
}

}  // namespace

void locate_batch(const IndexBase& index, Points points, unsigned threads,
                  const FoundPoint& found) {
    locate_all(index, points, threads, ToPlaces{found});
}

void classify_batch(const IndexBase& index, Points points, unsigned threads,
                    std::span<Location> results) {
    locate_all(index, points, threads, ToLocations{results});
}

}  // namespace trisect::detail
