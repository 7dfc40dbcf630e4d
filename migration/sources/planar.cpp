// SPDX-License-Identifier: Apache-2.0

#include "planar.h"

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/triangulate.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/lattice.h>

namespace manifold {

std::optional<std::vector<Triple>> triangulated(const Polygons& polygons) {
    std::vector<trisect::Point3d> corners;
    std::vector<trisect::IndexLoop> loops;
    for (const SimplePolygon& polygon : polygons) {
        if (polygon.size() < 3) return std::nullopt;
        trisect::IndexLoop& loop = loops.emplace_back();
        for (const vec2& p : polygon) {
            loop.push_back(static_cast<std::uint32_t>(corners.size()));
            corners.push_back({p.x, p.y, 0});
        }
    }
    try {
        const trisect::Lattice lattice =
            trisect::choose_lattice(corners, 1, trisect::Fractions::Kept);
        trisect::LatticeReport report;
        std::vector<trisect::Point> points;
        for (const trisect::LatticePoint& p :
             trisect::to_lattice(corners, lattice, report, 1, trisect::Fractions::Kept))
            points.emplace_back(p);
        const trisect::Plane ground = trisect::Plane::axis_aligned(2, 1, 0);
        return trisect::triangulate(ground, points, loops);
    } catch (const trisect::Error&) {
        return std::nullopt;
    }
}

trisect::Solid prism_over(const Polygons& polygons) {
    trisect::PolygonMesh mesh;
    for (const SimplePolygon& polygon : polygons) {
        const auto n = static_cast<std::uint32_t>(polygon.size());
        const auto base = static_cast<std::uint32_t>(mesh.points.size());
        if (n < 3) continue;
        for (const vec2& p : polygon) mesh.points.push_back({p.x, p.y, 0});
        for (const vec2& p : polygon) mesh.points.push_back({p.x, p.y, 1});
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = base + i;
            const std::uint32_t b = base + (i + 1) % n;
            mesh.add_triangle(a, b, b + n);
            mesh.add_triangle(a, b + n, a + n);
            // Fans, some of whose triangles lie the other way: they wind about each point as often
            // as the polygon does.
            if (i == 0 || i + 1 == n) continue;
            mesh.add_triangle(base, b, a);
            mesh.add_triangle(base + n, a + n, b + n);
        }
    }
    trisect::ImportedMesh imported = trisect::import_mesh(mesh);
    if (imported.mesh.triangles.empty() || imported.report.inside_out) return {};
    return trisect::Solid::from_import(std::move(imported), trisect::Embedding::Check);
}

Polygons section_of(const trisect::Solid& solid, double height) {
    Polygons polygons;
    if (solid.is_empty()) return polygons;
    const auto add = [&](const trisect::SectionLoop& loop) {
        SimplePolygon& polygon = polygons.emplace_back();
        for (const trisect::Point3d& p : loop.rounded) polygon.push_back({p[0], p[1]});
    };
    for (const trisect::SectionRegion& region :
         trisect::BrepIndex(solid).section({0, 0, 1, -height})) {
        add(region.outer);
        for (const trisect::SectionLoop& hole : region.holes) add(hole);
    }
    return polygons;
}

}  // namespace manifold
