// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/offset_of_solid.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/error.h>

namespace trisect {
namespace {

constexpr std::uint32_t most_subdivisions = 3;
// Above what snapping corners to 1.2e-10 and arithmetic change.
constexpr double rounding = 1e-9;

/// The distance of a triangle's plane from the origin.
double plane_distance(const PolygonMesh& mesh, std::size_t f) {
    const Point3d& a = mesh.points[mesh.face(f)[0]];
    const Point3d& b = mesh.points[mesh.face(f)[1]];
    const Point3d& c = mesh.points[mesh.face(f)[2]];
    const Point3d u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Point3d v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const Point3d n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
    return (n[0] * a[0] + n[1] * a[1] + n[2] * a[2]) / std::hypot(n[0], n[1], n[2]);
}

PolygonMesh polyhedron(double size, const SolidOffsetOptions& options) {
    using Shape = SolidOffsetOptions::Shape;
    if (options.shape == Shape::Cube) return make_box({-size, -size, -size}, {size, size, size});
    if (options.shape == Shape::Octahedron)
        return make_hull(std::array<Point3d, 6>{{{size, 0, 0},
                                                 {-size, 0, 0},
                                                 {0, size, 0},
                                                 {0, -size, 0},
                                                 {0, 0, size},
                                                 {0, 0, -size}}});
    const double inner = icosphere_inner_radius(options.subdivisions);
    const bool is_around = options.fit == SolidOffsetOptions::Fit::Around;
    return make_icosphere(is_around ? size / inner : size, options.subdivisions);
}

Solid offset_by(const Solid& solid, bool grows, const Solid& tool,
                const MinkowskiOptions& options) {
    return grows ? minkowski_sum(solid, tool, options) : minkowski_difference(solid, tool, options);
}

void require_finite(double distance) {
    if (!std::isfinite(distance)) throw UsageError("the distance of an offset must be finite");
}

}  // namespace

double icosphere_inner_radius(std::uint32_t subdivisions) {
    if (subdivisions > most_subdivisions)
        throw UsageError("the ball of an offset has three subdivisions at most");
    const PolygonMesh mesh = make_icosphere(1, subdivisions);
    double out = 1;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        out = std::min(out, plane_distance(mesh, f));
    return out - rounding;
}

Solid offset_of_solid(const Solid& solid, double distance, const SolidOffsetOptions& options) {
    require_finite(distance);
    if (options.subdivisions > most_subdivisions)
        throw UsageError("the ball of an offset has three subdivisions at most");
    if (distance == 0 || solid.is_empty()) return solid;
    const Solid tool = Solid::from_mesh(polyhedron(std::fabs(distance), options));
    return offset_by(solid, distance > 0, tool, options.minkowski);
}

Solid offset_of_solid(const Solid& solid, double distance, const Solid& unit_tool,
                      const MinkowskiOptions& options) {
    require_finite(distance);
    if (distance == 0 || solid.is_empty()) return solid;
    const double size = std::fabs(distance);
    const Solid tool = transformed(unit_tool, AffineMap::scaling({size, size, size}));
    return offset_by(solid, distance > 0, tool, options);
}

}  // namespace trisect
