// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums of small solids that are not convex, and offsets of them, against CGAL's of Nef
// polyhedra, which cuts into convex parts: exact volumes must be the same fractions.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/minkowski_sum_3.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include <trisect/brep/interop/cgal.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/minkowski.h>
#include <trisect/bsp/modelling/offset_of_solid.h>
#include <trisect/bsp/solid_measure.h>

#include "support/solids.h"

namespace {

using trisect::Solid;
using trisect::SolidOffsetOptions;

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Nef nef_of(const Solid& solid) {
    Mesh mesh = trisect::to_cgal_surface_mesh<Kernel::Point_3>(solid.to_mesh());
    return Nef(mesh);
}

std::string cgal_volume(const Solid& a, const Solid& b) {
    Nef x = nef_of(a);
    Nef y = nef_of(b);
    const Nef sum = CGAL::minkowski_sum_3(x, y);
    Mesh mesh;
    CGAL::convert_nef_polyhedron_to_polygon_mesh(sum, mesh, true);
    std::ostringstream text;
    text << CGAL::exact(CGAL::Polygon_mesh_processing::volume(mesh));
    return text.str();
}

std::string volume_of(const Solid& solid) { return trisect::exact_volume(solid).to_string(); }

Solid bracket() {
    return evaluate(solids::box({0, 0, 0}, {4, 1, 1}) | solids::box({0, 0, 0}, {1, 1, 4}));
}
Solid frame() {
    return evaluate(solids::box({0, 0, 0}, {5, 5, 2}) - solids::box({1, 1, -1}, {4, 3, 3}));
}

TEST(MinkowskiSum, OfSolidsAsCgalHasThem) {
    const Solid tool = solids::box({-1, 0, 0}, {0.5, 1, 0.25});
    EXPECT_EQ(volume_of(minkowski_sum(bracket(), tool)), cgal_volume(bracket(), tool));
    EXPECT_EQ(volume_of(minkowski_sum(frame(), tool)), cgal_volume(frame(), tool));
    EXPECT_EQ(volume_of(minkowski_sum(frame(), bracket())), cgal_volume(frame(), bracket()));
}

TEST(MinkowskiSum, OfOffsetsAsCgalHasThem) {
    const Solid octahedron = offset_of_solid(solids::box({0, 0, 0}, {1, 1, 1}), 0.5,
                                             {.shape = SolidOffsetOptions::Shape::Octahedron});
    EXPECT_EQ(volume_of(minkowski_sum(frame(), octahedron)), cgal_volume(frame(), octahedron));
    const Solid ball = solids::ball(0.5, 0, {}, 0x1p-8);
    EXPECT_EQ(volume_of(offset_of_solid(bracket(), 1, ball)), cgal_volume(bracket(), ball));
}

}  // namespace
