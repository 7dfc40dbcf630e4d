// SPDX-License-Identifier: Apache-2.0
//
// CornerRows: corners of a section, four at a time.
// The plane is across an axis, and each corner is rounded once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/brep/primitives/point_2d.h>

namespace trisect::detail {

/// Four edges, and where the plane passes through them.
struct FourCorners {
    std::array<std::array<double, 4>, 2> from;
    std::array<std::array<double, 4>, 2> to;
    std::array<double, 4> from_level;
    std::array<double, 4> to_level;
    std::array<std::array<double, 4>, 2> at;
    std::array<std::int64_t, 4> is_found;
    std::array<std::int64_t, 4> was_rounded;
};

/// Edges are taken four at a time. For one thread; keeps its memory.
class CornerRows {
public:
    void clear() { count_ = 0; }
    /// Two points with their levels. \pre the plane is between them, levels and coordinates are
    /// below 2^400
    void add(const Point2d& a, double level_a, const Point2d& b, double level_b) {
        const std::size_t i = count_ % 4;
        if (i == 0) begin_four();
        FourCorners& four = fours_[count_++ / 4];
        for (std::size_t k = 0; k < 2; ++k) {
            four.from[k][i] = a[k];
            four.to[k][i] = b[k];
        }
        four.from_level[i] = level_a;
        four.to_level[i] = level_b;
    }
    /// Keeps a number for an edge that is found otherwise.
    void add_nothing() { add({0, 0}, 0, {0, 0}, 1); }

    /// Finds all corners of the plane.
    void find(double height);

    /// The corner of edge i, if is_found(i).
    [[nodiscard]] Point2d corner(std::size_t i) const {
        const FourCorners& f = fours_[i / 4];
        return {f.at[0][i % 4] + 0.0, f.at[1][i % 4] + 0.0};
    }
    /// Whether it is certainly the nearest double; and whether that is certainly another point.
    [[nodiscard]] bool is_found(std::size_t i) const { return fours_[i / 4].is_found[i % 4] != 0; }
    [[nodiscard]] bool was_rounded(std::size_t i) const {
        return fours_[i / 4].was_rounded[i % 4] != 0;
    }

private:
    void begin_four();

    std::size_t count_ = 0;
    std::vector<FourCorners> fours_;
};

}  // namespace trisect::detail
