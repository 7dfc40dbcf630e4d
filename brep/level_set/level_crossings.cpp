// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/level_set/level_crossings.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {
namespace {

constexpr double least_from_end = 0x1p-8;

/// Part of an edge at whose ends the function has different signs.
struct Bracket {
    double from = 0;
    double to = 1;
    double value_from = 0;
    double value_to = 0;

    /// Where the line between both values is 0. Scaled, so that nothing overflows.
    [[nodiscard]] double guess() const {
        const double scale = std::max(std::fabs(value_from), std::fabs(value_to));
        if (scale == 0) return from;
        const double a = value_from / scale;
        return from + (to - from) * (a / (a - value_to / scale));
    }
    void divide(double at, double value) {
        if ((value > 0) == (value_from > 0)) {
            from = at;
            value_from = value;
        } else {
            to = at;
            value_to = value;
        }
    }
};

class Crossings {
public:
    Crossings(const LevelGrid& grid, const std::vector<std::int8_t>& signs)
        : grid_(grid), signs_(signs) {
        for (unsigned d = 0; d < offsets_.size(); ++d)
            for (std::size_t k = 0; k < 3; ++k)
                if (((d >> k) & 1U) != 0) offsets_[d] += grid.corner_steps()[k];
    }

    std::vector<LevelCrossing> all() {
        const auto& [x, y, z] = grid_.cells();
        for (std::int32_t k = 0; k <= z; ++k)
            for (std::int32_t j = 0; j <= y; ++j) add_row({0, 2 * j, 2 * k}, x + 1);
        for (std::int32_t k = -1; k <= z; ++k)
            for (std::int32_t j = -1; j <= y; ++j) add_row({-1, 2 * j + 1, 2 * k + 1}, x + 2);
        if (out_.size() >= std::numeric_limits<std::uint32_t>::max() / 2)
            throw LimitError("a level set of more than 2^31 vertices");
        return std::move(out_);
    }

private:
    void add_row(NodePoint p, std::int32_t count) {
        check_stop(static_cast<std::uint64_t>(count));
        std::size_t node = grid_.number(p);
        for (std::int32_t i = 0; i < count; ++i, ++node, p[0] += 2)
            if (grid_.is_node(p) && !is_alone(p, node)) add_edges_from(p, node);
    }

    /// Whether it is plain that all ends of its edges are on its side.
    [[nodiscard]] bool is_alone(const NodePoint& p, std::size_t node) const {
        if (!grid_.is_inner(p)) return false;
        const std::int8_t sign = signs_[node];
        const bool is_centre = p[0] % 2 != 0;
        for (const std::size_t step : is_centre ? grid_.centre_steps() : grid_.corner_steps())
            if (signs_[node + step] != sign) return false;
        if (!is_centre) return true;
        const std::size_t corner = grid_.number({p[0] - 1, p[1] - 1, p[2] - 1});
        return std::ranges::all_of(
            offsets_, [&](std::size_t offset) { return signs_[corner + offset] == sign; });
    }

    void add_edges_from(const NodePoint& p, std::size_t node) {
        const bool is_centre = p[0] % 2 != 0;
        for (int d = is_centre ? 0 : LevelGrid::short_directions; d < LevelGrid::directions; ++d)
            if (grid_.is_edge(p, d) && signs_[node] != signs_[grid_.number(LevelGrid::along(p, d))])
                out_.push_back({node, d, 0});
    }

    const LevelGrid& grid_;
    const std::vector<std::int8_t>& signs_;
    std::array<std::size_t, 8> offsets_{};  // of the corners of a cell, from the low one
    std::vector<LevelCrossing> out_;
};

}  // namespace

Point3d place_on_edge(const LevelGrid& grid, const LevelCrossing& crossing) {
    const NodePoint p = grid.point(crossing.node);
    const Point3d a = grid.place(p);
    const Point3d b = grid.place(LevelGrid::along(p, crossing.direction));
    Point3d out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = a[k] + crossing.at * (b[k] - a[k]);
    return out;
}

std::size_t other_end(const LevelGrid& grid, const LevelCrossing& crossing) {
    return grid.number(LevelGrid::along(grid.point(crossing.node), crossing.direction));
}

std::vector<LevelCrossing> level_crossings(const LevelGrid& grid, const LevelValues& values,
                                           const BatchOfValues& function,
                                           const LevelSetOptions& options) {
    std::vector<LevelCrossing> out = Crossings(grid, values.signs()).all();
    std::vector<Bracket> brackets(out.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        brackets[i].value_from = values[out[i].node];
        brackets[i].value_to = values[other_end(grid, out[i])];
        out[i].at = brackets[i].guess();
    }
    std::vector<Point3d> places(options.root_steps > 0 ? out.size() : 0);
    std::vector<double> found(places.size());
    for (std::uint32_t step = 0; step < options.root_steps; ++step) {
        // The middle every other time, since guesses may leave one end where it is.
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (step % 2 == 1) out[i].at = (brackets[i].from + brackets[i].to) / 2;
            places[i] = place_on_edge(grid, out[i]);
        }
        values_at(function, options, places, found);
        for (std::size_t i = 0; i < out.size(); ++i) {
            brackets[i].divide(out[i].at, found[i]);
            out[i].at = brackets[i].guess();
        }
    }
    for (LevelCrossing& c : out) c.at = std::clamp(c.at, least_from_end, 1 - least_from_end);
    return out;
}

}  // namespace trisect::detail
