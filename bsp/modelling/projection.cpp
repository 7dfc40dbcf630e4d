// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/projection.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/extrusion.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect {
namespace {

/// Of a triangle that looks up; any other one covers nothing that these do not.
std::optional<Solid> prism_over(const PolygonMesh& mesh, std::size_t f) {
    Outline outline;
    for (const std::uint32_t v : mesh.face(f))
        outline.push_back({mesh.points[v][0], mesh.points[v][1]});
    const Point2d& a = outline[0];
    const Point2d& b = outline[1];
    const Point2d& c = outline[2];
    // A filter: where the sign is in doubt the triangle is taken, which covers nothing too much.
    const double turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double size = (std::abs(b[0] - a[0]) + std::abs(c[0] - a[0])) *
                        (std::abs(b[1] - a[1]) + std::abs(c[1] - a[1]));
    if (turn < -1e-12 * size) return std::nullopt;
    try {
        return Solid::from_mesh(make_extrusion(outline, {}, 0, 1));
    } catch (const UsageError&) {
        return std::nullopt;  // it stands upright
    }
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

Solid shadow(const Solid& solid, const EvaluateOptions& options) {
    const PolygonMesh mesh = solid.to_mesh();
    std::vector<Solid> prisms;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        detail::check_stop();
        if (auto prism = prism_over(mesh, f)) prisms.push_back(std::move(*prism));
    }
    return evaluate(Expression::any_of(prisms), options);
}

}  // namespace trisect
