// SPDX-License-Identifier: Apache-2.0
//
// All of this is in doubles: where to divide is a guess, and what comes out of it is certified.
// Only that edges are divided in all triangles at them is not: they are found by the values of
// their ends.

#include <trisect/bsp/verify/contact_insertion.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

Point3d along(const Point3d& a, const Point3d& d, double t) {
    return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]};
}

// Of a point and the open segment that it is beside.
std::optional<double> distance_beside(const Point3d& p, const Point3d& a, const Point3d& b) {
    const Point3d d = minus(b, a);
    const double t = dot(minus(p, a), d) / dot(d, d);
    if (!(t > 0 && t < 1)) return std::nullopt;
    return length(minus(p, along(a, d, t)));
}

// Of a point and the open triangle that it is above or below.
std::optional<double> distance_above(const Point3d& p, const std::array<Point3d, 3>& t) {
    const Point3d n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    if (!(dot(n, n) > 0)) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i)
        if (!(dot(cross(n, minus(t[(i + 1) % 3], t[i])), minus(p, t[i])) > 0)) return std::nullopt;
    return std::abs(dot(n, minus(p, t[0]))) / length(n);
}

bool has(const std::array<Point3d, 3>& t, const Point3d& p) {
    return std::ranges::find(t, p) != t.end();
}

}  // namespace

ContactInsertion::Triangle ContactInsertion::triangle(std::uint32_t f) const {
    const auto corners = mesh_.face(f);
    return {mesh_.points[corners[0]], mesh_.points[corners[1]], mesh_.points[corners[2]]};
}

void ContactInsertion::divide(const Point3d& a, const Point3d& b, const Point3d& at,
                              double distance) {
    // Next to an end it is that corner's business: both are snapped.
    if (length(minus(at, a)) <= reach_ || length(minus(at, b)) <= reach_) return;
    edges_.try_emplace(std::minmax(a, b), at);
    largest_move_ = std::max(largest_move_, distance);
}

bool ContactInsertion::add_corners(const Triangle& of, std::uint32_t g) {
    const Triangle t = triangle(g);
    bool any = false;
    for (const Point3d& p : of) {
        if (has(t, p)) continue;
        bool is_beside = false;
        for (std::size_t i = 0; i < 3 && !is_beside; ++i) {
            const auto d = distance_beside(p, t[i], t[(i + 1) % 3]);
            is_beside = d && *d <= reach_;
            if (is_beside) divide(t[i], t[(i + 1) % 3], p, *d);
        }
        any = any || is_beside;
        if (is_beside) continue;
        const auto d = distance_above(p, t);
        if (!d || *d > reach_) continue;
        faces_.try_emplace(g, p);
        largest_move_ = std::max(largest_move_, *d);
        any = true;
    }
    return any;
}

void ContactInsertion::add_crossings(const Triangle& f, const Triangle& g) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const Point3d& a = f[i];
            const Point3d& b = f[(i + 1) % 3];
            const Point3d& c = g[j];
            const Point3d& d = g[(j + 1) % 3];
            if (a == c || a == d || b == c || b == d) continue;
            const Point3d u = minus(b, a);
            const Point3d v = minus(d, c);
            const Point3d w = minus(c, a);
            const Point3d n = cross(u, v);
            const double nn = dot(n, n);
            if (!(nn > 0)) continue;
            const double s = dot(cross(w, v), n) / nn;
            const double t = dot(cross(w, u), n) / nn;
            if (!(s > 0 && s < 1 && t > 0 && t < 1)) continue;
            if (!(std::abs(dot(w, n)) <= reach_ * std::sqrt(nn))) continue;
            const Point3d on_f = along(a, u, s);
            const Point3d on_g = along(c, v, t);
            const Point3d x = rounding_(along(on_f, minus(on_g, on_f), 0.5));
            // Between edges that are nearly parallel it may be anywhere.
            const double from_f = length(minus(x, on_f));
            const double from_g = length(minus(x, on_g));
            if (!(std::max(from_f, from_g) <= reach_)) continue;
            divide(a, b, x, from_f);
            divide(c, d, x, from_g);
        }
}

void ContactInsertion::add(std::uint32_t f, std::uint32_t g) {
    const bool any = add_corners(triangle(f), g);
    if (add_corners(triangle(g), f) || any) return;
    add_crossings(triangle(f), triangle(g));
}

// Inserted points that the mesh has, with the first of their numbers.
std::map<Point3d, std::uint32_t> ContactInsertion::known_points() const {
    std::set<Point3d> inserted;
    for (const auto& [edge, at] : edges_) inserted.insert(at);
    for (const auto& [face, at] : faces_) inserted.insert(at);
    std::map<Point3d, std::uint32_t> known;
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v)
        if (inserted.contains(mesh_.points[v])) known.try_emplace(mesh_.points[v], v);
    return known;
}

PolygonMesh ContactInsertion::divided(std::vector<std::uint32_t>* parents) const {
    PolygonMesh out;
    out.points = mesh_.points;
    std::map<Point3d, std::uint32_t> added = known_points();
    const auto index_of = [&](const Point3d& p) {
        const auto [at, is_new] =
            added.try_emplace(p, static_cast<std::uint32_t>(out.points.size()));
        if (is_new) out.points.push_back(p);
        return at->second;
    };
    const auto point_on = [&](std::uint32_t a, std::uint32_t b) -> const Point3d* {
        const auto at = edges_.find(std::minmax(mesh_.points[a], mesh_.points[b]));
        return at == edges_.end() ? nullptr : &at->second;
    };
    // Divides a triangle at one of its sides, and the parts at what is left of the others.
    using Sides = std::array<const Point3d*, 3>;
    const auto emit = [&](const auto& self, const std::array<std::uint32_t, 3>& t,
                          const Sides& sides) -> void {
        for (std::size_t i = 0; i < 3; ++i) {
            if (sides[i] == nullptr) continue;
            const std::size_t j = (i + 1) % 3;
            const std::size_t k = (i + 2) % 3;
            const std::uint32_t at = index_of(*sides[i]);
            self(self, {t[i], at, t[k]}, {nullptr, nullptr, sides[k]});
            self(self, {at, t[j], t[k]}, {nullptr, sides[j], nullptr});
            return;
        }
        out.add_triangle(t[0], t[1], t[2]);
    };
    const auto note_parent = [&](std::uint32_t f) {
        if (parents != nullptr) parents->resize(out.face_count(), f);
    };
    for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
        if (f > 0) note_parent(f - 1);
        const auto corners = mesh_.face(f);
        const std::array<std::uint32_t, 3> t{corners[0], corners[1], corners[2]};
        const auto inside = faces_.find(f);
        const Sides sides{point_on(t[0], t[1]), point_on(t[1], t[2]), point_on(t[2], t[0])};
        if (inside == faces_.end() || sides != Sides{}) {
            emit(emit, t, sides);
            continue;
        }
        const std::uint32_t x = index_of(inside->second);
        for (std::size_t i = 0; i < 3; ++i) out.add_triangle(t[i], t[(i + 1) % 3], x);
    }
    if (mesh_.face_count() > 0) note_parent(static_cast<std::uint32_t>(mesh_.face_count() - 1));
    return out;
}

}  // namespace trisect::detail
