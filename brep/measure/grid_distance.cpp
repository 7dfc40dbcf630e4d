// SPDX-License-Identifier: Apache-2.0
//
// Widths: coordinates on the grid have 94 bits with their sign, edges 95, edge normals the same,
// their products with points 191; the triangle's normal has 191 bits and its product with the
// difference of two points 95 + 191 + 2 = 288. Only quotients are rounded: an integer to a double,
// within 2^-52 of it, sums of two or three such, and one division; 2^-48 covers all of them.
#include <trisect/brep/measure/grid_distance.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/brep/measure/exact_values.h>
#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

constexpr double grid_unit = 0x1p-40;
constexpr double upward = 1 + 0x1p-48;
/// Coordinates below 2^53 are rounded by at most one unit, those of points and those of boxes.
constexpr double slack = 2;

Int128 to_int128(const mpz_class& v) {
    std::vector<std::uint64_t> limbs = limbs_of(v);
    limbs.resize(2);
    const auto value = static_cast<Int128>((Uint128{limbs[1]} << 64) | limbs[0]);
    return sgn(v) < 0 ? -value : value;
}

Int128 floor_on_grid(const mpz_class& x, const mpz_class& w) {
    const mpz_class shifted = x << grid_bits;
    mpz_class quotient;
    mpz_fdiv_q(quotient.get_mpz_t(), shifted.get_mpz_t(), w.get_mpz_t());
    return to_int128(quotient);
}

double rounded_magnitude(Int128 v) { return std::fabs(WideInt<2>(v).to_double()); }

WideInt<3> product(Int128 a, Int128 b) { return multiply<3>(WideInt<2>(a), WideInt<2>(b)); }

GridPoint difference(const GridPoint& a, const GridPoint& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// In lattice units, within 2^-51 of it.
std::array<double, 3> rounded(const GridPoint& p) {
    return {WideInt<2>(p[0]).to_double() * grid_unit, WideInt<2>(p[1]).to_double() * grid_unit,
            WideInt<2>(p[2]).to_double() * grid_unit};
}

}  // namespace

GridPoint to_grid(const LatticePoint& p) {
    if (!p.is_whole()) {
        const auto floored = [](Coordinate x) {
            return static_cast<Int128>(std::floor(std::ldexp(x.to_double(), grid_bits)));
        };
        return {floored(p.x), floored(p.y), floored(p.z)};
    }
    const auto c = to_integers(p);
    return {Int128{c[0]} << grid_bits, Int128{c[1]} << grid_bits, Int128{c[2]} << grid_bits};
}

GridPoint to_grid(const Point& p) {
    if (p.is_lattice()) return to_grid(p.lattice());
    const HomogeneousPoint h = p.homogeneous();
    const mpz_class w = to_integer(h.w);
    return {floor_on_grid(to_integer(h.xyz[0]), w), floor_on_grid(to_integer(h.xyz[1]), w),
            floor_on_grid(to_integer(h.xyz[2]), w)};
}

GridPoint to_grid(const ExactPoint& p, Lattice lattice) {
    GridPoint out{};
    for (std::size_t k = 0; k < 3; ++k) {
        const mpq_class value = to_fraction(p[k].scaled(-lattice.exponent));
        out[k] = floor_on_grid(value.get_num(), value.get_den());
    }
    return out;
}

GridTriangle::GridTriangle(const GridPoint& a, const GridPoint& b, const GridPoint& c)
    : corner_{a, b, c} {
    for (std::size_t k = 0; k < 3; ++k) {
        low_[k] = std::min({a[k], b[k], c[k]});
        high_[k] = std::max({a[k], b[k], c[k]});
    }
    std::size_t n = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const GridPoint e = difference(corner_[(i + 1) % 3], corner_[i]);
        for (int axis = 0; axis < 3; ++axis) {
            Slab& s = slabs_[n++];
            s.u = (axis + 1) % 3;
            s.v = (axis + 2) % 3;
            // e × e_axis, up to its sign.
            s.nu = e[static_cast<std::size_t>(s.v)];
            s.nv = -e[static_cast<std::size_t>(s.u)];
            s.length = rounded_magnitude(s.nu) + rounded_magnitude(s.nv);
            if (s.length == 0) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const WideInt<3> value = product(s.nu, corner_[k][static_cast<std::size_t>(s.u)]) +
                                         product(s.nv, corner_[k][static_cast<std::size_t>(s.v)]);
                s.low = k == 0 ? value : std::min(s.low, value);
                s.high = k == 0 ? value : std::max(s.high, value);
            }
        }
    }
    const GridPoint p = difference(b, a);
    const GridPoint q = difference(c, a);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        normal_[k] = product(p[u], q[v]) - product(p[v], q[u]);
        normal_length_ += std::fabs(normal_[k].to_double());
    }
}

