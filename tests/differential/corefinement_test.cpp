// SPDX-License-Identifier: Apache-2.0
//
// Booleans of spheres and tori against CGAL's corefinement with exact constructions: thousands of
// triangles in general position, where the exact volumes must be the same fractions.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <sstream>

#include <trisect/brep/interop/cgal.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace {

using trisect::AffineMap;
using trisect::PolygonMesh;
using trisect::Solid;

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

// Moved and turned: both sides get the same doubles.
PolygonMesh placed(const PolygonMesh& mesh, const trisect::Point3d& by, double degrees) {
    return trisect::transformed(mesh, trisect::compose(AffineMap::translation(by),
                                                       AffineMap::rotation({3, 1, 2}, degrees)));
}

trisect::ExactRational exact(const Kernel::FT& value) {
    std::ostringstream text;
    text << CGAL::exact(value);
    return trisect::ExactRational::from_string(text.str());
}

trisect::ExactRational volume(const trisect::Expression& e) {
    return trisect::exact_volume(trisect::evaluate(e).to_brep());
}

enum class Operation { Union, Intersection, Difference };

trisect::ExactRational cgal_volume(const PolygonMesh& a, const PolygonMesh& b, Operation op) {
    Mesh x = trisect::to_cgal_surface_mesh<Kernel::Point_3>(a);
    Mesh y = trisect::to_cgal_surface_mesh<Kernel::Point_3>(b);
    Mesh out;
    bool done = false;
    switch (op) {
        case Operation::Union:
            done = pmp::corefine_and_compute_union(x, y, out);
            break;
        case Operation::Intersection:
            done = pmp::corefine_and_compute_intersection(x, y, out);
            break;
        default:
            done = pmp::corefine_and_compute_difference(x, y, out);
            break;
    }
    EXPECT_TRUE(done);
    return exact(pmp::volume(out));
}

void check(const PolygonMesh& a, const PolygonMesh& b) {
    const Solid x = Solid::from_mesh(a);
    const Solid y = Solid::from_mesh(b);
    EXPECT_EQ(volume(x), exact(pmp::volume(trisect::to_cgal_surface_mesh<Kernel::Point_3>(a))));
    EXPECT_EQ(volume(x | y), cgal_volume(a, b, Operation::Union));
    EXPECT_EQ(volume(x & y), cgal_volume(a, b, Operation::Intersection));
    EXPECT_EQ(volume(x - y), cgal_volume(a, b, Operation::Difference));
}

TEST(AgainstCorefinement, TwoSpheres) {
    const PolygonMesh sphere = trisect::make_icosphere(1, 3);
    check(placed(sphere, {0, 0, 0}, 0), placed(sphere, {0.71, 0.35, 0.2}, 37));
}

TEST(AgainstCorefinement, ASphereOfLatitudesInAnIcosphere) {
    check(placed(trisect::make_icosphere(1, 2), {0, 0, 0}, 5),
          placed(trisect::make_uv_sphere(0.9, 24, 12), {0.2, 0.1, 0}, 71));
}

TEST(AgainstCorefinement, LinkedTori) {
    const PolygonMesh torus = trisect::make_torus(3, 1, 24, 12);
    check(placed(torus, {0, 0, 0}, 0), placed(torus, {2.5, 0.3, 0.1}, 95));
}

TEST(AgainstCorefinement, ATorusThroughASphere) {
    check(placed(trisect::make_torus(2, 0.6, 32, 12), {0, 0, 0}, 11),
          placed(trisect::make_icosphere(1.5, 2), {1.4, 0.2, -0.1}, 0));
}

}  // namespace
