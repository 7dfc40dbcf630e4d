// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/projection.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include <trisect/brep/measure.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/mesh_section.h>
#include <trisect/bsp/modelling/plane_triangles.h>
#include <trisect/kernel/error.h>

namespace trisect {
namespace {

/// Of a triangle; a filter: not where the sign is in doubt.
bool looks_down(const Point3d& a, const Point3d& b, const Point3d& c) {
    const double turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double size = (std::abs(b[0] - a[0]) + std::abs(c[0] - a[0])) *
                        (std::abs(b[1] - a[1]) + std::abs(c[1] - a[1]));
    return turn < -1e-12 * size;
}

/// \throw UnsupportedError for an unbounded set
ExactMesh bounded_mesh(const Solid& solid, const EvaluateOptions& options) {
    const int far_out = detail::state_of(solid)->far_out;
    ExactMesh mesh = solid.to_exact_mesh(options.threads);
    // Half-spaces alone decide it only when they have been put together.
    if (far_out == 1 || (far_out < 0 && (mesh.triangles.empty() ? solid.is_whole_space()
                                                                : exact_volume(mesh).sign() < 0)))
        throw UnsupportedError("an unbounded set has no section");
    return mesh;
}

/// Where the winding number of the sides is as the rule has it.
Expression region_within(detail::SectionSides found, const EvaluateOptions& options) {
    if (found.sides.empty()) return Solid();
    const Expression positive = flat_prism(found.corners, found.sides, 0, 1);
    if (options.winding == EvaluateOptions::Winding::Positive) return positive;
    for (auto& [from, to] : found.sides) std::swap(from, to);
    return positive | flat_prism(found.corners, found.sides, 0, 1);
}

/// Both sides have the same faces in the plane, if no face of the solid itself is there.
Solid region_at(const detail::MeshSection& mesh, const EvaluateOptions& options) {
    using Place = detail::MeshSection::Place;
    const Expression below = region_within(mesh.right(Place::Below), options);
    if (!mesh.has_face_in_plane()) return evaluate(below, options);
    return evaluate(below | region_within(mesh.right(Place::Above), options), options);
}

}  // namespace

PlaneRegion section(const Solid& solid, double height, const EvaluateOptions& options) {
    const ExactMesh mesh = bounded_mesh(solid, options);
    return region_of_faces(region_at(detail::MeshSection(mesh, height), options), 1);
}

Solid section_of_mesh(const PolygonMesh& mesh, double height, const EvaluateOptions& options) {
    return region_at(detail::MeshSection(mesh, height), options);
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
