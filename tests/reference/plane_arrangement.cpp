// SPDX-License-Identifier: Apache-2.0
#include "plane_arrangement.h"

#include <optional>
#include <stdexcept>

namespace reference {
namespace {

Line2 line_through(const Point2& p, const Point2& q) {
    const Rational a = p[1] - q[1];
    const Rational b = q[0] - p[0];
    const Rational c = -(a * p[0] + b * p[1]);
    const Integer scale = lcm(lcm(a.get_den(), b.get_den()), c.get_den());
    Line2 line{Integer(a * scale), Integer(b * scale), Integer(c * scale)};
    Integer divisor = gcd(gcd(line[0], line[1]), line[2]);
    if (line[0] < 0 || (line[0] == 0 && line[1] < 0)) {
        divisor = -divisor;
    }
    for (Integer& coefficient : line) {
        coefficient /= divisor;
    }
    return line;
}

// The coordinate that orders points along a line.
std::size_t axis_along(const Line2& line) { return line[1] != 0 ? 0 : 1; }

}  // namespace

void PlaneArrangement::cut(const std::vector<Segment2>& segments) {
    std::map<Line2, std::vector<Interval>> lines;
    for (const auto& [p, q] : segments) {
        const Line2 line = line_through(p, q);
        const std::size_t axis = axis_along(line);
        lines[line].push_back(std::minmax(p[axis], q[axis]));
    }
    for (const auto& [line, intervals] : lines) {
        cut(line, intervals);
    }
}

Point2 PlaneArrangement::interior_point(const Cell& cell,
                                        const std::vector<unsigned>& weights) const {
    Point2 sum;
    unsigned total = 0;
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const unsigned weight = weights[i % weights.size()];
        total += weight;
        sum[0] += point(cell[i])[0] * weight;
        sum[1] += point(cell[i])[1] * weight;
    }
    return {sum[0] / total, sum[1] / total};
}

std::size_t PlaneArrangement::add(const Point2& p) {
    const Integer w = lcm(p[0].get_den(), p[1].get_den());
    points_.push_back({p, {Integer(p[0] * w), Integer(p[1] * w), w}});
    return points_.size() - 1;
}

Integer PlaneArrangement::evaluate(const Line2& line, std::size_t index) const {
    const auto& h = points_[index].homogeneous;
    return line[0] * h[0] + line[1] * h[1] + line[2] * h[2];
}

std::size_t PlaneArrangement::crossing(const Line2& line, std::size_t p, std::size_t q) {
    const auto key = std::minmax(p, q);
    const auto known = crossings_.find(key);
    if (known != crossings_.end()) {
        return known->second;
    }
    const Integer at_p = evaluate(line, p);
    const Integer at_q = evaluate(line, q);
    const auto& hp = points_[p].homogeneous;
    const auto& hq = points_[q].homogeneous;
    std::array<Integer, 3> h;
    for (std::size_t i = 0; i < 3; ++i) {
        h[i] = hp[i] * at_q - hq[i] * at_p;
    }
    const std::size_t index = add({fraction(h[0], h[2]), fraction(h[1], h[2])});
    crossings_.emplace(key, index);
    return index;
}

void PlaneArrangement::cut(const Line2& line, const std::vector<Interval>& intervals) {
    crossings_.clear();
    sides_.clear();
    for (std::size_t i = 0; i < points_.size(); ++i) {
        sides_.push_back(sign(evaluate(line, i)));
    }
    std::vector<Cell> next;
    for (Cell& cell : cells_) {
        const auto on_side = [&](int side) {
            return std::any_of(cell.begin(), cell.end(),
                               [&](std::size_t i) { return sides_[i] == side; });
        };
        if (on_side(1) && on_side(-1)) {
            cut_cell(cell, line, intervals, next);
        } else {
            next.push_back(std::move(cell));
        }
    }
    cells_ = std::move(next);
}

