// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/level_set/level_values.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <trisect/brep/validate/defect.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {
namespace {

constexpr std::size_t batch_size = 4096;

void call(const BatchOfValues& function, double level, std::span<const Point3d> places,
          std::span<double> values) {
    function(places, values);
    for (std::size_t i = 0; i < places.size(); ++i) {
        values[i] -= level;
        if (!std::isfinite(values[i]))
            throw UsageError("the function of a level set is not finite at " +
                             place_text(places[i]));
    }
}

}  // namespace

void values_at(const BatchOfValues& function, const LevelSetOptions& options,
               std::span<const Point3d> places, std::span<double> values) {
    const std::size_t batches = (places.size() + batch_size - 1) / batch_size;
    if (batches == 0) return;
    check_stop(places.size());
    ParallelParts(batches, options.threads, 1)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t b = begin; b < end; ++b) {
                const std::size_t first = b * batch_size;
                const std::size_t count = std::min(batch_size, places.size() - first);
                call(function, options.level, places.subspan(first, count),
                     values.subspan(first, count));
            }
        });
}

LevelValues::LevelValues(const LevelGrid& grid, const BatchOfValues& function,
                         const LevelSetOptions& options)
    : values_(grid.size(), -1) {
    constexpr std::size_t at_once = 64 * batch_size;
    std::vector<Point3d> places;
    std::vector<std::size_t> nodes;
    std::vector<double> results;
    for (std::size_t first = 0; first < grid.size(); first += at_once) {
        places.clear();
        nodes.clear();
        for (std::size_t n = first; n < std::min(first + at_once, grid.size()); ++n) {
            const NodePoint p = grid.point(n);
            if (!grid.is_node(p)) continue;
            places.push_back(grid.place(p));
            nodes.push_back(n);
        }
        results.resize(places.size());
        values_at(function, options, places, results);
        for (std::size_t i = 0; i < nodes.size(); ++i) values_[nodes[i]] = results[i];
    }
}

std::vector<std::int8_t> LevelValues::signs() const {
    std::vector<std::int8_t> out(values_.size());
    for (std::size_t i = 0; i < values_.size(); ++i) out[i] = values_[i] > 0 ? 1 : -1;
    return out;
}

}  // namespace trisect::detail
