// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/sections/section_edges.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t no_side = ~std::uint32_t{0};

/// 1 where d is surely off the plane of the other three: doubles that were rounded once.
bool is_surely_off(const Point3d& a, const Point3d& b, const Point3d& c, const Point3d& d) {
    std::array<Point3d, 3> v;
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        v[0][k] = b[k] - a[k];
        v[1][k] = c[k] - a[k];
        v[2][k] = d[k] - a[k];
        size = std::max({size, std::fabs(a[k]), std::fabs(b[k]), std::fabs(c[k]), std::fabs(d[k])});
    }
    double det = 0;
    double terms = 0;
    const auto length = [](const Point3d& p) {
        return std::fabs(p[0]) + std::fabs(p[1]) + std::fabs(p[2]);
    };
    for (std::size_t k = 0; k < 3; ++k)
        det += v[0][k] *
               (v[1][(k + 1) % 3] * v[2][(k + 2) % 3] - v[1][(k + 2) % 3] * v[2][(k + 1) % 3]);
    // Corners and differences are off by 2^-52 of the size, products by less than 2^-49.
    const std::array<double, 3> of{length(v[0]), length(v[1]), length(v[2])};
    terms = 0x1p-49 * size * (of[0] * of[1] + of[1] * of[2] + of[2] * of[0]) +
            0x1p-48 * of[0] * of[1] * of[2] + 0x1p-900;
    return std::fabs(det) > terms;
}

}  // namespace

SectionEdges::SectionEdges(const MeshSection& mesh) : mesh_(mesh) {
    number_edges();
    bends_ = std::make_unique<std::atomic<Bend>[]>(ends_.size());
}

// Sides are put together by their smaller ends; those of one are in the order of the larger.
void SectionEdges::number_edges() {
    struct Side {
        std::uint32_t to = 0;
        std::uint32_t number = 0;
    };
    const std::size_t n = 3 * std::size_t{mesh_.triangle_count()};
    std::vector<std::uint32_t> begin(std::size_t{mesh_.point_count()} + 1, 0);
    const auto ends_of = [&](std::size_t side) {
        const auto& t = mesh_.triangle(static_cast<std::uint32_t>(side / 3));
        return std::minmax({t[side % 3], t[(side + 1) % 3]});
    };
    for (std::size_t s = 0; s < n; ++s) ++begin[ends_of(s).first + 1];
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    std::vector<Side> sides(n);
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t s = 0; s < n; ++s) {
        const auto [low, high] = ends_of(s);
        sides[next[low]++] = {high, static_cast<std::uint32_t>(s)};
    }
    edge_of_.resize(n);
    ends_.reserve(n / 2);
    sides_.reserve(n / 2);
    for (std::uint32_t v = 0; v + 1 < begin.size(); ++v) {
        const std::span of_v = std::span(sides).subspan(begin[v], begin[v + 1] - begin[v]);
        std::ranges::sort(of_v, [](const Side& s, const Side& t) {
            return s.to != t.to ? s.to < t.to : s.number < t.number;
        });
        for (std::size_t i = 0; i < of_v.size();) {
            const std::size_t first = i;
            for (; i < of_v.size() && of_v[i].to == of_v[first].to; ++i)
                edge_of_[of_v[i].number] = count();
            const std::uint32_t to = of_v[first].to;
            ends_.push_back(mesh_.level(v) <= mesh_.level(to) ? std::array{v, to}
                                                              : std::array{to, v});
            sides_.push_back({no_side, no_side});
            if (i - first != 2) continue;
            const std::uint32_t s = of_v[first].number;
            const std::uint32_t t = of_v[first + 1].number;
            if (mesh_.triangle(s / 3)[s % 3] != mesh_.triangle(t / 3)[t % 3])
                sides_.back() = {s, t};
        }
    }
}

SectionEdges::Bend SectionEdges::find_bend(std::uint32_t e) const {
    const Bend found = bend_of(e);
    bends_[e].store(found, std::memory_order_relaxed);
    return found;
}

SectionEdges::Bend SectionEdges::bend_of(std::uint32_t e) const {
    const auto [s, t] = sides_[e];
    if (s == no_side) return Bend::Open;
    const auto [from, to] = ends_[e];
    const std::uint32_t p = apex(s);
    const std::uint32_t q = apex(t);
    if (is_surely_off(mesh_.near(from), mesh_.near(to), mesh_.near(p), mesh_.near(q)))
        return Bend::Turns;
    if (mesh_.exact_mesh() == nullptr) return Bend::Open;
    const auto& points = mesh_.exact_mesh()->points;
    for (const std::uint32_t v : {from, to, p, q})
        if (!points[v].is_lattice()) return Bend::Open;
    const LatticePoint& a = points[from].lattice();
    const LatticePoint& b = points[to].lattice();
    const Plane plane = Plane::through(a, b, points[p].lattice());
    if (side_of(points[q].lattice(), plane) != Side::On) return Bend::Turns;
    // In one plane: seen along the axis that is most across it.
    const int k = plane.dominant_axis();
    const int u = (k + 1) % 3;
    const int v = (k + 2) % 3;
    const auto turn_to = [&](const LatticePoint& c) {
        return turn(flat_corner(a, u, v), flat_corner(b, u, v), flat_corner(c, u, v));
    };
    const int of_p = turn_to(points[p].lattice());
    const int of_q = turn_to(points[q].lattice());
    return of_p * of_q < 0 ? Bend::Straight : Bend::Open;
}

}  // namespace trisect::detail
