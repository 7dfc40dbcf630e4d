// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/primitives/hull.h>

#include <cmath>
#include <vector>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/primitives/convex_sweep.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/lattice_point.h>

namespace trisect {

namespace {

PolygonMesh to_polygons(const LatticeMesh& mesh) {
    PolygonMesh out;
    out.points.reserve(mesh.points.size());
    for (const LatticePoint& p : mesh.points) {
        const auto [x, y, z] = p.doubles();
        out.points.push_back(
            {mesh.lattice.to_double(x), mesh.lattice.to_double(y), mesh.lattice.to_double(z)});
    }
    for (const auto& [a, b, c] : mesh.triangles) out.add_triangle(a, b, c);
    return out;
}

}  // namespace

PolygonMesh make_hull(std::span<const Point3d> points) {
    for (const Point3d& p : points)
        for (const double c : p)
            if (!std::isfinite(c))
                throw LimitError("a convex hull needs coordinates that are finite");
    const Lattice lattice = choose_lattice(points, 0, Fractions::Kept);
    LatticeReport report;
    const std::vector<LatticePoint> placed =
        to_lattice(points, lattice, report, 0, Fractions::Kept);
    if (!report.lossless)
        throw LimitError("the coordinates of a convex hull's points span more than 126 bits");
    return to_polygons(hull_mesh(placed, lattice));
}

}  // namespace trisect
