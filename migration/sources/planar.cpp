// SPDX-License-Identifier: Apache-2.0

#include "planar.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/triangulate.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
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

namespace {

// Where the winding number is positive, even if most of it is negative.
trisect::Solid set_of(const trisect::PolygonMesh& mesh) {
    if (mesh.face_count() == 0) return {};
    const trisect::SolidOptions options{.embedding = trisect::Embedding::Check,
                                        .inside_out = trisect::InsideOut::Accept};
    return trisect::evaluate(trisect::Solid::from_mesh(mesh, options));
}

// Whatever triangles have the polygons for their boundary wind about each point as often.
std::optional<trisect::Solid> triangulated_prism(const Polygons& polygons) {
    const std::optional<std::vector<Triple>> caps = triangulated(polygons);
    if (!caps) return std::nullopt;
    trisect::PolygonMesh mesh;
    for (const SimplePolygon& polygon : polygons)
        for (const vec2& p : polygon) mesh.points.push_back({p.x, p.y, 0});
    const auto up = static_cast<std::uint32_t>(mesh.points.size());
    for (std::uint32_t i = 0; i < up; ++i)
        mesh.points.push_back({mesh.points[i][0], mesh.points[i][1], 1});
    for (const auto& [a, b, c] : *caps) {
        mesh.add_triangle(a, c, b);
        mesh.add_triangle(a + up, b + up, c + up);
    }
    std::uint32_t begin = 0;
    for (const SimplePolygon& polygon : polygons) {
        const auto n = static_cast<std::uint32_t>(polygon.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = begin + i;
            const std::uint32_t b = begin + (i + 1) % n;
            mesh.add_triangle(a, b, b + up);
            mesh.add_triangle(a, b + up, a + up);
        }
        begin += n;
    }
    try {
        return set_of(mesh);
    } catch (const trisect::InvalidSolid&) {  // the triangles bound something else
        return std::nullopt;
    }
}

}  // namespace

trisect::Solid prism_over(const Polygons& polygons) {
    if (std::optional<trisect::Solid> prism = triangulated_prism(polygons)) return *prism;
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
    return set_of(mesh);
}

// A point is in an odd number of the triangles of a fan where the polygon winds an odd number of
// times about it.
trisect::Solid prism_by_parity(const Polygons& polygons) {
    std::vector<trisect::Expression> triangles;
    for (const SimplePolygon& polygon : polygons)
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            SimplePolygon triangle{polygon[0], polygon[i - 1], polygon[i]};
            if (la::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) < 0)
                std::swap(triangle[1], triangle[2]);
            triangles.emplace_back(prism_over({triangle}));
        }
    if (triangles.empty()) return {};
    // Pairs of pairs, so that few are about at once.
    while (triangles.size() > 1) {
        std::vector<trisect::Expression> pairs;
        for (std::size_t i = 1; i < triangles.size(); i += 2)
            pairs.push_back(triangles[i - 1] ^ triangles[i]);
        if (triangles.size() % 2 == 1) pairs.push_back(triangles.back());
        triangles = std::move(pairs);
    }
    return trisect::evaluate(triangles.front());
}

std::vector<Polygons> regions_of(const trisect::Solid& solid, double height) {
    std::vector<Polygons> regions;
    if (solid.is_empty()) return regions;
    for (const trisect::SectionRegion& region :
         trisect::BrepIndex(solid).section({0, 0, 1, -height})) {
        Polygons& polygons = regions.emplace_back();
        const auto add = [&polygons](const trisect::SectionLoop& loop) {
            SimplePolygon& polygon = polygons.emplace_back();
            for (const trisect::Point3d& p : loop.rounded) polygon.push_back({p[0], p[1]});
        };
        add(region.outer);
        for (const trisect::SectionLoop& hole : region.holes) add(hole);
    }
    return regions;
}

Polygons section_of(const trisect::Solid& solid, double height) {
    Polygons polygons;
    for (Polygons& region : regions_of(solid, height))
        std::ranges::move(region, std::back_inserter(polygons));
    return polygons;
}

}  // namespace manifold
