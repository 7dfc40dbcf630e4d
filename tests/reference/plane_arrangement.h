// SPDX-License-Identifier: Apache-2.0
//
// What the triangles of all operands draw into one plane.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "facet.h"
#include "plane.h"
#include "rational.h"

namespace reference {

// a u + b v + c = 0 in lowest terms with the first of a, b that is not zero positive, so that equal
// lines have equal coefficients.
using Line2 = std::array<Integer, 3>;

using Segment2 = std::pair<Point2, Point2>;

// Convex cells of a rectangle, cut by segments. A cell is cut by the whole line of a segment, but
// only if the segment passes through the cell's interior; in the end no segment does.
class PlaneArrangement {
public:
    using Cell = std::vector<std::size_t>;  // counter-clockwise indices of points

    PlaneArrangement(const Point2& low, const Point2& high) {
        const Cell corners{add({low[0], low[1]}), add({high[0], low[1]}), add({high[0], high[1]}),
                           add({low[0], high[1]})};
        cells_.push_back(corners);
    }

    void cut(const std::vector<Segment2>& segments);

    template <typename Predicate>
    void keep_if(const Predicate& predicate) {
        std::erase_if(cells_, [&](const Cell& cell) { return !predicate(cell); });
    }

    const std::vector<Cell>& cells() const { return cells_; }
    const Point2& point(std::size_t index) const { return points_[index].place; }

    // The mean of the corners with the given positive weights, which are repeated as needed.
    Point2 interior_point(const Cell& cell, const std::vector<unsigned>& weights) const;

private:
    using Interval = std::pair<Rational, Rational>;

    // The same point twice: coordinates, and integers (u w, v w, w) with w > 0.
    struct Point {
        Point2 place;
        std::array<Integer, 3> homogeneous;
    };

    std::size_t add(const Point2& p);
    Integer evaluate(const Line2& line, std::size_t index) const;
    // Where the edge from p to q, strictly on two sides of the line, meets it.
    std::size_t crossing(const Line2& line, std::size_t p, std::size_t q);
    void cut(const Line2& line, const std::vector<Interval>& intervals);
    void cut_cell(const Cell& cell, const Line2& line, const std::vector<Interval>& intervals,
                  std::vector<Cell>& next);

    std::vector<Point> points_;
    std::vector<Cell> cells_;
    std::vector<int> sides_;  // of the points, for the line in use
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> crossings_;
};

// The cells of the plane that are covered by the facets of the given group.
PlaneArrangement arrange(const std::vector<Facet>& facets, std::size_t group,
                         const OrientedPlane& plane, const PlaneChart& chart);

}  // namespace reference
