// SPDX-License-Identifier: Apache-2.0
//
// A polygon with at most one slanted edge is what that edge leaves of a box, and the common part of
// two boxes is a box. So there is one clip of a rectangle by a line, whose corners are integers.

#include <trisect/bsp/leaf/grid/axis_clip.h>

#include <algorithm>
#include <cmath>
#include <span>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

constexpr std::size_t at_low = 0;
constexpr std::size_t at_high = 1;

// The edges of a polygon by what they are across.
struct OwnEdges {
    std::array<std::array<std::optional<EdgeName>, 2>, 2> along;
    EdgeName slanted;
};

OwnEdges own_edges(const AxisPolygon& p) {
    OwnEdges out;
    const std::size_t k = p.plane.axis;
    const auto add = [&](const EdgeName& e) {
        const auto across = axis_plane(e.plane);
        if (!across) {
            out.slanted = e;
            return;
        }
        const std::size_t i = across->axis == (k + 1) % 3 ? 0 : 1;
        const std::size_t side = e.above == (across->sign > 0) ? at_low : at_high;
        const std::int64_t bound = side == at_low ? p.lo[across->axis] : p.hi[across->axis];
        if (across->position == bound) out.along[i][side] = e;
    };
    if (p.ref.fragment != nullptr) {
        for (const EdgeName& e : p.ref.fragment->edges()) add(e);
    } else {
        for (int i = 0; i < 3; ++i) add({PlaneName::edge(p.ref.source, p.ref.facet, i), false});
    }
    return out;
}

// Of the rectangle, in 1/192 lattice units.
struct RectangleCorner {
    std::array<std::int64_t, 2> at{};
    EdgeName edge;  // that begins here
};
using RectangleCorners = std::array<RectangleCorner, 4>;
using RectangleSides = std::array<std::array<AxisRectangle::Side, 2>, 2>;

struct Outline {
    std::array<EdgeName, 5> edges;
    std::array<Approximation, 5> vertices;
    std::size_t size = 0;
    void add(const Approximation& at, const EdgeName& edge) {
        vertices[size] = at;
        edges[size++] = edge;
    }
};

// The sides of what a rectangle has of the polygon's box, with the polygon's own names where it
// ends there; nothing when that has no area.
std::optional<RectangleSides> common_sides(const AxisPolygon& polygon, const OwnEdges& own,
                                           RectangleSides sides) {
    for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t axis = (polygon.plane.axis + 1 + i) % 3;
        const auto& [own_low, own_high] = own.along[i];
        if (own_low && polygon.lo[axis] >= sides[i][at_low].at)
            sides[i][at_low] = {polygon.lo[axis], *own_low};
        if (own_high && polygon.hi[axis] <= sides[i][at_high].at)
            sides[i][at_high] = {polygon.hi[axis], *own_high};
        if (sides[i][at_low].at >= sides[i][at_high].at) return std::nullopt;
    }
    return sides;
}

// Counter-clockwise seen from above the support, whose normal points up or down the axis.
RectangleCorners corners_of(const RectangleSides& sides, bool up) {
    const auto corner = [&](std::size_t i, std::size_t j, std::size_t axis, std::size_t side) {
        return RectangleCorner{{sides[0][i].at, sides[1][j].at}, sides[axis][side].edge};
    };
    if (up)
        return {corner(at_low, at_low, 1, at_low), corner(at_high, at_low, 0, at_high),
                corner(at_high, at_high, 1, at_high), corner(at_low, at_high, 0, at_low)};
    return {corner(at_low, at_low, 0, at_low), corner(at_low, at_high, 1, at_high),
            corner(at_high, at_high, 0, at_high), corner(at_high, at_low, 1, at_low)};
}

// A coordinate of a place that is given in 1/192 units.
void set(Approximation& a, std::size_t axis, std::int64_t at) {
    a.c[axis] = static_cast<double>(at) / static_cast<double>(splitting_scale);
    if (at % splitting_scale != 0) a.error = std::max(a.error, last_place * std::fabs(a.c[axis]));
}

// Doubles of places in the plane of a polygon.
class PlaneVertices {
public:
    explicit PlaneVertices(const AxisPlane& plane) : plane_(plane) {}

