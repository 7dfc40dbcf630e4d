// SPDX-License-Identifier: Apache-2.0
//
// Idea: the boundary of a region in a plane is a sum of directed segments in which opposite ones
// cancel. Written line by line it is a step function: at parameter t of a line, how often the
// boundary runs forwards minus how often backwards. Adding all edges of all pieces into that step
// function and reading off its intervals of constant value performs, in one sweep, everything that
// would otherwise need care: cancelling edges that are subdivided differently on their two sides,
// joining collinear neighbours, and forgetting vertices that are no corners. The boundary of a
// bounded region determines the region, so equal step functions mean equal regions.
#include "canonical_boundary.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "vector.h"

namespace reference {
namespace {

// A line of a chart: v = slope u + intercept, or u = intercept if vertical. Rationals in lowest
// terms are unique, hence so is the key.
struct LineKey {
    bool vertical = false;
    Rational slope;
    Rational intercept;

    bool operator<(const LineKey& other) const {
        return std::tie(vertical, slope, intercept) <
               std::tie(other.vertical, other.slope, other.intercept);
    }
};

LineKey line_of(const Point2& p, const Point2& q) {
    LineKey key;
    if (p[0] == q[0]) {
        key.vertical = true;
        key.intercept = p[0];
        return key;
    }
    key.slope = (q[1] - p[1]) / (q[0] - p[0]);
    key.intercept = p[1] - key.slope * p[0];
    return key;
}

Point2 point_on(const LineKey& line, const Rational& t) {
    if (line.vertical) {
        return {line.intercept, t};
    }
    return {t, line.slope * t + line.intercept};
}

// Derivative of the step function on one line: jump at each parameter.
using Steps = std::map<Rational, int>;
using Lines = std::map<LineKey, Steps>;

void add_loop(const std::vector<Point2>& loop, Lines& lines) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Point2& from = loop[i];
        const Point2& to = loop[(i + 1) % loop.size()];
        if (from == to) {
            continue;
        }
        const LineKey line = line_of(from, to);
        const std::size_t axis = line.vertical ? 1 : 0;
        const int direction = from[axis] < to[axis] ? 1 : -1;
        Steps& steps = lines[line];
        // Forwards: +1 from the lower end, -1 from the upper one. Backwards: the negative of it.
        steps[std::min(from[axis], to[axis])] += direction;
        steps[std::max(from[axis], to[axis])] -= direction;
    }
}

std::vector<BoundarySegment> read_off(const Lines& lines, const PlaneChart& chart) {
    std::vector<BoundarySegment> segments;
    for (const auto& [line, steps] : lines) {
        int level = 0;
        Rational start;
        for (const auto& [t, jump] : steps) {
            if (jump == 0) {
                continue;
            }
            if (level != 0) {
                const Point3 low = chart.lift(point_on(line, start));
                const Point3 high = chart.lift(point_on(line, t));
                segments.push_back(level > 0 ? BoundarySegment{low, high, level}
                                             : BoundarySegment{high, low, -level});
            }
            level += jump;
            start = t;
        }
    }
    std::sort(segments.begin(), segments.end(),
              [](const BoundarySegment& a, const BoundarySegment& b) {
                  return std::tie(a.from, a.to) < std::tie(b.from, b.to);
              });
    return segments;
}

bool collinear(const Point3& a, const Point3& b, const Point3& c) {
    const auto e = subtracted(b, a);
    const auto f = subtracted(c, a);
    return e[0] * f[1] == e[1] * f[0] && e[1] * f[2] == e[2] * f[1] && e[0] * f[2] == e[2] * f[0];
}

// Balance of every crease after cutting at all real vertices: forward minus backward runs.
std::map<Edge, int> edge_balances(const CanonicalBoundary& boundary) {
    const std::set<Point3> corners = real_vertices(boundary);
    std::map<Edge, int> balances;
    for (const auto& [plane, segments] : boundary.regions) {
        for (const BoundarySegment& segment : segments) {
            const bool forward = segment.from < segment.to;
            const Point3& low = forward ? segment.from : segment.to;
            const Point3& high = forward ? segment.to : segment.from;
            // Points of a segment lie between its ends in lexicographic order.
            auto previous = corners.find(low);
            const auto last = corners.find(high);
            for (auto corner = std::next(previous); corner != std::next(last); ++corner) {
                if (collinear(low, high, *corner)) {
                    balances[{*previous, *corner}] += (forward ? 1 : -1) * segment.multiplicity;
                    previous = corner;
                }
            }
        }
    }
    return balances;
}

template <typename Numbers>
void print_tuple(std::ostream& out, const Numbers& numbers) {
    out << '(';
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        out << (i == 0 ? "" : ", ") << numbers[i];
    }
    out << ')';
}

