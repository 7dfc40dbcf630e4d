// SPDX-License-Identifier: Apache-2.0
//
// Idea: the boundary of any set made from the operands is part of the union of their triangles. In
// every plane that holds triangles, draw the edges of these triangles and the segments in which
// all other triangles cut the plane. They divide the covered part of the plane into cells over
// which no winding number changes, neither just above the plane nor just below it. So one point per
// cell decides: count what a ray from it crosses, evaluate the expression for both sides, and keep
// the cell if the two values differ.
//
// Coincident triangles need no special case: all triangles of a plane are drawn into one
// arrangement, which has each cell once, and a ray that starts in the plane crosses those that
// contain the point, or none of them, depending on the side it starts from.
//
// Degenerate rays are not resolved but avoided: a ray that meets any edge or corner is thrown away
// and another random direction, from another point of the cell, is tried.
#include "naive_boolean.h"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace reference {
namespace {

using IntegerPoint = std::array<Integer, 3>;

// A triangle with area of some operand.
struct Facet {
    std::size_t operand;
    std::array<IntegerPoint, 3> corners;
    OrientedPlane plane;
    IntegerPoint low;  // bounding box
    IntegerPoint high;
    std::size_t group;  // index of its plane, whichever way it is oriented
};

Integer value_at(const OrientedPlane& plane, const IntegerPoint& p) {
    return plane.normal[0] * p[0] + plane.normal[1] * p[1] + plane.normal[2] * p[2] + plane.offset;
}

Point3 to_point(const IntegerPoint& p) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }

std::vector<Facet> gather(const std::vector<Operand>& operands) {
    std::vector<Facet> facets;
    for (std::size_t index = 0; index < operands.size(); ++index) {
        for (const Triangle& triangle : operands[index]) {
            const auto plane = plane_through(triangle[0], triangle[1], triangle[2]);
            if (!plane) {
                continue;
            }
            Facet facet{index, {}, *plane, {}, {}, 0};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    facet.corners[corner][axis] = to_integer(triangle[corner][axis]);
                }
                facet.low[axis] =
                    to_integer(std::min({triangle[0][axis], triangle[1][axis], triangle[2][axis]}));
                facet.high[axis] =
                    to_integer(std::max({triangle[0][axis], triangle[1][axis], triangle[2][axis]}));
            }
            facets.push_back(std::move(facet));
        }
    }
    return facets;
}

// One of the two orientations of a plane, the same for both.
OrientedPlane unoriented(const OrientedPlane& plane) {
    const OrientedPlane flipped = plane.flipped();
    return plane < flipped ? flipped : plane;
}

// ---------------------------------------------------------------------------------------------
// The arrangement in one plane
// ---------------------------------------------------------------------------------------------

// a u + b v + c = 0 in lowest terms with the first of a, b that is not zero positive, so that equal
// lines have equal coefficients.
using Line2 = std::array<Integer, 3>;

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

