// SPDX-License-Identifier: Apache-2.0
#include "solids.h"

#include <cmath>

#include <trisect/brep/primitives/sphere.h>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>

namespace solids {

trisect::Solid ball(double radius, std::uint32_t level, const trisect::Point3d& at, double unit) {
    trisect::PolygonMesh mesh = trisect::make_icosphere(radius, level);
    for (trisect::Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] = std::round((p[k] + at[k]) / unit) * unit;
    return trisect::Solid::from_mesh(mesh);
}

using trisect::Expression;
using trisect::Point3d;
using trisect::Solid;

Solid box(const Point3d& low, const Point3d& high) {
    return Solid::from_mesh(trisect::make_box(low, high));
}

Solid box(double x0, double y0, double z0, double x1, double y1, double z1) {
    return box(Point3d{x0, y0, z0}, Point3d{x1, y1, z1});
}

Solid box(double low, double high) {
    return box(Point3d{low, low, low}, Point3d{high, high, high});
}

Expression of_mesh(const trisect::PolygonMesh& mesh) { return Expression(Solid::from_mesh(mesh)); }

std::string volume(const Expression& formula) {
    return trisect::exact_volume(evaluate(formula).to_brep()).to_string();
}

}  // namespace solids