void print_plane(std::ostream& out, const OrientedPlane& plane) {
    out << "normal ";
    print_tuple(out, plane.normal);
    out << " offset " << plane.offset;
}

void print_segments(std::ostream& out, const std::vector<BoundarySegment>& segments) {
    for (const BoundarySegment& segment : segments) {
        out << "\n    ";
        print_tuple(out, segment.from);
        out << " -> ";
        print_tuple(out, segment.to);
        if (segment.multiplicity != 1) {
            out << " times " << segment.multiplicity;
        }
    }
}

}  // namespace

CanonicalBoundary canonical_boundary(const std::vector<Polygon>& polygons) {
    std::map<OrientedPlane, std::vector<const Polygon*>> by_plane;
    for (const Polygon& polygon : polygons) {
        by_plane[polygon.plane].push_back(&polygon);
    }
    CanonicalBoundary result;
    for (const auto& [plane, members] : by_plane) {
        const PlaneChart chart(plane);
        Lines lines;
        for (const Polygon* polygon : members) {
            for (const std::vector<Point3>& loop : polygon->loops) {
                std::vector<Point2> flat;
                for (const Point3& corner : loop) {
                    if (sign(plane.value(corner)) != 0) {
                        throw std::invalid_argument("reference: a corner is off its plane");
                    }
                    flat.push_back(chart.project(corner));
                }
                add_loop(flat, lines);
            }
        }
        std::vector<BoundarySegment> segments = read_off(lines, chart);
        if (!segments.empty()) {
            result.regions.emplace(plane, std::move(segments));
        }
    }
    return result;
}

std::map<OrientedPlane, Rational> area_ratios(const CanonicalBoundary& boundary) {
    std::map<OrientedPlane, Rational> ratios;
    for (const auto& [plane, segments] : boundary.regions) {
        const PlaneChart chart(plane);
        Rational doubled = 0;
        for (const BoundarySegment& segment : segments) {
            const Point2 p = chart.project(segment.from);
            const Point2 q = chart.project(segment.to);
            doubled += (p[0] * q[1] - p[1] * q[0]) * segment.multiplicity;
        }
        ratios[plane] = doubled / 2 * chart.area_factor();
    }
    return ratios;
}

Rational volume(const CanonicalBoundary& boundary) {
    // Divergence theorem: a third of the sum of area times distance from the origin; the distance
    // along the normal is -offset / |normal|.
    Rational sum = 0;
    for (const auto& [plane, ratio] : area_ratios(boundary)) {
        sum -= ratio * plane.offset;
    }
    return sum / 3;
}

std::array<Rational, 3> total_area_vector(const CanonicalBoundary& boundary) {
    std::array<Rational, 3> sum;
    for (const auto& [plane, ratio] : area_ratios(boundary)) {
        for (std::size_t i = 0; i < 3; ++i) {
            sum[i] += ratio * plane.normal[i];
        }
    }
    return sum;
}

std::set<Point3> real_vertices(const CanonicalBoundary& boundary) {
    std::set<Point3> corners;
    for (const auto& [plane, segments] : boundary.regions) {
        for (const BoundarySegment& segment : segments) {
            corners.insert(segment.from);
            corners.insert(segment.to);
        }
    }
    return corners;
}

std::set<Edge> edges(const CanonicalBoundary& boundary) {
    std::set<Edge> result;
    for (const auto& [edge, balance] : edge_balances(boundary)) {
        result.insert(edge);
    }
    return result;
}

bool is_closed(const CanonicalBoundary& boundary) {
    const std::map<Edge, int> balances = edge_balances(boundary);
    return std::all_of(balances.begin(), balances.end(),
                       [](const auto& entry) { return entry.second == 0; });
}

std::string explain_difference(const CanonicalBoundary& a, const CanonicalBoundary& b) {
    std::set<OrientedPlane> planes;
    for (const auto& [plane, segments] : a.regions) {
        planes.insert(plane);
    }
    for (const auto& [plane, segments] : b.regions) {
        planes.insert(plane);
    }
    static const std::vector<BoundarySegment> nothing;
    for (const OrientedPlane& plane : planes) {
        const auto in_a = a.regions.find(plane);
        const auto in_b = b.regions.find(plane);
        const auto& segments_a = in_a == a.regions.end() ? nothing : in_a->second;
        const auto& segments_b = in_b == b.regions.end() ? nothing : in_b->second;
        if (segments_a != segments_b) {
            std::ostringstream out;
            out << "regions differ in the plane ";
            print_plane(out, plane);
            out << "\n  first:";
            print_segments(out, segments_a);
            out << "\n  second:";
            print_segments(out, segments_b);
            return out.str();
        }
    }
    return {};
}

}  // namespace reference
