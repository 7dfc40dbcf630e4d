// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/flat/flat_mesh.h>

#include <algorithm>
#include <numeric>

#include <trisect/brep/face/loops_below.h>
#include <trisect/brep/triangulate.h>
#include <trisect/bsp/flat/flat_figure.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

std::vector<IndexLoop> flat_loops(const FlatRegion& region) {
    std::vector<IndexLoop> loops(region.loop_count());
    for (std::size_t l = 0; l < loops.size(); ++l)
        for (std::uint32_t s = region.loop_begin[l]; s < region.loop_begin[l + 1]; ++s)
            loops[l].push_back(region.segments[s].from);
    return loops;
}

namespace {

std::vector<Point> flat_points(const FlatRegion& region) {
    std::vector<Point> points;
    points.reserve(region.vertices.size());
    for (const FlatRegion::Vertex& v : region.vertices) points.push_back(flat_point(region, v));
    return points;
}

}  // namespace

// Loops of a resolved region are linked as PlanarLoops links them, which numbers corners loop by
// loop.
std::vector<std::vector<std::uint32_t>> flat_regions(const FlatRegion& region) {
    if (region.is_empty()) return {};
    if (region.loop_count() == 1) return {{0}};
    const auto loop_of = [&](std::uint32_t corner) {
        const auto after = std::ranges::upper_bound(region.loop_begin, corner);
        return static_cast<std::uint32_t>(after - region.loop_begin.begin() - 1);
    };
    const std::vector<Point> points = flat_points(region);
    const std::vector<IndexLoop> loops = flat_loops(region);
    const PlanarLoops figure(Plane::axis_aligned(2, 1, 0), points, loops);
    std::vector<std::uint32_t> first(figure.outlines().begin(), figure.outlines().end());
    std::vector<std::vector<std::uint32_t>> out;
    for (const std::uint32_t corner : first) out.push_back({loop_of(corner)});
    if (figure.holes().empty()) return out;
    first.insert(first.end(), figure.holes().begin(), figure.holes().end());
    const std::vector<std::uint32_t> below = loops_below(figure, first);
    std::vector<std::uint32_t> region_of(first.size());
    std::iota(region_of.begin(), region_of.end(), 0U);
    for (std::size_t i = out.size(); i < first.size(); ++i) {
        // Holes are ordered by their first places, so that of the loop below is known.
        TRISECT_EXPECTS(below[i] < i, "a hole inside an outline");
        region_of[i] = region_of[below[i]];
        out[region_of[i]].push_back(loop_of(first[i]));
    }
    return out;
}

std::vector<std::array<std::uint32_t, 3>> flat_triangles(const FlatRegion& region) {
    if (region.is_empty()) return {};
    return triangulate(Plane::axis_aligned(2, 1, 0), flat_points(region), flat_loops(region));
}

std::vector<std::array<double, 2>> flat_coordinates(const FlatRegion& region) {
    const Plane figure = Plane::axis_aligned(2, 1, 0);
    std::vector<std::array<double, 2>> out;
    out.reserve(region.vertices.size());
    for (const FlatRegion::Vertex& v : region.vertices) {
        std::array<double, 3> at{v.u, v.v, 0};
        if (!v.is_corner())
            at = nearest_doubles({at, v.error}, flat_plane(region.lines[v.lines[0]]),
                                 flat_plane(region.lines[v.lines[1]]), figure);
        out.push_back({region.lattice.to_double(at[0]), region.lattice.to_double(at[1])});
    }
    return out;
}

PolygonMesh flat_mesh(const FlatPrism& prism) {
    const FlatRegion& region = prism.operand->resolved();
    const auto axis = static_cast<std::size_t>(prism.axis);
    PolygonMesh mesh;
    const auto n = static_cast<std::uint32_t>(region.vertices.size());
    mesh.points.reserve(2 * region.vertices.size());
    const auto coordinates = flat_coordinates(region);
    for (const Coordinate level : {prism.low, prism.high})
        for (const auto& [u, v] : coordinates) {
            Point3d p{};
            p[(axis + 1) % 3] = u;
            p[(axis + 2) % 3] = v;
            p[axis] = region.lattice.to_double(level.to_double());
            mesh.points.push_back(p);
        }
    const auto triangles = flat_triangles(region);
    mesh.corners.reserve(6 * (triangles.size() + region.segments.size()));
    mesh.face_begin.reserve(2 * (triangles.size() + region.segments.size()) + 1);
    for (const auto& [a, b, c] : triangles) {
        mesh.add_triangle(a, c, b);
        mesh.add_triangle(n + a, n + b, n + c);
    }
    for (const FlatRegion::Segment& s : region.segments) {
        mesh.add_triangle(s.from, s.to, n + s.to);
        mesh.add_triangle(s.from, n + s.to, n + s.from);
    }
    return mesh;
}

}  // namespace trisect::detail
