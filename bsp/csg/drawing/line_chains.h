// SPDX-License-Identifier: Apache-2.0
//
// LineChains: separate lines, put together to outlines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/point_2d.h>

namespace trisect::detail {

/// Ends in one cell of a grid of 2^-10, or in neighbouring cells, are one point: the first that was
/// there. So a point moves by at most two cells along each axis.
class LineChains {
public:
    static constexpr double cell = 0x1p-10;
    /// Coordinates must be below this.
    static constexpr double largest = 0x1p+40;

    void add(const Point2d& from, const Point2d& to);
    [[nodiscard]] std::size_t size() const { return lines_.size(); }

    /// Each line is in one outline. First go chains that begin at an end that no other line has;
    /// they are closed by a line of their own. Then all others. Where lines branch off, the one
    /// that was added first goes on. O(n log n).
    [[nodiscard]] std::vector<Outline> outlines();

private:
    struct Line {
        std::uint32_t ends[2];
        bool is_used = false;
    };
    [[nodiscard]] std::uint32_t point_at(const Point2d& p);
    [[nodiscard]] bool is_free_end(std::uint32_t point) const { return degree_[point] == 1; }
    [[nodiscard]] Outline walk(std::uint32_t line, int from);

    std::vector<Point2d> points_;
    std::vector<Line> lines_;
    std::vector<std::vector<std::uint32_t>> lines_at_;
    std::vector<std::uint32_t> first_at_;  ///< lines at a point before it are used
    std::vector<std::uint32_t> degree_;    ///< lines at a point that are not used yet
    std::vector<std::uint32_t> freed_;     ///< points that came to have one line
    std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t> point_in_;
};

}  // namespace trisect::detail
