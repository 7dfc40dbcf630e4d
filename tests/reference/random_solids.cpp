// SPDX-License-Identifier: Apache-2.0
#include "random_solids.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace reference {
namespace {

constexpr std::int64_t grid = 15;

using Corner = LatticePolygon::value_type;

std::int64_t turn(const Corner& a, const Corner& b, const Corner& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

std::int64_t doubled_area(const LatticePolygon& polygon) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner& a = polygon[i];
        const Corner& b = polygon[(i + 1) % polygon.size()];
        sum += a[0] * b[1] - a[1] * b[0];
    }
    return sum;
}

LatticePolygon counter_clockwise(LatticePolygon polygon) {
    if (doubled_area(polygon) < 0) {
        std::reverse(polygon.begin(), polygon.end());
    }
    return polygon;
}

// Whether corner i of the counter-clockwise polygon can be cut off.
bool is_ear(const LatticePolygon& polygon, std::size_t i) {
    const std::size_t n = polygon.size();
    const Corner& a = polygon[(i + n - 1) % n];
    const Corner& b = polygon[i];
    const Corner& c = polygon[(i + 1) % n];
    if (turn(a, b, c) <= 0) {
        return false;
    }
    return std::none_of(polygon.begin(), polygon.end(), [&](const Corner& p) {
        return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
               turn(c, a, p) >= 0;
    });
}

// Ear clipping of a counter-clockwise simple polygon.
std::vector<std::array<Corner, 3>> triangulated(LatticePolygon polygon) {
    std::vector<std::array<Corner, 3>> triangles;
    while (polygon.size() > 2) {
        std::size_t i = 0;
        while (i < polygon.size() && !is_ear(polygon, i)) {
            ++i;
        }
        if (i == polygon.size()) {
            throw std::logic_error("reference: a polygon is not simple");
        }
        const std::size_t n = polygon.size();
        triangles.push_back({polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]});
        polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return triangles;
}

LatticePoint raised(const Corner& p, std::int64_t height) { return {p[0], p[1], height}; }

// count different integers in 0..grid, ascending.
std::vector<std::int64_t> ascending(Random& random, std::size_t count) {
    std::vector<std::int64_t> values;
    while (values.size() < count) {
        const std::int64_t value = random.between(0, grid);
        if (std::find(values.begin(), values.end(), value) == values.end()) {
            values.push_back(value);
        }
    }
    std::sort(values.begin(), values.end());
    return values;
}

LatticePoint random_point(Random& random) {
    return {random.between(0, grid), random.between(0, grid), random.between(0, grid)};
}

LatticePolygon random_triangle(Random& random) {
    for (;;) {
        LatticePolygon polygon;
        for (int i = 0; i < 3; ++i) {
            polygon.push_back({random.between(0, grid), random.between(0, grid)});
        }
        if (doubled_area(polygon) != 0) {
            return polygon;
        }
    }
}

LatticePolygon random_rectangle(Random& random) {
    const auto x = ascending(random, 2);
    const auto y = ascending(random, 2);
    return {{x[0], y[0]}, {x[1], y[0]}, {x[1], y[1]}, {x[0], y[1]}};
}

// L, T, U or cross on random lines.
LatticePolygon random_rectilinear(Random& random) {
    const auto x = ascending(random, 4);
    const auto y = ascending(random, 4);
    switch (random.below(4)) {
        case 0:
            return {{x[0], y[0]}, {x[3], y[0]}, {x[3], y[1]},
                    {x[1], y[1]}, {x[1], y[3]}, {x[0], y[3]}};
        case 1:
            return {{x[0], y[2]}, {x[1], y[2]}, {x[1], y[0]}, {x[2], y[0]},
                    {x[2], y[2]}, {x[3], y[2]}, {x[3], y[3]}, {x[0], y[3]}};
        case 2:
            return {{x[0], y[0]}, {x[3], y[0]}, {x[3], y[3]}, {x[2], y[3]},
                    {x[2], y[1]}, {x[1], y[1]}, {x[1], y[2]}, {x[0], y[2]}};
        default:
            return {{x[1], y[0]}, {x[2], y[0]}, {x[2], y[1]}, {x[3], y[1]},
                    {x[3], y[2]}, {x[2], y[2]}, {x[2], y[3]}, {x[1], y[3]},
                    {x[1], y[2]}, {x[0], y[2]}, {x[0], y[1]}, {x[1], y[1]}};
    }
}

