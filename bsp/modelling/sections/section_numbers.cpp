// SPDX-License-Identifier: Apache-2.0
//
// Coordinates are quotients of sums of products of those of the mesh and the height.

#include <trisect/bsp/modelling/sections/section_numbers.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <trisect/brep/measure/exact_values.h>

namespace trisect::detail {

namespace {

mpq_class in_users_units(mpq_class v, Lattice lattice) {
    if (lattice.exponent < 0)
        v >>= static_cast<unsigned long>(-lattice.exponent);
    else
        v <<= static_cast<unsigned long>(lattice.exponent);
    return v;
}

std::array<mpq_class, 3> exact_point(const MeshSection& mesh, std::uint32_t v) {
    const ExactMesh* const exact = mesh.exact_mesh();
    if (mesh.is_double(v)) {
        const Point3d& p = mesh.near(v);
        return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])};
    }
    const Corner c = corner_at(exact->points[v]);
    std::array<mpq_class, 3> out;
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = in_users_units(fraction(c.x[k], c.w), exact->lattice);
    return out;
}

mpq_class level(const SliceFrame& frame, const std::array<mpq_class, 3>& p) {
    const Point3d& n = frame.normal();
    if (frame.is_axis()) return n[frame.along()] * p[frame.along()];
    return mpq_class(n[0]) * p[0] + mpq_class(n[1]) * p[1] + mpq_class(n[2]) * p[2];
}

double nearest(const mpq_class& v) {
    return to_rational(v.get_num(), v.get_den()).to_double() + 0.0;
}

/// The nearest double of a number that is at most `error` away from the pair.
std::optional<double> nearest(const DoublePair& v, double error) {
    const double slack = error + 0x1p-50 * std::fabs(v.low);
    if (v.high + (v.low + slack) != v.high || v.high + (v.low - slack) != v.high)
        return std::nullopt;
    return v.high + 0.0;
}

struct Sides {
    Point2d to_b;
    Point2d from_b;
    double doubt = 0;  // of products of both: corners are off by 2^-53 of their size
};

Sides sides_at(const Point2d& a, const Point2d& b, const Point2d& c) {
    Sides out{{b[0] - a[0], b[1] - a[1]}, {c[0] - b[0], c[1] - b[1]}};
    double size = 0;
    for (const Point2d& p : {a, b, c}) size = std::max({size, std::fabs(p[0]), std::fabs(p[1])});
    out.doubt = 0x1p-48 * size *
                (std::fabs(out.to_b[0]) + std::fabs(out.to_b[1]) + std::fabs(out.from_b[0]) +
                 std::fabs(out.from_b[1]));
    return out;
}

}  // namespace

bool surely_turns(const Point2d& a, const Point2d& b, const Point2d& c) {
    const Sides s = sides_at(a, b, c);
    return std::fabs(s.to_b[0] * s.from_b[1] - s.to_b[1] * s.from_b[0]) > s.doubt;
}

int sure_direction(const Point2d& a, const Point2d& b, const Point2d& c) {
    const Sides s = sides_at(a, b, c);
    const double along = s.to_b[0] * s.from_b[0] + s.to_b[1] * s.from_b[1];
    if (std::fabs(along) <= s.doubt) return 0;
    return along > 0 ? 1 : -1;
}

int SectionNumbers::exact_side(const MeshSection& mesh, std::uint32_t v, double height) {
    return sgn(mpq_class(level(mesh.frame(), exact_point(mesh, v)) - mpq_class(height)));
}

SectionNumbers::Numbers SectionNumbers::exact(const Name& name) const {
    const auto [below, above] = name;
    const auto [u, v] = mesh_.frame().axes();
    const std::array<mpq_class, 3> a = exact_point(mesh_, below);
    if (below == above) return {a[u], a[v]};
    const std::array<mpq_class, 3> b = exact_point(mesh_, above);
    const mpq_class from = level(mesh_.frame(), a);
    const mpq_class part = (height_ - from) / (level(mesh_.frame(), b) - from);
    return {a[u] + part * (b[u] - a[u]), a[v] + part * (b[v] - a[v])};
}

