// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/projection.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <trisect/bsp/modelling/plane_triangles.h>
#include <trisect/bsp/solid_measure.h>

namespace trisect {
namespace {

/// Of a triangle; a filter: not where the sign is in doubt.
bool looks_down(const Point3d& a, const Point3d& b, const Point3d& c) {
    const double turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double size = (std::abs(b[0] - a[0]) + std::abs(c[0] - a[0])) *
                        (std::abs(b[1] - a[1]) + std::abs(c[1] - a[1]));
    return turn < -1e-12 * size;
}

Solid up_to(double height) { return Solid::half_space({0, 0, 1, -height}); }

/// A power of two, so that heights beside a short number are short; large enough for them to
/// differ.
double slab_thickness(const Solid& solid, double height) {
    const std::optional<Bounds> box = bounds(solid);
    const double size = box ? box->hi[2] - box->lo[2] : 1;
    return std::exp2(std::ceil(std::log2(std::max(size * 0x1p-10, std::fabs(height) * 0x1p-40))));
}

/// By rounded corners: those at the height are at it when rounded, too.
bool may_have_face_at(const PolygonMesh& mesh, double height) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.face(f);
        if (std::all_of(corners.begin(), corners.end(),
                        [&](std::uint32_t v) { return mesh.points[v][2] == height; }))
            return true;
    }
    return false;
}

}  // namespace

// A section is what the faces look like that a cut at this height makes. Faces of the solid itself
// in that plane belong to the half that lies on their other side. What is farther away than a thin
// slab does not matter, and would be assembled for nothing.
PlaneRegion section(const Solid& solid, double height, const EvaluateOptions& options) {
    const Solid below = up_to(height);
    const double thickness = slab_thickness(solid, height);
    const Solid low = evaluate((solid & below) - up_to(height - thickness), options);
    const PlaneRegion lower = region_of_result_faces(low, height, FacesLook::Up);
    // Both sides have the same faces there, if no face of the solid itself is.
    if (!may_have_face_at(solid.to_mesh(options.threads), height))
        return region_of_faces(solid_of_region(lower), 1);
    const Solid high = evaluate((solid & up_to(height + thickness)) - below, options);
    const PlaneRegion upper = region_of_result_faces(high, height, FacesLook::Down);
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
    return evaluate(seen.prism(), options);
}

}  // namespace trisect