using Interval = std::pair<Rational, Rational>;
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

    void cut(const std::vector<Segment2>& segments) {
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

    template <typename Predicate>
    void keep_if(const Predicate& predicate) {
        std::erase_if(cells_, [&](const Cell& cell) { return !predicate(cell); });
    }

    const std::vector<Cell>& cells() const { return cells_; }
    const Point2& point(std::size_t index) const { return points_[index].place; }

    // The mean of the corners with the given positive weights, which are repeated as needed.
    Point2 interior_point(const Cell& cell, const std::vector<unsigned>& weights) const {
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

private:
    // The same point twice: coordinates, and integers (u w, v w, w) with w > 0.
    struct Point {
        Point2 place;
        std::array<Integer, 3> homogeneous;
    };

    std::size_t add(const Point2& p) {
        const Integer w = lcm(p[0].get_den(), p[1].get_den());
        points_.push_back({p, {Integer(p[0] * w), Integer(p[1] * w), w}});
        return points_.size() - 1;
    }

    Integer evaluate(const Line2& line, std::size_t index) const {
        const auto& h = points_[index].homogeneous;
        return line[0] * h[0] + line[1] * h[1] + line[2] * h[2];
    }

    // Where the edge from p to q, strictly on two sides of the line, meets it.
    std::size_t crossing(const Line2& line, std::size_t p, std::size_t q) {
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

    void cut(const Line2& line, const std::vector<Interval>& intervals) {
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

    void cut_cell(const Cell& cell, const Line2& line, const std::vector<Interval>& intervals,
                  std::vector<Cell>& next) {
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

    std::vector<Point> points_;
    std::vector<Cell> cells_;
    std::vector<int> sides_;  // of the points, for the line in use
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> crossings_;
};

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

// The cells of the plane that are covered by the facets of the given group.
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

// ---------------------------------------------------------------------------------------------
// Winding numbers by rays
// ---------------------------------------------------------------------------------------------

// splitmix64 (Steele, Lea, Flood 2014): enough for directions that must merely be varied.
class Varied {
public:
    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    long between(long low, long high) {
        return low + static_cast<long>(next() % static_cast<std::uint64_t>(high - low + 1));
    }

private:
    std::uint64_t state_ = 1;
};

// What a ray from a point crosses: winding numbers just before its start and just behind it. They
// differ by the facets that contain the start.
struct RayCount {
    std::vector<int> before;
    std::vector<int> behind;
};

// A point as integers (x w, y w, z w) and w > 0.
struct HomogeneousPoint {
    IntegerPoint scaled;
    Integer w;

    explicit HomogeneousPoint(const Point3& p)
        : w(lcm(lcm(p[0].get_den(), p[1].get_den()), p[2].get_den())) {
        for (std::size_t i = 0; i < 3; ++i) {
            scaled[i] = p[i] * w;
        }
    }
};

int side_of(const OrientedPlane& plane, const HomogeneousPoint& p) {
    return sign(Integer(plane.normal[0] * p.scaled[0] + plane.normal[1] * p.scaled[1] +
                        plane.normal[2] * p.scaled[2] + plane.offset * p.w));
}

// All facets seen along one direction d, that is mapped by (x, y, z) -> (x dz - z dx, y dz - z dy).
// A line in this direction is a point there.
class View {
public:
    // Nothing if the direction is parallel to some facet.
    static std::optional<View> along(const IntegerPoint& direction,
                                     const std::vector<Facet>& facets) {
        View view;
        view.direction_ = direction;
        for (const Facet& facet : facets) {
            const auto& n = facet.plane.normal;
            const Integer slope = n[0] * direction[0] + n[1] * direction[1] + n[2] * direction[2];
            if (slope == 0) {
                return std::nullopt;
            }
            view.images_.push_back(view.image_of(facet, sign(slope)));
        }
        return view;
    }

    const IntegerPoint& direction() const { return direction_; }

    // Nothing if the line through the point meets the edge of a facet, or if the point lies on a
    // facet outside of the given group.
    std::optional<RayCount> count(const Point3& point, const std::vector<Facet>& facets,
                                  std::size_t operand_count,
                                  std::optional<std::size_t> group) const {
        const HomogeneousPoint p(point);
        const std::array<Integer, 2> at{p.scaled[0] * direction_[2] - p.scaled[2] * direction_[0],
                                        p.scaled[1] * direction_[2] - p.scaled[2] * direction_[1]};
        std::array<Integer, 2> floor;
        std::array<Integer, 2> ceiling;
        for (std::size_t i = 0; i < 2; ++i) {
            mpz_fdiv_q(floor[i].get_mpz_t(), at[i].get_mpz_t(), p.w.get_mpz_t());
            mpz_cdiv_q(ceiling[i].get_mpz_t(), at[i].get_mpz_t(), p.w.get_mpz_t());
        }
        RayCount result{std::vector<int>(operand_count), std::vector<int>(operand_count)};
        for (std::size_t i = 0; i < facets.size(); ++i) {
            const Image& image = images_[i];
            if (floor[0] < image.low[0] || ceiling[0] > image.high[0] || floor[1] < image.low[1] ||
                ceiling[1] > image.high[1]) {
                continue;
            }
            const int place = place_in(image, at, p.w);
            if (place < 0) {
                continue;
            }
            // The ray meets the facet's plane ahead of the point if it climbs from below.
            const int side = side_of(facets[i].plane, p);
            if (place == 0 || (side == 0 && facets[i].group != group)) {
                return std::nullopt;
            }
            if (side == 0 || side != image.climb) {
                result.behind[facets[i].operand] += image.climb;
            }
            if (side != 0 && side != image.climb) {
                result.before[facets[i].operand] += image.climb;
            }
        }
        return result;
    }

private:
    struct Image {
        int climb;  // sign of normal . direction: the ray leaves the operand (1) or enters it (-1)
        std::array<Integer, 2> low;
        std::array<Integer, 2> high;
        std::array<Line2, 3> edges;  // positive on the inner side
    };

    Image image_of(const Facet& facet, int climb) const {
        Image image{climb, {}, {}, {}};
        std::array<std::array<Integer, 2>, 3> flat;
        for (std::size_t i = 0; i < 3; ++i) {
            const IntegerPoint& c = facet.corners[i];
            flat[i] = {c[0] * direction_[2] - c[2] * direction_[0],
                       c[1] * direction_[2] - c[2] * direction_[1]};
        }
        for (std::size_t axis = 0; axis < 2; ++axis) {
            image.low[axis] = std::min({flat[0][axis], flat[1][axis], flat[2][axis]});
            image.high[axis] = std::max({flat[0][axis], flat[1][axis], flat[2][axis]});
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& p = flat[i];
            const auto& q = flat[(i + 1) % 3];
            const auto& opposite = flat[(i + 2) % 3];
            Line2 line{p[1] - q[1], q[0] - p[0], p[0] * q[1] - p[1] * q[0]};
            if (line[0] * opposite[0] + line[1] * opposite[1] + line[2] < 0) {
                line = {-line[0], -line[1], -line[2]};
            }
            image.edges[i] = line;
        }
        return image;
    }

    // 1 inside, 0 on an edge, -1 outside of the triangle's image.
    static int place_in(const Image& image, const std::array<Integer, 2>& at, const Integer& w) {
        int place = 1;
        for (const Line2& edge : image.edges) {
            const Integer value = edge[0] * at[0] + edge[1] * at[1] + edge[2] * w;
            place = std::min(place, sign(value));
        }
        return place;
    }

    IntegerPoint direction_;
    std::vector<Image> images_;
};

constexpr std::size_t attempt_limit = 10000;

// Counts along random directions; views are kept, since most questions are answered by the first.
class RayCaster {
public:
    RayCaster(const std::vector<Facet>& facets, std::size_t operand_count)
        : facets_(facets), operand_count_(operand_count) {}

    const View& view(std::size_t attempt) {
        while (views_.size() <= attempt) {
            const IntegerPoint direction{Integer(varied_.between(-4001, 4001)),
                                         Integer(varied_.between(-4001, 4001)),
                                         Integer(varied_.between(1, 4001))};
            if (auto view = View::along(direction, facets_)) {
                views_.push_back(std::move(*view));
            }
        }
        return views_[attempt];
    }

    std::optional<RayCount> count(const Point3& point, std::size_t attempt,
                                  std::optional<std::size_t> group) {
        return view(attempt).count(point, facets_, operand_count_, group);
    }

    // Positive weights of a convex combination: equal ones first, then random ones.
    std::vector<unsigned> weights(std::size_t attempt) {
        std::vector<unsigned> result{1};
        if (attempt > 0) {
            result.resize(16);
            for (unsigned& weight : result) {
                weight = static_cast<unsigned>(varied_.between(1, 1000));
            }
        }
        return result;
    }

private:
    const std::vector<Facet>& facets_;
    std::size_t operand_count_;
    Varied varied_;
    std::vector<View> views_;
};

// ---------------------------------------------------------------------------------------------
// From cells to a result
// ---------------------------------------------------------------------------------------------

class Evaluator {
public:
    explicit Evaluator(Result& result)
        : result_(result),
          facets_(gather(result.operands)),
          caster_(facets_, result.operands.size()) {}

    void run() {
        std::map<OrientedPlane, std::size_t> groups;
        for (Facet& facet : facets_) {
            facet.group = groups.emplace(unoriented(facet.plane), groups.size()).first->second;
        }
        for (const auto& [plane, group] : groups) {
            const PlaneChart chart(plane);
            const PlaneArrangement arrangement = arrange(facets_, group, plane, chart);
            for (const PlaneArrangement::Cell& cell : arrangement.cells()) {
                decide(arrangement, cell, plane, chart, group);
            }
        }
        result_.unbounded = result_.indicator(std::vector<int>(result_.operands.size()));
    }

private:
    void decide(const PlaneArrangement& arrangement, const PlaneArrangement::Cell& cell,
                const OrientedPlane& plane, const PlaneChart& chart, std::size_t group) {
        for (std::size_t attempt = 0; attempt < attempt_limit; ++attempt) {
            const Point2 start = arrangement.interior_point(cell, caster_.weights(attempt));
            const auto count = caster_.count(chart.lift(start), attempt, group);
            if (!count) {
                continue;
            }
            const IntegerPoint& d = caster_.view(attempt).direction();
            const Integer climb =
                plane.normal[0] * d[0] + plane.normal[1] * d[1] + plane.normal[2] * d[2];
            const auto& above = climb > 0 ? count->before : count->behind;
            const auto& below = climb > 0 ? count->behind : count->before;
            const bool inside_above = result_.indicator(above);
            const bool inside_below = result_.indicator(below);
            if (inside_above != inside_below) {
                emit(arrangement, cell, plane, chart, inside_above, above, below);
            }
            return;
        }
        throw std::logic_error("reference: no generic ray found");
    }

    void emit(const PlaneArrangement& arrangement, const PlaneArrangement::Cell& cell,
              const OrientedPlane& plane, const PlaneChart& chart, bool inside_above,
              const std::vector<int>& above, const std::vector<int>& below) {
        ConvexCell kept{inside_above ? plane.flipped() : plane,
                        {},
                        inside_above ? below : above,
                        inside_above ? above : below};
        for (const std::size_t index : cell) {
            kept.vertices.push_back(chart.lift(arrangement.point(index)));
        }
        // Cells are counter-clockwise in the chart: seen from above if the chart keeps the
        // orientation of the plane.
        if ((chart.area_factor() > 0) == inside_above) {
            std::reverse(kept.vertices.begin(), kept.vertices.end());
        }
        result_.cells.push_back(std::move(kept));
    }

    Result& result_;
    std::vector<Facet> facets_;
    RayCaster caster_;
};

// Whether a point of the cell's plane is in the closed cell.
bool covers(const ConvexCell& cell, const Point3& point) {
    const PlaneChart chart(cell.plane);
    const int orientation = sign(chart.area_factor());
    const Point2 p = chart.project(point);
    for (std::size_t i = 0; i < cell.vertices.size(); ++i) {
        const Point2 a = chart.project(cell.vertices[i]);
        const Point2 b = chart.project(cell.vertices[(i + 1) % cell.vertices.size()]);
        const Rational turn = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        if (sign(turn) * orientation < 0) {
            return false;
        }
    }
    return true;
}

// Whether the closed segment from p to q may meet the closed cell; exact except that a segment in
// the cell's plane always counts.
bool may_meet(const ConvexCell& cell, const Point3& p, const Point3& q) {
    const Rational at_p = cell.plane.value(p);
    const Rational at_q = cell.plane.value(q);
    if (sign(at_p) * sign(at_q) > 0) {
        return false;
    }
    if (at_p == at_q) {
        return true;
    }
    const Rational t = at_p / (at_p - at_q);
    Point3 crossing;
    for (std::size_t i = 0; i < 3; ++i) {
        crossing[i] = p[i] + t * (q[i] - p[i]);
    }
    return covers(cell, crossing);
}

void print(const Expression& expression, std::string& out) {
    using Kind = Expression::Kind;
    if (expression.kind == Kind::Leaf) {
        out += std::to_string(expression.operand);
        return;
    }
    if (expression.kind == Kind::Complement) {
        out += '~';
        print(expression.children.at(0), out);
        return;
    }
    const char* const sign = expression.kind == Kind::Union          ? " + "
                             : expression.kind == Kind::Intersection ? " * "
                             : expression.kind == Kind::Difference   ? " - "
                                                                     : " ^ ";
    out += '(';
    for (std::size_t i = 0; i < expression.children.size(); ++i) {
        out += i == 0 ? "" : sign;
        print(expression.children[i], out);
    }
    out += ')';
}

}  // namespace

bool is_balanced(const Operand& operand) {
    std::map<std::pair<LatticePoint, LatticePoint>, int> balances;
    for (const Triangle& triangle : operand) {
        for (std::size_t i = 0; i < 3; ++i) {
            const LatticePoint& from = triangle[i];
            const LatticePoint& to = triangle[(i + 1) % 3];
            balances[std::minmax(from, to)] += from < to ? 1 : from == to ? 0 : -1;
        }
    }
    return std::all_of(balances.begin(), balances.end(),
                       [](const auto& entry) { return entry.second == 0; });
}

Rational signed_volume(const Operand& operand) {
    Integer sum = 0;
    for (const Triangle& t : operand) {
        std::array<IntegerPoint, 3> c;
        for (std::size_t i = 0; i < 3; ++i) {
            c[i] = {to_integer(t[i][0]), to_integer(t[i][1]), to_integer(t[i][2])};
        }
        sum += c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) +
               c[0][1] * (c[1][2] * c[2][0] - c[1][0] * c[2][2]) +
               c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0]);
    }
    return fraction(sum, 6);
}