// Between a lower and an upper chain over the same x, which meet at one end at most.
LatticePolygon random_monotone(Random& random) {
    const auto x = ascending(random, 2 + random.below(3));
    LatticePolygon lower;
    LatticePolygon upper;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const auto y = ascending(random, 2);
        lower.push_back({x[i], y[0]});
        if (i > 0 || x.size() == 2 || random.chance(1, 2)) {
            upper.push_back({x[i], y[1]});
        }
    }
    lower.insert(lower.end(), upper.rbegin(), upper.rend());
    return lower;
}

LatticePolygon random_polygon(Random& random) {
    switch (random.below(4)) {
        case 0:
            return random_triangle(random);
        case 1:
            return random_rectangle(random);
        case 2:
            return random_rectilinear(random);
        default:
            return random_monotone(random);
    }
}

Operand random_tetrahedron(Random& random) {
    for (;;) {
        const LatticePoint a = random_point(random);
        const LatticePoint b = random_point(random);
        const LatticePoint c = random_point(random);
        const LatticePoint d = random_point(random);
        const auto plane = plane_through(a, b, c);
        if (plane && plane->value(to_point(d)) != 0) {
            return tetrahedron(a, b, c, d);
        }
    }
}

Operand random_box(Random& random) {
    const auto x = ascending(random, 2);
    const auto y = ascending(random, 2);
    const auto z = ascending(random, 2);
    return box({x[0], y[0], z[0]}, {x[1], y[1], z[1]});
}

// Two pyramids on one convex base, without the base.
Operand random_octahedron(Random& random) {
    const auto z = ascending(random, 3);
    const auto x = ascending(random, 3);
    const auto y = ascending(random, 3);
    const LatticePolygon base =
        random.chance(1, 2)
            ? LatticePolygon{{x[0], y[1]}, {x[1], y[0]}, {x[2], y[1]}, {x[1], y[2]}}
            : LatticePolygon{{x[0], y[0]}, {x[2], y[0]}, {x[2], y[2]}, {x[0], y[2]}};
    const LatticePoint bottom{x[1], y[1], z[0]};
    const LatticePoint top{x[1], y[1], z[2]};
    Operand result;
    for (std::size_t i = 0; i < 4; ++i) {
        const LatticePoint p = raised(base[i], z[1]);
        const LatticePoint q = raised(base[(i + 1) % 4], z[1]);
        result.push_back({p, q, top});
        result.push_back({q, p, bottom});
    }
    return result;
}

struct Bounds {
    LatticePoint low;
    LatticePoint high;
};

Bounds bounds_of(const Operand& operand) {
    Bounds bounds{operand.at(0)[0], operand.at(0)[0]};
    for (const Triangle& triangle : operand) {
        for (const LatticePoint& p : triangle) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                bounds.low[axis] = std::min(bounds.low[axis], p[axis]);
                bounds.high[axis] = std::max(bounds.high[axis], p[axis]);
            }
        }
    }
    return bounds;
}

const LatticePoint& random_corner(Random& random, const Operand& operand) {
    return operand[random.below(operand.size())][random.below(3)];
}

// A box against one side of the bounds, with sides that often coincide.
Operand box_beside(Random& random, const Bounds& bounds) {
    LatticePoint low{};
    LatticePoint high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = random.chance(1, 2) ? bounds.low[axis]
                                        : random.between(bounds.low[axis], bounds.high[axis] - 1);
        high[axis] = random.chance(1, 2) ? bounds.high[axis]
                                         : random.between(low[axis] + 1, bounds.high[axis] + 2);
        high[axis] = std::max(high[axis], low[axis] + 1);
    }
    const std::size_t axis = random.below(3);
    const std::int64_t thickness = random.between(1, 6);
    if (random.chance(1, 2)) {
        low[axis] = bounds.high[axis];
    } else {
        low[axis] = bounds.low[axis] - thickness;
    }
    high[axis] = low[axis] + thickness;
    return box(low, high);
}