void PlaneArrangement::cut_cell(const Cell& cell, const Line2& line,
                                const std::vector<Interval>& intervals, std::vector<Cell>& next) {
    Cell above;
    Cell below;
    Cell chord;
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const std::size_t here = cell[i];
        const std::size_t there = cell[(i + 1) % cell.size()];
        if (sides_[here] >= 0) {
            above.push_back(here);
        }
        if (sides_[here] <= 0) {
            below.push_back(here);
        }
        if (sides_[here] == 0) {
            chord.push_back(here);
        }
        if (sides_[here] * sides_[there] < 0) {
            const std::size_t between = crossing(line, here, there);
            above.push_back(between);
            below.push_back(between);
            chord.push_back(between);
        }
    }
    if (chord.size() != 2) {
        throw std::logic_error("reference: a line crosses a convex cell in one chord");
    }
    const std::size_t axis = axis_along(line);
    const Interval open = std::minmax(point(chord[0])[axis], point(chord[1])[axis]);
    const bool met = std::any_of(intervals.begin(), intervals.end(), [&](const Interval& i) {
        return i.first < open.second && open.first < i.second;
    });
    if (met) {
        next.push_back(std::move(above));
        next.push_back(std::move(below));
    } else {
        next.push_back(cell);
    }
}

namespace {

// The segment that a facet has in common with a plane, if it is one (not a point, not the facet).
std::optional<Segment2> trace(const Facet& facet, const OrientedPlane& plane,
                              const PlaneChart& chart) {
    std::array<Integer, 3> values;
    std::vector<Point3> ends;
    for (std::size_t i = 0; i < 3; ++i) {
        values[i] = value_at(plane, facet.corners[i]);
        if (values[i] == 0) {
            ends.push_back(to_point(facet.corners[i]));
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (sign(values[i]) * sign(values[j]) < 0) {
            const Integer divisor = values[j] - values[i];
            Point3 p;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                p[axis] = fraction(
                    facet.corners[i][axis] * values[j] - facet.corners[j][axis] * values[i],
                    divisor);
            }
            ends.push_back(p);
        }
    }
    if (ends.size() != 2) {
        return std::nullopt;
    }
    return Segment2{chart.project(ends[0]), chart.project(ends[1])};
}

std::array<Point2, 3> flatten(const Facet& facet, const PlaneChart& chart) {
    std::array<Point2, 3> flat;
    for (std::size_t i = 0; i < 3; ++i) {
        flat[i] = chart.project(to_point(facet.corners[i]));
    }
    return flat;
}

// For a point known not to lie on the triangle's edges.
bool contains(const std::array<Point2, 3>& t, const Point2& p) {
    std::array<int, 3> turns{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Point2& a = t[i];
        const Point2& b = t[(i + 1) % 3];
        const Rational turn = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        turns[i] = sign(turn);
    }
    return turns[0] == turns[1] && turns[1] == turns[2];
}

bool boxes_meet(const IntegerPoint& low, const IntegerPoint& high, const Facet& facet) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (facet.high[axis] < low[axis] || high[axis] < facet.low[axis]) {
            return false;
        }
    }
    return true;
}

}  // namespace

PlaneArrangement arrange(const std::vector<Facet>& facets, std::size_t group,
                         const OrientedPlane& plane, const PlaneChart& chart) {
    std::vector<std::array<Point2, 3>> members;
    std::vector<Segment2> outlines;
    IntegerPoint low;
    IntegerPoint high;
    for (const Facet& facet : facets) {
        if (facet.group != group) {
            continue;
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = members.empty() ? facet.low[axis] : std::min(low[axis], facet.low[axis]);
            high[axis] =
                members.empty() ? facet.high[axis] : std::max(high[axis], facet.high[axis]);
        }
        const std::array<Point2, 3> flat = flatten(facet, chart);
        for (std::size_t i = 0; i < 3; ++i) {
            outlines.emplace_back(flat[i], flat[(i + 1) % 3]);
        }
        members.push_back(flat);
    }
    std::vector<Segment2> traces;
    for (const Facet& facet : facets) {
        if (facet.group != group && boxes_meet(low, high, facet)) {
            if (const auto segment = trace(facet, plane, chart)) {
                traces.push_back(*segment);
            }
        }
    }
    PlaneArrangement arrangement(chart.project(to_point(low)), chart.project(to_point(high)));
    arrangement.cut(outlines);
    arrangement.keep_if([&](const PlaneArrangement::Cell& cell) {
        const Point2 p = arrangement.interior_point(cell, {1});
        return std::any_of(members.begin(), members.end(),
                           [&](const auto& member) { return contains(member, p); });
    });
    arrangement.cut(traces);
    return arrangement;
}

}  // namespace reference
