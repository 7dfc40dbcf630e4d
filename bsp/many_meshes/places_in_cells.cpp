// SPDX-License-Identifier: Apache-2.0
//
// A box is on both sides of a plane that it touches or crosses, as where cells are divided
// (crossed_facets.cpp): along each axis two boxes that meet have the cell of the larger lower end.

#include <trisect/bsp/many_meshes/places_in_cells.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/many_meshes/grid_counters.h>
#include <trisect/kernel/diagnostics.h>

namespace trisect::detail {

namespace {

constexpr std::size_t facets_of_a_cell = std::size_t{1} << 14;

}  // namespace

PlacesInCells::PlacesInCells(const std::array<const OutlinedSolid*, 2>& solids,
                             const Places& places, const SinglePlace& place) {
    const auto box_of = [&](std::size_t solid, std::uint32_t facet) {
        const OutlineBox& b = solids[solid]->boxes[facet];
        return place.box(b.lo, b.hi);
    };
    GridCounters& made = counters_of_thread<GridCounters>;
    ++made.grids;
    made.facets += places[0].size() + places[1].size();
    // What may meet lies where both are.
    SingleBox all = SingleBox::everywhere();
    for (std::size_t i = 0; i < 2; ++i) all.cut(place.box(solids[i]->box.lo, solids[i]->box.hi));
    set_grid(all, places[0].size() + places[1].size());
    PoolVector<Range> ranges;
    for (std::size_t i = 0; i < 2; ++i) {
        ranges.clear();
        ranges.reserve(places[i].size());
        for (const std::uint32_t f : places[i]) ranges.push_back(range_of(box_of(i, f)));
        list(i, ranges, places[i]);
    }
}

// Cells of nearly the same length along all axes.
void PlacesInCells::set_grid(const SingleBox& all, std::size_t facets) {
    std::array<double, 3> extent{};
    double volume = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        extent[k] = std::max(double{all.hi(k)} - double{all.lo[k]}, 1.0);
        volume *= extent[k];
    }
    const double wanted = static_cast<double>(1 + facets / facets_of_a_cell);
    const double length = std::cbrt(volume / wanted);
    cell_count_ = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double count =
            std::clamp(std::round(extent[k] / length), 1.0, static_cast<double>(most_along));
        counts_[k] = static_cast<std::size_t>(count);
        cell_count_ *= counts_[k];
        for (std::size_t i = 1; i < counts_[k]; ++i)
            planes_[k][i - 1] =
                static_cast<float>(double{all.lo[k]} + extent[k] * static_cast<double>(i) / count);
    }
}

PlacesInCells::Range PlacesInCells::range_of(const SingleBox& box) const {
    Range out;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i + 1 < counts_[k]; ++i) {
            if (box.lo[k] >= planes_[k][i]) ++out.first[k];
            if (box.hi(k) >= planes_[k][i]) ++out.last[k];
        }
    return out;
}

SingleBox PlacesInCells::bounds(std::size_t cell) const {
    SingleBox out = SingleBox::everywhere();
    std::size_t rest = cell;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = rest % counts_[k];
        rest /= counts_[k];
        if (at > 0) out.lo[k] = planes_[k][at - 1];
        if (at + 1 < counts_[k]) out.down[k] = -planes_[k][at];
    }
    return out;
}

template <class Each>
void PlacesInCells::for_each_cell(const Range& range, const Each& each) const {
    for (std::size_t z = range.first[2]; z <= range.last[2]; ++z)
        for (std::size_t y = range.first[1]; y <= range.last[1]; ++y)
            for (std::size_t x = range.first[0]; x <= range.last[0]; ++x)
                each((z * counts_[1] + y) * counts_[0] + x);
}

void PlacesInCells::list(std::size_t solid, std::span<const Range> ranges,
                         std::span<const std::uint32_t> places) {
    PoolVector<std::uint32_t>& first = first_[solid];
    first.assign(cell_count_ + 1, 0);
    for (const Range& r : ranges) for_each_cell(r, [&](std::size_t c) { ++first[c + 1]; });
    for (std::size_t c = 0; c < cell_count_; ++c) first[c + 1] += first[c];
    PoolVector<std::uint32_t> next(first.begin(), first.end() - 1);
    PoolVector<Entry>& entries = entries_[solid];
    entries.resize(first.back());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const bool is_shared = ranges[i].first != ranges[i].last;
        for_each_cell(ranges[i],
                      [&](std::size_t c) { entries[next[c]++] = Entry(places[i], is_shared); });
    }
}

}  // namespace trisect::detail