// A solid that touches or coincides with part of the given one on purpose.
Operand random_neighbour(Random& random, const Operand& other, bool embedded) {
    const Bounds bounds = bounds_of(other);
    switch (random.below(5)) {
        case 0:
            return other;
        case 1: {
            // The same solid moved by its own extent along some axes: side by side, or edge to
            // edge, or corner to corner.
            LatticePoint by{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                by[axis] = random.between(-1, 1) * (bounds.high[axis] - bounds.low[axis]);
            }
            return translated(other, by);
        }
        case 2: {
            const LatticePoint& from = random_corner(random, other);
            const LatticePoint& to = random_corner(random, other);
            return translated(other, {to[0] - from[0], to[1] - from[1], to[2] - from[2]});
        }
        case 3: {
            const Operand fresh = embedded ? random_embedded_solid(random) : random_operand(random);
            const LatticePoint& from = random_corner(random, fresh);
            const LatticePoint& to = random_corner(random, other);
            return translated(fresh, {to[0] - from[0], to[1] - from[1], to[2] - from[2]});
        }
        default:
            return box_beside(random, bounds);
    }
}

}  // namespace

std::uint64_t Random::next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

std::int64_t Random::between(std::int64_t low, std::int64_t high) {
    const auto range = static_cast<std::uint64_t>(high - low) + 1;
    return low + static_cast<std::int64_t>(next() % range);
}

Operand box(const LatticePoint& low, const LatticePoint& high) {
    return prism({{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}},
                 low[2], high[2]);
}

Operand tetrahedron(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                    const LatticePoint& d) {
    const Operand result{{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}};
    return signed_volume(result) < 0 ? reversed(result) : result;
}

Operand prism(const LatticePolygon& polygon, std::int64_t low, std::int64_t high) {
    const LatticePolygon base = counter_clockwise(polygon);
    Operand result;
    for (const auto& [a, b, c] : triangulated(base)) {
        result.push_back({raised(a, high), raised(b, high), raised(c, high)});
        result.push_back({raised(a, low), raised(c, low), raised(b, low)});
    }
    for (std::size_t i = 0; i < base.size(); ++i) {
        const Corner& a = base[i];
        const Corner& b = base[(i + 1) % base.size()];
        result.push_back({raised(a, low), raised(b, low), raised(b, high)});
        result.push_back({raised(a, low), raised(b, high), raised(a, high)});
    }
    return result;
}

Operand pyramid(const LatticePolygon& polygon, std::int64_t base, const LatticePoint& apex) {
    const LatticePolygon corners = counter_clockwise(polygon);
    Operand result;
    for (const auto& [a, b, c] : triangulated(corners)) {
        result.push_back({raised(a, base), raised(c, base), raised(b, base)});
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        result.push_back(
            {raised(corners[i], base), raised(corners[(i + 1) % corners.size()], base), apex});
    }
    return apex[2] < base ? reversed(result) : result;
}

Operand translated(Operand operand, const LatticePoint& by) {
    for (Triangle& triangle : operand) {
        for (LatticePoint& p : triangle) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                p[axis] += by[axis];
            }
        }
    }
    return operand;
}

Operand reversed(Operand operand) {
    for (Triangle& triangle : operand) {
        std::swap(triangle[1], triangle[2]);
    }
    return operand;
}

Operand axes_rotated(Operand operand, std::size_t turns) {
    for (Triangle& triangle : operand) {
        for (LatticePoint& p : triangle) {
            p = {p[turns % 3], p[(turns + 1) % 3], p[(turns + 2) % 3]};
        }
    }
    return operand;
}

