// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/convex_pieces.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/pieces/convex_cover.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {
namespace {

/// How far a corner moves when it is rounded, on each axis, at most.
double rounding_step(const PolygonMesh& mesh) {
    double extent = 0;
    for (const Point3d& p : mesh.points)
        for (const double c : p) extent = std::max(extent, std::fabs(c));
    return std::ldexp(extent, -53);
}

/// How far a point is above the plane of a triangle, in doubles.
double height_above(const PolygonMesh& mesh, std::size_t f, const Point3d& p) {
    const Point3d& a = mesh.points[mesh.face(f)[0]];
    const Point3d& b = mesh.points[mesh.face(f)[1]];
    const Point3d& c = mesh.points[mesh.face(f)[2]];
    const Point3d u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Point3d v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const Point3d n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
    const double size = std::hypot(n[0], n[1], n[2]);
    if (size == 0) return std::numeric_limits<double>::infinity();
    return (n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1]) + n[2] * (p[2] - a[2])) / size;
}

/// Whether no edge bends inward by more than `depth`. Of two triangles the one counts above which
/// the other is lower: planes of needles say nothing far from them.
bool bends_outward(const PolygonMesh& mesh, double depth) {
    const auto each_edge = [&](const auto& work) {
        for (std::size_t f = 0; f < mesh.face_count(); ++f)
            for (std::size_t k = 0; k < 3; ++k)
                work(f, mesh.face(f)[k], mesh.face(f)[(k + 1) % 3], mesh.face(f)[(k + 2) % 3]);
    };
    // The face on the left of an edge, and its third corner.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::uint32_t>> left;
    each_edge([&](std::size_t f, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        left[{a, b}] = {f, c};
    });
    bool out = true;
    each_edge([&](std::size_t f, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto right = left.find({b, a});
        out = out && right != left.end() &&
              std::min(height_above(mesh, f, mesh.points[right->second.second]),
                       height_above(mesh, right->second.first, mesh.points[c])) <= depth;
    });
    return out;
}

/// Whether edges and volume miss those of the hull by no more than rounding moves corners.
bool is_convex_within_rounding(const Solid& solid, const PolygonMesh& mesh, const Solid& hull) {
    const double step = rounding_step(mesh);
    return volume(hull) - volume(solid) <= 4 * area(hull).value * step &&
           bends_outward(mesh, 8 * step);
}

/// The corners of the hull, if the solid is convex.
std::optional<std::vector<Point3d>> convex_corners(const Solid& solid, const PolygonMesh& mesh,
                                                   const MinkowskiOptions& options) {
    const PolygonMesh around = make_hull(mesh.points);
    const Solid hull = Solid::from_mesh(around);
    // Of two sets, one within the other, equal volumes make one set.
    const bool is_convex = exact_volume(hull) == exact_volume(solid) ||
                           (options.convex == MinkowskiOptions::Convex::WithinRounding &&
                            is_convex_within_rounding(solid, mesh, hull));
    if (!is_convex) return std::nullopt;
    return around.points;
}

/// One corner of each part that is connected by triangles.
std::vector<Point3d> representatives_of(const PolygonMesh& mesh) {
    std::vector<std::uint32_t> parent(mesh.points.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (const std::uint32_t v : mesh.face(f)) parent[root(v)] = root(mesh.face(f)[0]);
    std::set<std::uint32_t> roots;
    for (const std::uint32_t v : mesh.corners) roots.insert(root(v));
    std::vector<Point3d> out;
    for (const std::uint32_t v : roots) out.push_back(mesh.points[v]);
    return out;
}

ConvexPieces whole(std::vector<Point3d> corners) {
    ConvexPieces out;
    out.is_convex = out.fills = true;
    out.representatives = {corners.front()};
    out.pieces.push_back(std::move(corners));
    return out;
}

void add_triangles(ConvexPieces& out, const PolygonMesh& mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        auto& piece = out.pieces.emplace_back();
        for (const std::uint32_t v : mesh.face(f)) piece.push_back(mesh.points[v]);
    }
}

Point3d point_of(const LatticeMesh& mesh, std::uint32_t v) {
    const auto [x, y, z] = mesh.points[v].doubles();
    return {mesh.lattice.to_double(x), mesh.lattice.to_double(y), mesh.lattice.to_double(z)};
}

ConvexPieces parts_of(const PolygonMesh& mesh, CoverSide side) {
    ConvexPieces out;
    out.representatives = representatives_of(mesh);
    const ImportedMesh imported = import_mesh(mesh);
    if (!imported.report.lattice.lossless || !is_embedded(imported.mesh)) {
        add_triangles(out, mesh);
        return out;
    }
    const ConvexCover cover = convex_cover(imported.mesh, side);
    for (const auto& body : cover.bodies) {
        auto& piece = out.pieces.emplace_back();
        for (const std::uint32_t v : body) piece.push_back(point_of(imported.mesh, v));
    }
    out.fills = cover.fills;
    return out;
}

}  // namespace

// A mesh that meets itself is resolved by evaluation: its own faces have walls inside the set.
ConvexPieces pieces_around(const Solid& solid) {
    return parts_of(evaluate(solid).to_mesh(), CoverSide::Outside);
}

ConvexPieces pieces_of_solid(const Solid& solid, const MinkowskiOptions& options) {
    const PolygonMesh mesh = solid.to_mesh();
    if (auto corners = convex_corners(solid, mesh, options)) return whole(std::move(*corners));
    return parts_of(mesh, CoverSide::Inside);
}

}  // namespace trisect::detail
