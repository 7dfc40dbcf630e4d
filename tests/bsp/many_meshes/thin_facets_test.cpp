// SPDX-License-Identifier: Apache-2.0
//
// Which solids count as thin (thin_facets.h).

#include <trisect/bsp/many_meshes/thin_facets.h>

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/polygon_mesh.h>

namespace {

using trisect::Point3d;
using trisect::detail::are_mostly_thin;
using trisect::detail::Source;

// A pyramid over a square, of that height.
std::shared_ptr<const Source> pyramid(double height) {
    trisect::PolygonMesh mesh;
    mesh.points = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, height}};
    mesh.corners = {0, 2, 1, 0, 3, 2, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    mesh.face_begin = {0, 3, 6, 9, 12, 15, 18};
    return Source::make(trisect::import_mesh(mesh).mesh);
}

TEST(ThinFacets, AreTheSidesOfNeedles) {
    const auto flat = pyramid(1);
    const auto tall = pyramid(100);
    const auto are_thin = [](std::vector<const Source*> sources, double times) {
        return are_mostly_thin(sources, times);
    };
    EXPECT_FALSE(are_thin({flat.get()}, 8));
    EXPECT_TRUE(are_thin({tall.get()}, 40));
    EXPECT_FALSE(are_thin({tall.get()}, 60));
    EXPECT_TRUE(are_thin({tall.get(), flat.get(), tall.get()}, 8));
    EXPECT_FALSE(are_thin({tall.get(), flat.get()}, 8));  // not most
}

}  // namespace