bool SectionNumbers::is_exact(const Name& name, const Point2d& rounded) const {
    const auto [below, above] = name;
    if (below == above) return mesh_.is_double(below);
    if (const auto p = in_pairs(name))
        for (const DoublePair& c : p->at)
            if (std::fabs(c.low) > p->error) return false;
    const Numbers p = exact(name);
    return p[0] == rounded[0] && p[1] == rounded[1];
}

// Weights of both ends are between 0 and 1, and each step is off by less than 2^-99 of what it
// computes. Nothing where an end is no double, or near underflow.
std::optional<SectionNumbers::Pairs> SectionNumbers::in_pairs(const Name& name) const {
    const auto [below, above] = name;
    if (!mesh_.is_double(below) || !mesh_.is_double(above)) return std::nullopt;
    const auto axes = mesh_.frame().axes();
    const Point2d a{mesh_.near(below)[axes[0]], mesh_.near(below)[axes[1]]};
    const Point2d b{mesh_.near(above)[axes[0]], mesh_.near(above)[axes[1]]};
    if (below == above) return Pairs{{{{a[0], 0}, {a[1], 0}}}, 0};
    if (!mesh_.frame().is_axis()) return std::nullopt;
    const DoublePair of_a = two_sum(mesh_.level(above), -height_);
    const DoublePair of_b = two_sum(height_, -mesh_.level(below));
    const DoublePair both = two_sum(mesh_.level(above), -mesh_.level(below));
    if (both.high < 0x1p-100) return std::nullopt;
    Pairs out;
    for (std::size_t k = 0; k < 2; ++k) {
        const DoublePair sum = add(multiply({a[k], 0}, of_a), multiply({b[k], 0}, of_b));
        out.at[k] = divide(sum, both);
        out.error = std::max(out.error, 0x1p-94 * (std::fabs(a[k]) + std::fabs(b[k])));
    }
    out.error += 0x1p-900;
    return out;
}

Point2d SectionNumbers::rounded(const Name& name) const {
    const auto [below, above] = name;
    const auto [u, v] = mesh_.frame().axes();
    if (below == above) return {mesh_.near(below)[u] + 0.0, mesh_.near(below)[v] + 0.0};
    if (const auto p = in_pairs(name)) {
        const auto x = nearest(p->at[0], p->error);
        const auto y = nearest(p->at[1], p->error);
        if (x && y) return {*x, *y};
    }
    const Numbers p = exact(name);
    return {nearest(p[0]), nearest(p[1])};
}

// Differences are off by 2 e and 2^-100 of the size, products by 2^-99.
bool SectionNumbers::turns_by_pairs(const Name& a, const Name& b, const Name& c) const {
    const auto p = in_pairs(a);
    const auto q = in_pairs(b);
    const auto r = in_pairs(c);
    if (!p || !q || !r) return false;
    double size = 0;
    for (const Pairs& at : {*p, *q, *r})
        size = std::max({size, std::fabs(at.at[0].high), std::fabs(at.at[1].high)});
    std::array<DoublePair, 2> u;
    std::array<DoublePair, 2> v;
    double lengths = 0;
    for (std::size_t k = 0; k < 2; ++k) {
        u[k] = subtract(q->at[k], p->at[k]);
        v[k] = subtract(r->at[k], q->at[k]);
        lengths += std::fabs(u[k].high) + std::fabs(v[k].high);
    }
    const double e = p->error + q->error + r->error + 0x1p-98 * size;
    const DoublePair turn = subtract(multiply(u[0], v[1]), multiply(u[1], v[0]));
    return std::fabs(turn.high) > 16 * e * (lengths + 16 * e) + 0x1p-96 * lengths * lengths;
}

bool SectionNumbers::goes_straight(const Name& a, const Name& b, const Name& c) const {
    if (turns_by_pairs(a, b, c)) return false;
    const Numbers p = exact(a);
    const Numbers q = exact(b);
    const Numbers r = exact(c);
    const Numbers s{q[0] - p[0], q[1] - p[1]};
    const Numbers t{r[0] - q[0], r[1] - q[1]};
    return s[0] * t[1] == s[1] * t[0] && s[0] * t[0] + s[1] * t[1] > 0;
}

}  // namespace trisect::detail
