// SPDX-License-Identifier: Apache-2.0
//
// A polygon with at most one slanted edge is what that edge leaves of a box, and the common part of
// two boxes is a box. So there is one clip of a rectangle by a line, whose corners are integers.

#include <trisect/bsp/detail/axis_clip.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

constexpr std::size_t low = 0;
constexpr std::size_t high = 1;

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
        const std::size_t side = e.above == (across->sign > 0) ? low : high;
        const std::int64_t bound = side == low ? p.lo[across->axis] : p.hi[across->axis];
        if (across->position == bound) out.along[i][side] = e;
    };
    if (p.ref.fragment != nullptr) {
        for (const EdgeName& e : p.ref.fragment->edges()) add(e);
    } else {
        for (int i = 0; i < 3; ++i) add({PlaneName::edge(p.ref.source, p.ref.facet, i), false});
    }
    return out;
}

// Of the rectangle, in 1/256 lattice units.
struct Corner {
    std::array<std::int64_t, 2> at{};
    EdgeName edge;  // that begins here
};

struct Outline {
    std::array<EdgeName, 5> edges;
    std::array<Approximation, 5> vertices;
    std::size_t size = 0;
};

// A coordinate of a place that is given in 1/256 units.
void set(Approximation& a, std::size_t axis, std::int64_t at) {
    a.c[axis] = static_cast<double>(at) / static_cast<double>(wall_scale);
    if (at % wall_scale != 0) a.error = std::max(a.error, 0x1p-52 * std::fabs(a.c[axis]));
}

}  // namespace

std::optional<PolygonRef> clip_to_rectangle(const AxisPolygon& polygon,
                                            const AxisRectangle& rectangle) {
    const std::size_t k = polygon.plane.axis;
    const std::array<std::size_t, 2> axes{(k + 1) % 3, (k + 2) % 3};
    const OwnEdges own = own_edges(polygon);
    std::array<std::array<AxisRectangle::Side, 2>, 2> sides = rectangle.sides;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto& [own_low, own_high] = own.along[i];
        if (own_low && polygon.lo[axes[i]] >= sides[i][low].at)
            sides[i][low] = {polygon.lo[axes[i]], *own_low};
        if (own_high && polygon.hi[axes[i]] <= sides[i][high].at)
            sides[i][high] = {polygon.hi[axes[i]], *own_high};
        if (sides[i][low].at >= sides[i][high].at) return std::nullopt;
    }
    // Counter-clockwise seen from above the support.
    const bool up = polygon.plane.sign > 0;
    const std::array<Corner, 4> corners =
        up ? std::array<Corner, 4>{{{{sides[0][low].at, sides[1][low].at}, sides[1][low].edge},
                                    {{sides[0][high].at, sides[1][low].at}, sides[0][high].edge},
                                    {{sides[0][high].at, sides[1][high].at}, sides[1][high].edge},
                                    {{sides[0][low].at, sides[1][high].at}, sides[0][low].edge}}}
           : std::array<Corner, 4>{{{{sides[0][low].at, sides[1][low].at}, sides[0][low].edge},
                                    {{sides[0][low].at, sides[1][high].at}, sides[1][high].edge},
                                    {{sides[0][high].at, sides[1][high].at}, sides[0][high].edge},
                                    {{sides[0][high].at, sides[1][low].at}, sides[1][low].edge}}};
    Outline out;
    const auto add = [&](const Approximation& at, const EdgeName& edge) {
        out.vertices[out.size] = at;
        out.edges[out.size++] = edge;
    };
    const auto vertex = [&](const Corner& c) {
        Approximation a;
        set(a, k, polygon.plane.position);
        for (std::size_t i = 0; i < 2; ++i) set(a, axes[i], c.at[i]);
        return a;
    };
    if (polygon.slanted_count == 0) {
        for (const Corner& c : corners) add(vertex(c), c.edge);
    } else {
        const SlantedEdge& line = polygon.slanted[0];
        const auto step = [&](std::size_t i) { return Int128{line.to[i] - line.from[i]}; };
        // Positive on the polygon's side.
        const auto side = [&](const Corner& c) {
            const Int128 turn = step(0) * (c.at[1] - Int128{line.from[1]} * wall_scale) -
                                step(1) * (c.at[0] - Int128{line.from[0]} * wall_scale);
            return turn > 0 ? 1 : (turn < 0 ? -1 : 0);
        };
        // Where the line crosses a side of the rectangle.
        const auto crossing = [&](const Corner& a, const Corner& b) {
            const std::size_t fixed = a.at[0] == b.at[0] ? 0 : 1;
            const std::size_t free = 1 - fixed;
            Approximation x;
            set(x, k, polygon.plane.position);
            set(x, axes[fixed], a.at[fixed]);
            const Int128 way = a.at[fixed] - Int128{line.from[fixed]} * wall_scale;
            const double shift = static_cast<double>(way * step(free)) /
                                 static_cast<double>(step(fixed) * wall_scale);
            const auto from = static_cast<double>(line.from[free]);
            x.c[axes[free]] = from + shift;
            x.error = std::max(x.error, 0x1p-51 * (std::fabs(from) + 2 * std::fabs(shift)));
            return x;
        };
        for (std::size_t i = 0; i < 4; ++i) {
            const Corner& here = corners[i];
            const Corner& next = corners[(i + 1) % 4];
            const int s = side(here);
            const int t = side(next);
            if (s > 0) add(vertex(here), here.edge);
            if (s == 0) {
                // Whether the outline goes on along the side or along the line; a corner that the
                // line touches from outside is no part of it.
                const int before = side(corners[(i + 3) % 4]);
                if (t > 0) {
                    add(vertex(here), here.edge);
                } else if (before > 0) {
                    add(vertex(here), own.slanted);
                }
            } else if (s * t < 0) {
                add(crossing(here, next), t > 0 ? here.edge : own.slanted);
            }
        }
        if (out.size < 3) return std::nullopt;
    }
    Box box;
    for (std::size_t i = 0; i < out.size; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Approximation& a = out.vertices[i];
            box.lo[axis] =
                std::min(box.lo[axis], static_cast<std::int64_t>(std::floor(a.c[axis] - a.error)));
            box.hi[axis] =
                std::max(box.hi[axis], static_cast<std::int64_t>(std::ceil(a.c[axis] + a.error)));
        }
    PolygonRef ref = polygon.ref;
    ref.fragment = Fragment::make(std::span(out.edges).first(out.size),
                                  std::span(out.vertices).first(out.size), box);
    return ref;
}

}  // namespace trisect::detail
