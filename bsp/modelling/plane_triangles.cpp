// SPDX-License-Identifier: Apache-2.0
//
// A union of triangles as a formula has an operand for each of them, and where each touches its
// neighbours no leaf is in general position. As one boundary, the sides that two triangles share
// are gone. Its winding number at a point is the number of triangles there, so what is inside by
// the positive rule is their union. Most parts that do not hang together overlap each other and not
// themselves: as operands of a formula they need not be resolved.
#include <trisect/bsp/modelling/plane_triangles.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include <trisect/kernel/error.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {
namespace {

/// Exact where corners span at most 126 bits, as on a lattice they do.
int turn_of(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    return are_collinear(a, b, c) ? 0 : Plane::through(a, b, c).normal(2).sign();
}

}  // namespace

std::uint32_t PlaneTriangles::number(const Point2d& p) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]))
        throw LimitError("a corner of a region of the plane leaves the range of doubles");
    const Point2d at{p[0] + 0.0, p[1] + 0.0};  // minus zero is zero
    const auto [it, is_new] = numbers_.emplace(at, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back({at[0], at[1], 0});
    return it->second;
}

void PlaneTriangles::add(const Point2d& a, const Point2d& b, const Point2d& c) {
    triangles_.push_back({number(a), number(b), number(c)});
}

void PlaneTriangles::add_fan(const Outline& outline) {
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        add(outline[0], outline[i], outline[i + 1]);
}

std::vector<PlaneTriangles::Corners> PlaneTriangles::turned_alike() const {
    LatticeReport report;
    const Lattice lattice = choose_lattice(points_, 1, Fractions::Kept);
    const std::vector<LatticePoint> at = to_lattice(points_, lattice, report, 1, Fractions::Kept);
    std::vector<Corners> out;
    for (const auto& [a, b, c] : triangles_) {
        const int turn = turn_of(at[a], at[b], at[c]);
        if (turn > 0) out.push_back({a, b, c});
        if (turn < 0) out.push_back({a, c, b});
    }
    return out;
}

/// Joined where two of them pass one side in opposite directions.
std::vector<std::vector<PlaneTriangles::Corners>> PlaneTriangles::connected_parts(
    const std::vector<Corners>& triangles) {
    std::vector<std::size_t> parent(triangles.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::map<Side, std::size_t> passed;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            passed.emplace(Side{triangles[i][k], triangles[i][(k + 1) % 3]}, i);
    for (const auto& [side, i] : passed) {
        const auto other = passed.find({side[1], side[0]});
        if (other != passed.end()) parent[root(i)] = root(other->second);
    }
    std::map<std::size_t, std::vector<Corners>> parts;
    for (std::size_t i = 0; i < triangles.size(); ++i) parts[root(i)].push_back(triangles[i]);
    std::vector<std::vector<Corners>> out;
    for (auto& [first, part] : parts) out.push_back(std::move(part));
    return out;
}

/// Sides that are passed more often in one direction than in the other, as often as that.
std::vector<PlaneTriangles::Side> PlaneTriangles::outline(const std::vector<Corners>& triangles) {
    std::map<Side, int> passed;
    for (const Corners& t : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = t[k];
            const std::uint32_t to = t[(k + 1) % 3];
            passed[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
        }
    std::vector<Side> out;
    for (const auto& [side, times] : passed)
        for (int i = 0; i < std::abs(times); ++i)
            out.push_back(times > 0 ? side : Side{side[1], side[0]});
    return out;
}

Expression PlaneTriangles::prisms() const {
    check_stop(triangles_.size());
    std::vector<Solid> out;
    for (const auto& part : connected_parts(turned_alike())) out.push_back(prism(part));
    if (out.empty()) return Solid();
    return out.size() == 1 ? Expression(out[0]) : Expression::any_of(out);
}

Solid PlaneTriangles::prism(const std::vector<Corners>& triangles) const {
    std::map<std::uint32_t, std::uint32_t> used;
    for (const Corners& t : triangles)
        for (const std::uint32_t corner : t) used.emplace(corner, 0);
    PolygonMesh mesh;
    for (auto& [corner, number] : used) {
        number = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(points_[corner]);
    }
    const auto n = static_cast<std::uint32_t>(used.size());
    for (std::uint32_t i = 0; i < n; ++i)
        mesh.points.push_back({mesh.points[i][0], mesh.points[i][1], 1});
    for (const Corners& t : triangles) {
        const std::uint32_t a = used[t[0]];
        const std::uint32_t b = used[t[1]];
        const std::uint32_t c = used[t[2]];
        mesh.add_triangle(a, c, b);
        mesh.add_triangle(n + a, n + b, n + c);
    }
    for (const Side& side : outline(triangles)) {
        const std::uint32_t a = used[side[0]];
        const std::uint32_t b = used[side[1]];
        mesh.add_face(std::array{a, b, n + b, n + a});
    }
    return Solid::from_mesh(mesh, {.embedding = Embedding::Check});
}

}  // namespace trisect::detail