double GridTriangle::upper_distance(const GridPoint& p, double enough) const {
    double most = 0;  // in units of the grid
    const double stop = enough / grid_unit;
    for (std::size_t k = 0; k < 3; ++k) {
        if (p[k] < low_[k]) most = std::max(most, rounded_magnitude(low_[k] - p[k]));
        if (p[k] > high_[k]) most = std::max(most, rounded_magnitude(p[k] - high_[k]));
    }
    if (normal_length_ > 0 && most <= stop) {
        WideInt<5> value;
        for (std::size_t k = 0; k < 3; ++k)
            value += multiply<5>(normal_[k], WideInt<2>(p[k] - corner_[0][k]));
        most = std::max(most, std::fabs(value.to_double()) / normal_length_);
    }
    for (const Slab& s : slabs_) {
        if (s.length == 0 || most > stop) continue;
        const WideInt<3> value = product(s.nu, p[static_cast<std::size_t>(s.u)]) +
                                 product(s.nv, p[static_cast<std::size_t>(s.v)]);
        if (value < s.low) most = std::max(most, (s.low - value).to_double() / s.length);
        if (value > s.high) most = std::max(most, (value - s.high).to_double() / s.length);
    }
    return most * grid_unit * upward + grid_error;
}

GridTriangles::GridTriangles(std::vector<GridTriangle> triangles)
    : triangles_(std::move(triangles)) {
    std::vector<Box> boxes;
    boxes.reserve(triangles_.size());
    for (const GridTriangle& t : triangles_) {
        order_.push_back(static_cast<std::uint32_t>(order_.size()));
        boxes.push_back(box_of(t));
    }
    if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(order_.size()), boxes);
}

double GridTriangles::Box::distance(const std::array<double, 3>& p) const {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) most = std::max({most, low[k] - p[k], p[k] - high[k]});
    return most;
}

GridTriangles::Box GridTriangles::box_of(const GridTriangle& t) {
    Box box;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto c = rounded(t.corners()[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = i == 0 ? c[k] : std::min(box.low[k], c[k]);
            box.high[k] = i == 0 ? c[k] : std::max(box.high[k], c[k]);
        }
    }
    return box;
}

std::uint32_t GridTriangles::build(std::uint32_t begin, std::uint32_t end,
                                   std::vector<Box>& boxes) {
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Box all = boxes[order_[begin]];
    for (std::uint32_t i = begin; i < end; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            all.low[k] = std::min(all.low[k], boxes[order_[i]].low[k]);
            all.high[k] = std::max(all.high[k], boxes[order_[i]].high[k]);
        }
    }
    nodes_[self] = {all, begin, end, 0};
    if (end - begin <= 4) return self;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (all.high[k] - all.low[k] > all.high[axis] - all.low[axis]) axis = k;
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::uint32_t i) { return order_.begin() + i; };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
        const double x = boxes[a].low[axis] + boxes[a].high[axis];
        const double y = boxes[b].low[axis] + boxes[b].high[axis];
        return x != y ? x < y : a < b;
    });
    build(begin, middle, boxes);
    const std::uint32_t right = build(middle, end, boxes);
    nodes_[self].right = right;
    return self;
}

GridTriangles::Nearest GridTriangles::nearest(const GridPoint& p) const {
    const auto at = rounded(p);
    Nearest best;
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
        const std::uint32_t i = stack.back();
        stack.pop_back();
        const Node& node = nodes_[i];
        if (node.box.distance(at) - slack > best.upper) continue;
        if (node.right == 0) {
            for (std::uint32_t k = node.begin; k < node.end; ++k) {
                const double d = triangles_[order_[k]].upper_distance(p, best.upper);
                if (d < best.upper || (d == best.upper && order_[k] < best.triangle)) {
                    best.upper = d;
                    best.triangle = order_[k];
                }
            }
            continue;
        }
        const std::uint32_t left = i + 1;
        const bool left_first =
            nodes_[left].box.distance(at) <= nodes_[node.right].box.distance(at);
        stack.push_back(left_first ? node.right : left);
        stack.push_back(left_first ? left : node.right);
    }
    best.lower = std::max(0.0, best.upper * (2 - upward * upward) - 3 * grid_error);
    return best;
}

void GridTriangles::near(const GridPoint& p, double radius, std::size_t limit,
                         std::vector<std::uint32_t>& out) const {
    const auto at = rounded(p);
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty() && out.size() < limit) {
        const std::uint32_t i = stack.back();
        stack.pop_back();
        const Node& node = nodes_[i];
        if (node.box.distance(at) - slack > radius) continue;
        if (node.right == 0) {
            for (std::uint32_t k = node.begin; k < node.end && out.size() < limit; ++k)
                if (triangles_[order_[k]].upper_distance(p, radius) <= radius)
                    out.push_back(order_[k]);
            continue;
        }
        stack.push_back(node.right);
        stack.push_back(i + 1);
    }
}

}  // namespace trisect::detail