Expression pair_expression(Expression::Kind kind) {
    return Expression::node(kind, {Expression::leaf(0), Expression::leaf(1)});
}

bool holds(const Expression& expression, const std::vector<bool>& memberships) {
    using Kind = Expression::Kind;
    if (expression.kind == Kind::Leaf) {
        return memberships.at(expression.operand);
    }
    bool value = holds(expression.children.at(0), memberships);
    if (expression.kind == Kind::Complement) {
        return !value;
    }
    for (std::size_t i = 1; i < expression.children.size(); ++i) {
        const bool other = holds(expression.children[i], memberships);
        switch (expression.kind) {
            case Kind::Union:
                value = value || other;
                break;
            case Kind::Intersection:
                value = value && other;
                break;
            case Kind::Difference:
                value = value && !other;
                break;
            default:
                value = value != other;
                break;
        }
    }
    return value;
}

std::string to_string(const Expression& expression) {
    std::string out;
    print(expression, out);
    return out;
}

Indicator make_indicator(Expression expression, InsideRule rule) {
    return [expression = std::move(expression), rule](const std::vector<int>& windings) {
        std::vector<bool> memberships;
        for (const int winding : windings) {
            memberships.push_back(rule == InsideRule::Positive ? winding > 0 : winding != 0);
        }
        return holds(expression, memberships);
    };
}

