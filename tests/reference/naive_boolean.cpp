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
#include "naive_boolean.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "facet.h"
#include "plane_arrangement.h"
#include "ray_caster.h"

namespace reference {
namespace {

constexpr std::size_t attempt_limit = 10000;

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

}  // namespace

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
