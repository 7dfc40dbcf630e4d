// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/plane_region.h>

#include <algorithm>
#include <array>
#include <utility>

#include <trisect/brep/brep_mesh.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

namespace trisect {
namespace {

bool lies_at(const Brep& brep, const PolygonMesh& mesh, FaceId f, double height) {
    for (const HalfedgeId h : brep.halfedges(f))
        if (mesh.points[brep.origin(h).index][2] != height) return false;
    return true;
}

/// Twice the area seen from above, over all loops of a face: its sign is where the face looks to.
double twice_area(const Brep& brep, const PolygonMesh& mesh, FaceId f) {
    double out = 0;
    for (const LoopId l : brep.loops(f)) {
        std::vector<Point3d> loop;
        for (const HalfedgeId h : brep.halfedges(l))
            loop.push_back(mesh.points[brep.origin(h).index]);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Point3d& p = loop[i];
            const Point3d& q = loop[(i + 1) % loop.size()];
            out += (p[0] - loop[0][0]) * (q[1] - loop[0][1]) -
                   (p[1] - loop[0][1]) * (q[0] - loop[0][0]);
        }
    }
    return out;
}

void add_face(PlaneRegion& out, const Brep& brep, FaceId f, bool turn_over) {
    for (const LoopId l : brep.loops(f)) {
        auto& loop = out.loops.emplace_back();
        for (const HalfedgeId h : brep.halfedges(l)) loop.push_back(brep.origin(h).index);
        if (turn_over) std::reverse(loop.begin(), loop.end());
    }
    for (const auto& [a, b, c] : triangulate(brep, f))
        out.triangles.push_back(turn_over ? IndexTriangle{a, c, b} : IndexTriangle{a, b, c});
}

}  // namespace

PlaneRegion region_of_faces(const Solid& solid, double height, FacesLook look) {
    if (auto flat = flat_outlines(solid)) {
        if (height != (look == FacesLook::Up ? flat->high : flat->low)) return {};
        return {std::move(flat->points), std::move(flat->loops), flat_triangles(solid)};
    }
    // A mesh that meets itself is resolved by that: its own faces have walls inside the set.
    return region_of_result_faces(evaluate(solid), height, look);
}

PlaneRegion region_of_result_faces(const Solid& solid, double height, FacesLook look) {
    PlaneRegion out;
    const Brep brep = solid.to_brep();
    const PolygonMesh mesh = to_polygon_mesh(brep);
    for (const Point3d& p : mesh.points) out.points.push_back({p[0], p[1]});
    for (const FaceId f : brep.faces())
        if (lies_at(brep, mesh, f, height) &&
            (twice_area(brep, mesh, f) > 0) == (look == FacesLook::Up))
            add_face(out, brep, f, look == FacesLook::Down);
    return out;
}

PolygonMesh prism_of_region(const PlaneRegion& region, double low, double high) {
    PolygonMesh mesh;
    const auto n = static_cast<std::uint32_t>(region.points.size());
    for (const double z : {low, high})
        for (const Point2d& p : region.points) mesh.points.push_back({p[0], p[1], z});
    for (const auto& loop : region.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t a = loop[i];
            const std::uint32_t b = loop[(i + 1) % loop.size()];
            mesh.add_face(std::array{a, b, n + b, n + a});
        }
    for (const auto& [a, b, c] : region.triangles) {
        mesh.add_triangle(a, c, b);
        mesh.add_triangle(n + a, n + b, n + c);
    }
    return mesh;
}

Solid solid_of_region(const PlaneRegion& region, double low, double high) {
    std::vector<Outline> outlines;
    for (const auto& loop : region.loops) {
        Outline& outline = outlines.emplace_back();
        for (const std::uint32_t v : loop) outline.push_back(region.points[v]);
    }
    return flat_prism(outlines, OutlineRule::Positive, low, high);
}

PlaneRegion region_of_outlines(std::span<const FlatOutline> outlines, OutlineRule rule) {
    return region_of_faces(flat_prism(outlines, rule, 0, 1), 1);
}

PlaneRegion region_of_outline(const FlatOutline& outline) {
    return region_of_outlines({&outline, 1});
}

PlaneRegion region_of_prism(const Solid& prism) {
    if (const auto flat = flat_outlines(prism)) return region_of_faces(prism, flat->high);
    const auto box = bounds(prism);
    if (!box) return {};
    PlaneRegion out = region_of_faces(prism, box->hi[2]);
    if (!evaluate(prism ^ solid_of_region(out, box->lo[2], box->hi[2])).is_empty())
        throw UsageError("the solid is no prism along the z axis, or its corners are no doubles");
    return out;
}

std::vector<Outline> outlines_of_prism(const Solid& prism) {
    std::vector<Outline> out;
    if (const auto flat = flat_outlines(prism)) {
        out = flat->outlines();
    } else {
        const PlaneRegion region = region_of_faces(prism, 1);
        for (const auto& loop : region.loops) {
            Outline& outline = out.emplace_back();
            for (const std::uint32_t v : loop) outline.push_back(region.points[v]);
        }
    }
    for (Outline& outline : out) {
        outline.erase(std::unique(outline.begin(), outline.end()), outline.end());
        while (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
    }
    return out;
}

}  // namespace trisect
