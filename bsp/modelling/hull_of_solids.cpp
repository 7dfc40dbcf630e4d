// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/hull_of_solids.h>

#include <vector>

#include <trisect/brep/primitives/hull.h>

namespace trisect {

Solid hull(std::span<const Solid> solids) {
    std::vector<Point3d> points;
    for (const Solid& solid : solids) {
        const PolygonMesh mesh = solid.to_mesh();
        points.insert(points.end(), mesh.points.begin(), mesh.points.end());
    }
    return points.empty() ? Solid() : Solid::from_mesh(make_hull(points));
}

Solid hull(const Solid& solid) { return hull(std::span(&solid, 1)); }

}  // namespace trisect