Operand concatenated(Operand a, const Operand& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

Operand random_embedded_solid(Random& random) {
    const auto z = ascending(random, 2);
    const auto solid = [&]() -> Operand {
        switch (random.below(6)) {
            case 0:
                return random_tetrahedron(random);
            case 1:
                return random_box(random);
            case 2:
                return prism(random_triangle(random), z[0], z[1]);
            case 3: {
                const LatticePolygon base =
                    random.chance(1, 2) ? random_triangle(random) : random_rectangle(random);
                const bool upright = random.chance(1, 2);
                const LatticePoint apex{random.between(0, grid), random.between(0, grid),
                                        upright ? z[1] : z[0]};
                return pyramid(base, upright ? z[0] : z[1], apex);
            }
            case 4:
                return random_octahedron(random);
            default:
                return prism(random_polygon(random), z[0], z[1]);
        }
    };
    const Operand result = solid();
    return axes_rotated(result, random.below(3));
}

Operand with_folds(Random& random, const Operand& operand, std::size_t most) {
    Operand out = operand;
    const auto insert = [&](const Triangle& t) {
        const auto at = static_cast<std::ptrdiff_t>(random.below(out.size() + 1));
        out.insert(out.begin() + at, t);
    };
    for (std::size_t n = random.below(most) + 1; n > 0; --n) {
        const Triangle t = operand[random.below(operand.size())];
        insert(t);
        insert({t[1], t[0], t[2]});
    }
    return out;
}

Operand random_operand(Random& random) {
    const Operand solid = random_embedded_solid(random);
    switch (random.below(8)) {
        case 0: {
            Operand sum = solid;
            for (std::size_t i = random.below(2); i < 2; ++i) {
                sum = concatenated(sum, random_embedded_solid(random));
            }
            return sum;
        }
        case 1:
            return concatenated(solid, random_neighbour(random, solid, true));
        case 2:
        case 3: {
            // A box around the solid that leaves room or touches it: winding number 2 inside the
            // solid, or 0 if it is a cavity.
            Bounds bounds = bounds_of(solid);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                bounds.low[axis] -= random.between(0, 2);
                bounds.high[axis] += random.between(0, 2);
            }
            return concatenated(box(bounds.low, bounds.high),
                                random.chance(1, 2) ? solid : reversed(solid));
        }
        case 4:
            return random.chance(1, 2) ? reversed(solid)
                                       : concatenated(solid, reversed(random_box(random)));
        default:
            return solid;
    }
}

std::vector<Operand> random_family(Random& random, std::size_t count, bool embedded) {
    std::vector<Operand> family;
    while (family.size() < count) {
        if (!family.empty() && random.chance(1, 2)) {
            const Operand& other = family[random.below(family.size())];
            family.push_back(random_neighbour(random, other, embedded));
        } else {
            family.push_back(embedded ? random_embedded_solid(random) : random_operand(random));
        }
    }
    return family;
}

Expression random_expression(Random& random, std::size_t operand_count, std::size_t operations,
                             bool with_complements) {
    using Kind = Expression::Kind;
    if (operand_count == 0 || operations + 1 < operand_count) {
        throw std::invalid_argument("reference: too few operations for the operands");
    }
    std::vector<Expression> parts;
    for (std::size_t i = 0; i <= operations; ++i) {
        parts.push_back(Expression::leaf(i < operand_count ? i : random.below(operand_count)));
    }
    const auto take = [&] {
        const auto at = parts.begin() + static_cast<std::ptrdiff_t>(random.below(parts.size()));
        Expression part = std::move(*at);
        parts.erase(at);
        if (with_complements && random.chance(1, 8)) {
            part = Expression::node(Kind::Complement, {std::move(part)});
        }
        return part;
    };
    while (parts.size() > 1) {
        constexpr std::array kinds{Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor};
        const Kind kind = kinds[random.below(kinds.size())];
        Expression first = take();
        Expression second = take();
        parts.push_back(Expression::node(kind, {std::move(first), std::move(second)}));
    }
    return std::move(parts.front());
}

}  // namespace reference
