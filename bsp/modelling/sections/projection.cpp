// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/projection.h>

#include <cmath>
#include <cstdint>
#include <span>

#include <trisect/bsp/modelling/pieces/plane_triangles.h>
#include <trisect/bsp/modelling/sections/mesh_section.h>
#include <trisect/bsp/modelling/sections/section_prism.h>

namespace trisect {
namespace {

/// Of a triangle; a filter: not where the sign is in doubt.
bool looks_down(const Point3d& a, const Point3d& b, const Point3d& c) {
    const double turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double size = (std::abs(b[0] - a[0]) + std::abs(c[0] - a[0])) *
                        (std::abs(b[1] - a[1]) + std::abs(c[1] - a[1]));
    return turn < -1e-12 * size;
}

/// At one height.
Solid region_at(const detail::MeshSection& mesh, double height, const EvaluateOptions& options) {
    const detail::SectionStack stack(mesh, std::span(&height, 1));
    return detail::section_prism(mesh, stack.plane(0), SliceRule::Closed, options).prism;
}

}  // namespace

PlaneRegion section(const Solid& solid, double height, const EvaluateOptions& options) {
    const ExactMesh mesh = detail::mesh_of_bounded(solid, options);
    return region_of_faces(region_at(detail::MeshSection(mesh), height, options), 1);
}

Solid section_of_mesh(const PolygonMesh& mesh, double height, const EvaluateOptions& options) {
    return region_at(detail::MeshSection(mesh), height, options);
}

// What looks down covers nothing that the triangles that look up do not. Walls are below their
// outline alone, the silhouette.
Solid shadow(const Solid& solid, const EvaluateOptions& options) {
    return shadow_of_mesh(solid.to_mesh(options.threads), options);
}

Solid shadow_of_mesh(const PolygonMesh& mesh, const EvaluateOptions& options) {
    detail::PlaneTriangles seen;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto t = mesh.face(f);
        const Point3d& a = mesh.points[t[0]];
        const Point3d& b = mesh.points[t[1]];
        const Point3d& c = mesh.points[t[2]];
        if (!looks_down(a, b, c)) seen.add({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]});
    }
    return evaluate(seen.prism(), options);
}

}  // namespace trisect
