// SPDX-License-Identifier: Apache-2.0
//
// CGAL meshes in and out: a box becomes a Surface_mesh and a Polyhedron_3 and comes back unchanged.

#include <iostream>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <trisect/brep/interop/cgal.h>
#include <trisect/brep/primitives/box.h>

int main() {
    using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
    using Plain = CGAL::Simple_cartesian<double>;

    const trisect::PolygonMesh box = trisect::make_box({1, 2, 3});
    const auto surface = trisect::to_cgal_surface_mesh<Exact::Point_3>(box);
    const auto polyhedron = trisect::to_cgal_polyhedron<Plain>(box);

    const trisect::FromCgal a = trisect::from_cgal(surface);
    const trisect::FromCgal b = trisect::from_cgal(polyhedron);
    std::cout << "Surface_mesh: " << a.mesh.face_count() << " faces, " << a.rounded_coordinates
              << " coordinates rounded\nPolyhedron_3: " << b.mesh.face_count() << " faces\n";
    return a.mesh.points == box.points && b.mesh.points == box.points && a.mesh.face_count() == 6 &&
                   b.mesh.face_count() == 6
               ? 0
               : 1;
}