    [[nodiscard]] Approximation at(const RectangleCorner& c) const {
        Approximation a;
        set(a, plane_.axis, plane_.position);
        for (std::size_t i = 0; i < 2; ++i) set(a, axis(i), c.at[i]);
        return a;
    }
    // Where a line crosses the side from one corner to the next.
    [[nodiscard]] Approximation crossing(const SlantedEdge& line, const RectangleCorner& a,
                                         const RectangleCorner& b) const {
        const std::size_t fixed = a.at[0] == b.at[0] ? 0 : 1;
        const std::size_t free = 1 - fixed;
        Approximation x;
        set(x, plane_.axis, plane_.position);
        set(x, axis(fixed), a.at[fixed]);
        const auto step = [&](std::size_t i) { return Int128{line.to[i] - line.from[i]}; };
        const Int128 way = a.at[fixed] - Int128{line.from[fixed]} * splitting_scale;
        const double shift = static_cast<double>(way * step(free)) /
                             static_cast<double>(step(fixed) * splitting_scale);
        const auto from = static_cast<double>(line.from[free]);
        x.c[axis(free)] = from + shift;
        x.error = std::max(x.error, 0x1p-51 * (std::fabs(from) + 2 * std::fabs(shift)));
        return x;
    }

private:
    [[nodiscard]] std::size_t axis(std::size_t i) const { return (plane_.axis + 1 + i) % 3; }
    const AxisPlane& plane_;
};

// 1 on the polygon's side of its slanted edge, 0 on it.
int side_of_line(const SlantedEdge& line, const RectangleCorner& c) {
    const auto step = [&](std::size_t i) { return Int128{line.to[i] - line.from[i]}; };
    const Int128 turn = step(0) * (c.at[1] - Int128{line.from[1]} * splitting_scale) -
                        step(1) * (c.at[0] - Int128{line.from[0]} * splitting_scale);
    return turn > 0 ? 1 : (turn < 0 ? -1 : 0);
}

// What a slanted edge leaves of a rectangle.
Outline cut(const RectangleCorners& corners, const SlantedEdge& line, const EdgeName& slanted,
            const PlaneVertices& vertices) {
    std::array<int, 4> sides{};
    for (std::size_t i = 0; i < 4; ++i) sides[i] = side_of_line(line, corners[i]);
    Outline out;
    for (std::size_t i = 0; i < 4; ++i) {
        const RectangleCorner& here = corners[i];
        const int s = sides[i];
        const int t = sides[(i + 1) % 4];
        if (s > 0) out.add(vertices.at(here), here.edge);
        if (s == 0) {
            // Whether the outline goes on along the side or along the line; a corner that the line
            // touches from outside is no part of it.
            if (t > 0) {
                out.add(vertices.at(here), here.edge);
            } else if (sides[(i + 3) % 4] > 0) {
                out.add(vertices.at(here), slanted);
            }
        } else if (s * t < 0) {
            out.add(vertices.crossing(line, here, corners[(i + 1) % 4]),
                    t > 0 ? here.edge : slanted);
        }
    }
    return out;
}

Box box_of(std::span<const Approximation> vertices) {
    Box box;
    for (const Approximation& a : vertices)
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] =
                std::min(box.lo[k], static_cast<std::int64_t>(std::floor(a.c[k] - a.error)));
            box.hi[k] = std::max(box.hi[k], static_cast<std::int64_t>(std::ceil(a.c[k] + a.error)));
        }
    return box;
}

}  // namespace

std::optional<PolygonRef> clip_to_rectangle(const AxisPolygon& polygon,
                                            const AxisRectangle& rectangle) {
    const OwnEdges own = own_edges(polygon);
    const auto sides = common_sides(polygon, own, rectangle.sides);
    if (!sides) return std::nullopt;
    const RectangleCorners corners = corners_of(*sides, polygon.plane.sign > 0);
    const PlaneVertices vertices(polygon.plane);
    Outline outline;
    if (polygon.slanted_count == 0) {
        for (const RectangleCorner& c : corners) outline.add(vertices.at(c), c.edge);
    } else {
        outline = cut(corners, polygon.slanted[0], own.slanted, vertices);
        if (outline.size < 3) return std::nullopt;
    }
    const auto made = std::span(outline.vertices).first(outline.size);
    PolygonRef ref = polygon.ref;
    ref.fragment = Fragment::make(std::span(outline.edges).first(outline.size), made, box_of(made));
    return ref;
}

}  // namespace trisect::detail