Result evaluate(const std::vector<Operand>& operands, const Indicator& indicator) {
    for (const Operand& operand : operands) {
        if (!is_balanced(operand)) {
            throw std::invalid_argument("reference: an operand is not closed");
        }
    }
    Result result{operands, indicator, {}, false};
    Evaluator(result).run();
    return result;
}

Result evaluate(const std::vector<Operand>& operands, const Expression& expression,
                InsideRule rule) {
    return evaluate(operands, make_indicator(expression, rule));
}

Location locate(const Result& result, const Point3& point) {
    for (const ConvexCell& cell : result.cells) {
        if (cell.plane.value(point) == 0 && covers(cell, point)) {
            return Location::OnBoundary;
        }
    }
    // The point may still lie on triangles that do not bound the result. Move off them, on a
    // segment so short that it does not meet the boundary.
    const std::vector<Facet> facets = gather(result.operands);
    RayCaster caster(facets, result.operands.size());
    Rational step = 1;
    for (std::size_t attempt = 0; attempt < attempt_limit; ++attempt) {
        const IntegerPoint& d = caster.view(attempt).direction();
        Point3 near;
        for (std::size_t i = 0; i < 3; ++i) {
            near[i] = point[i] + step * d[i];
        }
        step /= 2;
        const bool clear =
            std::none_of(result.cells.begin(), result.cells.end(),
                         [&](const ConvexCell& cell) { return may_meet(cell, point, near); });
        if (!clear) {
            continue;
        }
        // Another direction than the step's, which may lead back onto an edge.
        if (const auto count = caster.count(near, attempt + 1, std::nullopt)) {
            return result.indicator(count->before) ? Location::Inside : Location::Outside;
        }
    }
    throw std::logic_error("reference: no generic point found");
}

std::vector<Polygon> polygons_of(const Operand& triangles) {
    std::vector<Polygon> polygons;
    for (const Triangle& t : triangles) {
        if (const auto plane = plane_through(t[0], t[1], t[2])) {
            polygons.push_back({*plane, {{to_point(t[0]), to_point(t[1]), to_point(t[2])}}});
        }
    }
    return polygons;
}

CanonicalBoundary canonical_boundary(const std::vector<ConvexCell>& cells) {
    std::vector<Polygon> polygons;
    for (const ConvexCell& cell : cells) {
        polygons.push_back({cell.plane, {cell.vertices}});
    }
    return canonical_boundary(polygons);
}

bool same_set(const std::vector<ConvexCell>& a, const std::vector<ConvexCell>& b) {
    return canonical_boundary(a) == canonical_boundary(b);
}

bool same_set(const Result& a, const Result& b) {
    return a.unbounded == b.unbounded && same_set(a.cells, b.cells);
}

}  // namespace reference
