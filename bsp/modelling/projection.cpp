// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/projection.h>

#include <cmath>

#include <trisect/bsp/modelling/plane_triangles.h>

namespace trisect {
namespace {

/// Of a triangle; a filter: not where the sign is in doubt.
bool looks_down(const Point3d& a, const Point3d& b, const Point3d& c) {
    const double turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double size = (std::abs(b[0] - a[0]) + std::abs(c[0] - a[0])) *
                        (std::abs(b[1] - a[1]) + std::abs(c[1] - a[1]));
    return turn < -1e-12 * size;
}

}  // namespace

// A section is what the faces look like that a cut at this height makes. Faces of the solid itself
// in that plane belong to the half that lies on their other side.
PlaneRegion section(const Solid& solid, double height, const EvaluateOptions& options) {
    const Solid below = Solid::half_space({0, 0, 1, -height});
    const PlaneRegion lower =
        region_of_faces(evaluate(solid & below, options), height, FacesLook::Up);
    const PlaneRegion upper =
        region_of_faces(evaluate(solid - below, options), height, FacesLook::Down);
    const Solid both = evaluate(solid_of_region(lower) | solid_of_region(upper), options);
    return region_of_faces(both, 1);
}

// What looks down covers nothing that the triangles that look up do not. Walls are below their
// outline alone, the silhouette.
Solid shadow(const Solid& solid, const EvaluateOptions& options) {
    const PolygonMesh mesh = solid.to_mesh(options.threads);
    detail::PlaneTriangles seen;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto t = mesh.face(f);
        const Point3d& a = mesh.points[t[0]];
        const Point3d& b = mesh.points[t[1]];
        const Point3d& c = mesh.points[t[2]];
        if (!looks_down(a, b, c)) seen.add({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]});
    }
    return evaluate(seen.prisms(), options);
}

}  // namespace trisect
