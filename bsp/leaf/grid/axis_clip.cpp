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

template <class Number>
OwnEdges own_edges(const AxisPolygon<Number>& p) {
    OwnEdges out;
    const std::size_t k = p.plane.axis;
    const auto add = [&](const EdgeName& e) {
        const auto across = axis_plane<Number>(e.plane);
        if (!across) {
            out.slanted = e;
            return;
        }
        const std::size_t i = across->axis == (k + 1) % 3 ? 0 : 1;
        const std::size_t side = e.above == (across->sign > 0) ? at_low : at_high;
        const Number bound = side == at_low ? p.lo[across->axis] : p.hi[across->axis];
        if (across->position == bound) out.along[i][side] = e;
    };
    if (p.ref.fragment != nullptr) {
        for (const EdgeName& e : p.ref.fragment->edges()) add(e);
    } else {
        for (int i = 0; i < 3; ++i) add({PlaneName::edge(p.ref.source, p.ref.facet, i), false});
    }
    return out;
}

// Of the rectangle, as positions.
template <class Number>
struct RectangleCorner {
    std::array<Number, 2> at{};
    EdgeName edge;  // that begins here
};
template <class Number>
using RectangleCorners = std::array<RectangleCorner<Number>, 4>;
template <class Number>
using RectangleSides = decltype(AxisRectangle<Number>::sides);

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
template <class Number>
std::optional<RectangleSides<Number>> common_sides(const AxisPolygon<Number>& polygon,
                                                   const OwnEdges& own,
                                                   RectangleSides<Number> sides) {
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
template <class Number>
RectangleCorners<Number> corners_of(const RectangleSides<Number>& sides, bool up) {
    const auto corner = [&](std::size_t i, std::size_t j, std::size_t axis, std::size_t side) {
        return RectangleCorner<Number>{{sides[0][i].at, sides[1][j].at}, sides[axis][side].edge};
    };
    if (up)
        return {corner(at_low, at_low, 1, at_low), corner(at_high, at_low, 0, at_high),
                corner(at_high, at_high, 1, at_high), corner(at_low, at_high, 0, at_low)};
    return {corner(at_low, at_low, 0, at_low), corner(at_low, at_high, 1, at_high),
            corner(at_high, at_high, 0, at_high), corner(at_high, at_low, 1, at_low)};
}

// A coordinate, from its position.
template <class Number>
void set(Approximation& a, std::size_t axis, Number at) {
    a.c[axis] = rounded_axis_position(at);
    if (!AxisNumbers<Number>::is_place(at))
        a.error = std::max(a.error, last_place * std::fabs(a.c[axis]));
}

// How far from its beginning a line is at a position of one axis, along the other; off by less than
// 2^-51 of itself.
double shift_along(const SlantedEdge<std::int64_t>& line, std::int64_t at, std::size_t fixed) {
    constexpr std::int64_t scale = AxisNumbers<std::int64_t>::scale;
    const auto step = [&](std::size_t i) { return Int128{line.to[i] - line.from[i]}; };
    const Int128 way = at - Int128{line.from[fixed]} * scale;
    return static_cast<double>(way * step(1 - fixed)) / static_cast<double>(step(fixed) * scale);
}

double shift_along(const SlantedEdge<Int128>& line, Int128 at, std::size_t fixed) {
    using Numbers = AxisNumbers<Int128>;
    const auto step = [&](std::size_t i) { return line.to[i] - line.from[i]; };
    const Int128 way = at - line.from[fixed] * Numbers::scale;
    const double product = Numbers::multiply(way, step(1 - fixed)).to_double();
    return product / static_cast<double>(step(fixed) * Numbers::scale) * 0x1p-70;
}

// Doubles of places in the plane of a polygon.
template <class Number>
class PlaneVertices {
public:
    explicit PlaneVertices(const AxisPlane<Number>& plane) : plane_(plane) {}

    [[nodiscard]] Approximation at(const RectangleCorner<Number>& c) const {
        Approximation a;
        set(a, plane_.axis, plane_.position);
        for (std::size_t i = 0; i < 2; ++i) set(a, axis(i), c.at[i]);
        return a;
    }
    // Where a line crosses the side from one corner to the next.
    [[nodiscard]] Approximation crossing(const SlantedEdge<Number>& line,
                                         const RectangleCorner<Number>& a,
                                         const RectangleCorner<Number>& b) const {
        const std::size_t fixed = a.at[0] == b.at[0] ? 0 : 1;
        const std::size_t free = 1 - fixed;
        Approximation x;
        set(x, plane_.axis, plane_.position);
        set(x, axis(fixed), a.at[fixed]);
        const double from = AxisNumbers<Number>::to_double(line.from[free]);
        const double shift = shift_along(line, a.at[fixed], fixed);
        x.c[axis(free)] = from + shift;
        x.error = std::max(x.error, 0x1p-51 * (std::fabs(from) + 2 * std::fabs(shift)));
        return x;
    }

private:
    [[nodiscard]] std::size_t axis(std::size_t i) const { return (plane_.axis + 1 + i) % 3; }
    const AxisPlane<Number>& plane_;
};

// 1 on the polygon's side of its slanted edge, 0 on it.
template <class Number>
int side_of_line(const SlantedEdge<Number>& line, const RectangleCorner<Number>& c) {
    using Numbers = AxisNumbers<Number>;
    const auto step = [&](std::size_t i) { return line.to[i] - line.from[i]; };
    const auto way = [&](std::size_t i) { return c.at[i] - line.from[i] * Numbers::scale; };
    const auto left = Numbers::multiply(step(0), way(1));
    const auto right = Numbers::multiply(step(1), way(0));
    return left > right ? 1 : (left < right ? -1 : 0);
}

// What a slanted edge leaves of a rectangle.
template <class Number>
Outline cut(const RectangleCorners<Number>& corners, const SlantedEdge<Number>& line,
            const EdgeName& slanted, const PlaneVertices<Number>& vertices) {
    std::array<int, 4> sides{};
    for (std::size_t i = 0; i < 4; ++i) sides[i] = side_of_line(line, corners[i]);
    Outline out;
    for (std::size_t i = 0; i < 4; ++i) {
        const RectangleCorner<Number>& here = corners[i];
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

template <class Number>
std::optional<PolygonRef> clip_to_rectangle(const AxisPolygon<Number>& polygon,
                                            const AxisRectangle<Number>& rectangle) {
    const OwnEdges own = own_edges(polygon);
    const auto sides = common_sides(polygon, own, rectangle.sides);
    if (!sides) return std::nullopt;
    const RectangleCorners<Number> corners = corners_of<Number>(*sides, polygon.plane.sign > 0);
    const PlaneVertices<Number> vertices(polygon.plane);
    Outline outline;
    if (polygon.slanted_count == 0) {
        for (const RectangleCorner<Number>& c : corners) outline.add(vertices.at(c), c.edge);
    } else {
        outline = cut(corners, polygon.slanted[0], own.slanted, vertices);
        if (outline.size < 3) return std::nullopt;
    }
    const auto made = std::span(outline.vertices).first(outline.size);
    PolygonRef ref = polygon.ref;
    ref.fragment = Fragment::make(std::span(outline.edges).first(outline.size), made, box_of(made));
    return ref;
}

template std::optional<PolygonRef> clip_to_rectangle(const AxisPolygon<std::int64_t>& polygon,
                                                     const AxisRectangle<std::int64_t>& rectangle);
template std::optional<PolygonRef> clip_to_rectangle(const AxisPolygon<Int128>& polygon,
                                                     const AxisRectangle<Int128>& rectangle);

}  // namespace trisect::detail
