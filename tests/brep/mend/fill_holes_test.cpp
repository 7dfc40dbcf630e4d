// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/mend.h>

#include <gtest/gtest.h>

#include <trisect/brep/primitives/sphere.h>

#include "brep/mend/broken_meshes.h"

namespace trisect {
namespace {

using test::cuboid;

MendedMesh filled(const PolygonMesh& mesh) {
    MendOptions options;
    options.fill_planar_holes = true;
    return mended(mesh, options);
}

TEST(FillHoles, APlanarLoopIsFilled) {
    for (std::size_t f = 0; f < 6; ++f) {
        const MendedMesh out = filled(test::without_face(cuboid(), f));
        EXPECT_EQ(out.report.filled_holes, 1U);
        EXPECT_TRUE(out.report.is_closed());
        EXPECT_EQ(out.source_of_face.back(), no_face);
        EXPECT_TRUE(validate(out.mesh).empty()) << test::findings(out.mesh);
        EXPECT_EQ(test::volume_below(out.mesh), ExactRational(1));
    }
}

TEST(FillHoles, WithTrianglesWhereThereAreNoOthers) {
    const PolygonMesh box = test::in_triangles(cuboid());
    const MendedMesh one = filled(test::without_face(box, 3));
    EXPECT_EQ(one.mesh.face_count(), box.face_count());
    EXPECT_TRUE(validate(one.mesh).empty()) << test::findings(one.mesh);
    const MendedMesh two = filled(test::without_face(test::without_face(box, 3), 2));
    EXPECT_EQ(two.mesh.face_count(), box.face_count());
    EXPECT_TRUE(validate(two.mesh).empty()) << test::findings(two.mesh);
}

TEST(FillHoles, HolesInNoPlaneStay) {
    PolygonMesh mesh = make_icosphere(1, 2);
    // Two triangles at an edge.
    std::size_t other = 0;
    for (std::size_t f = 1; f < mesh.face_count() && other == 0; ++f)
        if (std::ranges::count_if(mesh.face(f), [&](std::uint32_t c) {
                return std::ranges::find(mesh.face(0), c) != mesh.face(0).end();
            }) == 2)
            other = f;
    const MendedMesh out = filled(test::without_face(test::without_face(mesh, other), 0));
    EXPECT_EQ(out.report.filled_holes, 0U);
    ASSERT_EQ(out.report.open.size(), 1U);
    EXPECT_EQ(out.report.open[0].edges, 4U);
    EXPECT_EQ(filled(test::without_face(mesh, 0)).report.filled_holes, 1U);  // a triangle
}

}  // namespace
}  // namespace trisect
