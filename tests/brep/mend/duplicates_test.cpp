// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/mend.h>

#include <gtest/gtest.h>

#include "brep/mend/broken_meshes.h"

namespace trisect {
namespace {

using test::cuboid;

MendedMesh without_duplicates(const PolygonMesh& mesh) {
    MendOptions options;
    options.drop_duplicates = true;
    return mended(mesh, options);
}

void add_copy(PolygonMesh& mesh, std::size_t face, bool turned, std::size_t rotation = 0) {
    std::vector<std::uint32_t> loop(mesh.face(face).begin(), mesh.face(face).end());
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(rotation), loop.end());
    if (turned) std::reverse(loop.begin(), loop.end());
    mesh.add_face(loop);
}

TEST(Duplicates, OneOfEqualFacesStays) {
    PolygonMesh mesh = cuboid();
    add_copy(mesh, 2, false, 1);
    add_copy(mesh, 2, false, 3);
    add_copy(mesh, 5, false, 2);
    const MendedMesh out = without_duplicates(mesh);
    EXPECT_EQ(out.report.duplicate_faces, (std::vector<std::uint32_t>{6, 7, 8}));
    EXPECT_EQ(out.mesh, cuboid());
}

TEST(Duplicates, AMeshThatIsListedTwice) {
    PolygonMesh mesh = cuboid();
    append(mesh, cuboid());
    const MendedMesh out = without_duplicates(mesh);
    EXPECT_EQ(out.mesh, cuboid());
    EXPECT_EQ(out.report.duplicate_faces.size(), 6U);
}

TEST(Duplicates, ACopyThatIsTurnedOverGoes) {
    PolygonMesh mesh = cuboid();
    add_copy(mesh, 4, true, 1);
    const MendedMesh out = without_duplicates(mesh);
    EXPECT_EQ(out.report.duplicate_faces, std::vector<std::uint32_t>{6});
    EXPECT_EQ(out.mesh, cuboid());
}

TEST(Duplicates, TheWallBetweenTwoCellsGoes) {
    PolygonMesh mesh = cuboid();
    append(mesh, cuboid({1, 0, 0}, {2, 1, 1}));
    const MendedMesh out = without_duplicates(mesh);
    EXPECT_EQ(out.report.duplicate_faces, (std::vector<std::uint32_t>{5, 10}));
    EXPECT_TRUE(validate(out.mesh).empty()) << test::findings(out.mesh);
    EXPECT_EQ(test::volume_below(out.mesh), ExactRational(2));
}

TEST(Duplicates, ARingOfWallsStays) {
    // A square at the rim of a box without lid, and its opposite: one edge has another face.
    PolygonMesh mesh =
        test::make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}},
                        {{0, 1, 2, 3}, {3, 2, 1, 0}, {0, 1, 5, 4}});
    const MendedMesh out = without_duplicates(mesh);
    EXPECT_EQ(out.report.duplicates_left, 1U);
    EXPECT_EQ(out.mesh.face_count(), 3U);
}

}  // namespace
}  // namespace trisect
