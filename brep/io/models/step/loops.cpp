// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/step/loops.h>

#include <trisect/brep/joined_loops.h>
#include <trisect/brep/triangulate.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trisect::detail {
namespace {

/// The corners of a face in the plane z = 0, equal ones once.
struct FlatFace {
    std::vector<Point> points;
    std::vector<std::uint32_t> original;  ///< by point: the caller's index
    std::vector<IndexLoop> loops;
};

/// The axes that the face is seen along, counter-clockwise from above.
std::array<std::size_t, 2> seen_axes(const Point3d& area) {
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::fabs(area[i]) > std::fabs(area[k])) k = i;
    std::array<std::size_t, 2> axes{(k + 1) % 3, (k + 2) % 3};
    if (area[k] < 0) std::swap(axes[0], axes[1]);
    return axes;
}

std::vector<Point> lattice_points_of(const std::vector<Point3d>& flat) {
    LatticeReport report;
    const Lattice lattice = choose_lattice(flat, 1, Fractions::Kept);
    const std::vector<LatticePoint> made = to_lattice(flat, lattice, report, 1, Fractions::Kept);
    if (!report.lossless)
        throw LimitError("the coordinates of a face with holes span too many bits");
    return {made.begin(), made.end()};
}

std::optional<FlatFace> flat_face(std::span<const Point3d> points,
                                  const std::vector<IndexLoop>& loops) {
    Point3d area{};
    for (const IndexLoop& loop : loops) {
        const Point3d a = area_vector(points, loop);
        for (std::size_t k = 0; k < 3; ++k) area[k] += a[k];
    }
    if (area == Point3d{}) return std::nullopt;
    const auto axes = seen_axes(area);
    FlatFace out;
    std::vector<std::uint32_t>& order = out.original;
    for (const IndexLoop& loop : loops) order.insert(order.end(), loop.begin(), loop.end());
    const auto value = [&](std::uint32_t i) {
        return std::array{points[i][axes[0]] + 0.0, points[i][axes[1]] + 0.0};
    };
    const auto less = [&](std::uint32_t a, std::uint32_t b) { return value(a) < value(b); };
    const auto same = [&](std::uint32_t a, std::uint32_t b) { return value(a) == value(b); };
    std::stable_sort(order.begin(), order.end(), less);
    order.erase(std::unique(order.begin(), order.end(), same), order.end());
    std::vector<Point3d> flat;
    for (const std::uint32_t i : order) flat.push_back({value(i)[0], value(i)[1], 0});
    out.points = lattice_points_of(flat);
    for (const IndexLoop& loop : loops) {
        IndexLoop made;
        for (const std::uint32_t i : loop) {
            const auto at = std::lower_bound(order.begin(), order.end(), i, less);
            const auto number = static_cast<std::uint32_t>(at - order.begin());
            if (made.empty() || made.back() != number) made.push_back(number);
        }
        while (made.size() > 1 && made.front() == made.back()) made.pop_back();
        if (made.size() < 2) return std::nullopt;
        out.loops.push_back(std::move(made));
    }
    // The loop with the least corner of all is an outline.
    const auto first = [](const IndexLoop& l) { return *std::min_element(l.begin(), l.end()); };
    std::stable_sort(out.loops.begin(), out.loops.end(),
                     [&](const IndexLoop& a, const IndexLoop& b) { return first(a) < first(b); });
    if (out.loops.front().size() < 3) return std::nullopt;
    return out;
}

/// Whether the triangles' sides are those of the loops, and others that cancel.
bool has_border(const std::vector<IndexTriangle>& triangles, const std::vector<IndexLoop>& loops) {
    const auto key = [](std::uint32_t a, std::uint32_t b) { return (std::uint64_t{a} << 32) | b; };
    std::vector<std::uint64_t> left;
    std::vector<std::uint64_t> right;
    for (const IndexTriangle& t : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            left.push_back(key(t[i], t[(i + 1) % 3]));
            right.push_back(key(t[(i + 1) % 3], t[i]));
        }
    }
    for (const IndexLoop& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            left.push_back(key(loop[(i + 1) % loop.size()], loop[i]));
            right.push_back(key(loop[i], loop[(i + 1) % loop.size()]));
        }
    }
    std::sort(left.begin(), left.end());
    std::sort(right.begin(), right.end());
    return left == right;
}

}  // namespace

Point3d area_vector(std::span<const Point3d> points, const IndexLoop& loop) {
    Point3d sum{};
    const Point3d& o = points[loop[0]];
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const Point3d& a = points[loop[i]];
        const Point3d& b = points[loop[i + 1]];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t u = (k + 1) % 3;
            const std::size_t v = (k + 2) % 3;
            sum[k] += (a[u] - o[u]) * (b[v] - o[v]) - (a[v] - o[v]) * (b[u] - o[u]);
        }
    }
    return sum;
}

std::optional<std::vector<IndexLoop>> polygons_of_loops(std::span<const Point3d> points,
                                                        const std::vector<IndexLoop>& loops) {
    const std::optional<FlatFace> face = flat_face(points, loops);
    if (!face) return std::nullopt;
    const Plane plane =
        Plane::through(LatticePoint{0, 0, 0}, LatticePoint{1, 0, 0}, LatticePoint{0, 1, 0});
    std::vector<IndexTriangle> triangles;
    try {
        triangles = triangulate(plane, face->points, face->loops);
    } catch (const Error& e) {
        // The preconditions of the triangulation are what is asked here.
        if (e.code() != ErrorCode::Internal) throw;
        return std::nullopt;
    }
    if (!has_border(triangles, face->loops)) return std::nullopt;
    std::vector<IndexLoop> out;
    if (auto joined = joined_loops(face->loops, triangles)) {
        out.push_back(*std::move(joined));
    } else {
        for (const IndexTriangle& t : triangles) out.emplace_back(t.begin(), t.end());
    }
    for (IndexLoop& polygon : out)
        for (std::uint32_t& c : polygon) c = face->original[c];
    return out;
}

}  // namespace trisect::detail
