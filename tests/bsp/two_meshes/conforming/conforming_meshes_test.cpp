// SPDX-License-Identifier: Apache-2.0
//
// How facets of two meshes lie to the other one, where nothing needs to be cut, and pairs that are
// none of the kind (conforming_meshes.h). The search by boxes is all pairs here.

#include <trisect/bsp/two_meshes/conforming/conforming_meshes.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/torus.h>

namespace {

using trisect::LatticeMesh;
using trisect::PolygonMesh;
using trisect::detail::Box;
using trisect::detail::ConformingMeshes;
using trisect::detail::FacetLists;
using trisect::detail::FacetRelation;
using trisect::detail::find_conforming;
using trisect::detail::Frame;
using trisect::detail::PackedBox;
using trisect::detail::PairsCheck;

LatticeMesh imported(const PolygonMesh& mesh) { return trisect::import_mesh(mesh).mesh; }

// With the other diagonal in each face of four corners.
PolygonMesh turned(const PolygonMesh& mesh) {
    PolygonMesh out;
    out.points = mesh.points;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        std::vector<std::uint32_t> loop(face.begin(), face.end());
        std::rotate(loop.begin(), loop.begin() + 1, loop.end());
        out.add_face(loop);
    }
    return out;
}

std::optional<ConformingMeshes> find(const LatticeMesh& a, const LatticeMesh& b,
                                     std::size_t* calls = nullptr) {
    const std::array<const LatticeMesh*, 2> meshes{&a, &b};
    std::array<std::vector<std::uint32_t>, 2> facets;
    std::array<std::vector<PackedBox>, 2> boxes;
    Box all;
    for (const LatticeMesh* m : meshes)
        for (const auto& p : m->points) all.add(Box::of(p));
    const Frame frame = Frame::covering(all);
    for (std::size_t i = 0; i < 2; ++i) {
        facets[i].resize(meshes[i]->triangles.size());
        std::iota(facets[i].begin(), facets[i].end(), 0U);
        for (const std::uint32_t f : facets[i]) {
            Box box;
            for (const std::uint32_t v : meshes[i]->triangles[f])
                box.add(Box::of(meshes[i]->points[v]));
            boxes[i].push_back(PackedBox::of(frame, box, f));
        }
    }
    const auto search = [&](const PairsCheck& check, const std::vector<FacetLists>&) {
        if (calls != nullptr) ++*calls;
        return check(boxes[0], boxes[1]);
    };
    return find_conforming(meshes, {facets[0], facets[1]}, search, 1);
}

std::map<FacetRelation, int> counts(const ConformingMeshes::Mesh& mesh) {
    std::map<FacetRelation, int> out;
    for (const FacetRelation r : mesh.relations) ++out[r];
    return out;
}
using Counts = std::map<FacetRelation, int>;

PolygonMesh box(double x, double y, double z, double size = 2) {
    return trisect::make_box({x, y, z}, {x + size, y + size, z + size});
}

TEST(FindConforming, TakesBoxesSideBySide) {
    for (const bool is_turned : {false, true}) {
        const PolygonMesh beside = box(2, 0, 0);
        const auto found =
            find(imported(box(0, 0, 0)), imported(is_turned ? turned(beside) : beside));
        ASSERT_TRUE(found);
        EXPECT_FALSE(found->are_some_unknown);
        for (const auto& mesh : found->meshes)
            EXPECT_EQ(counts(mesh),
                      (Counts{{FacetRelation::Above, 10}, {FacetRelation::Opposite, 2}}));
        EXPECT_EQ(found->equal_corners->pairs.size(), 4U);
    }
}

TEST(FindConforming, TakesABoxWithOtherDiagonals) {
    const auto found = find(imported(box(0, 0, 0)), imported(turned(box(0, 0, 0))));
    ASSERT_TRUE(found);
    for (const auto& mesh : found->meshes)
        EXPECT_EQ(counts(mesh), (Counts{{FacetRelation::Same, 12}}));
}

TEST(FindConforming, TakesBoxesThatMeetInAnEdge) {
    const auto found = find(imported(box(0, 0, 0)), imported(box(2, 2, 0)));
    ASSERT_TRUE(found);
    for (const auto& mesh : found->meshes)
        EXPECT_EQ(counts(mesh), (Counts{{FacetRelation::Above, 12}}));
}

TEST(FindConforming, LeavesSidesOpenWhereCornersAloneAreCommon) {
    const auto found = find(imported(box(0, 0, 0)), imported(box(2, 2, 2)));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->are_some_unknown);
    for (const auto& mesh : found->meshes) {
        EXPECT_EQ(counts(mesh), (Counts{{FacetRelation::Unknown, 12}}));
        for (const std::uint32_t corner : mesh.corners) EXPECT_FALSE(mesh.is_common[corner]);
        EXPECT_EQ(std::ranges::count(mesh.is_common, true), 1);
    }
}

// Faces of a mesh and its mirror image in a common edge, or a half of one face.
TEST(FindConforming, RefusesWhatMeetsElsewhere) {
    EXPECT_FALSE(find(imported(box(0, 0, 0)), imported(box(9, 0, 0))));     // no common corner
    EXPECT_FALSE(find(imported(box(0, 0, 0)), imported(box(2, 1, 0))));     // half of a face
    EXPECT_FALSE(find(imported(box(0, 0, 0)), imported(box(0, 0, 0, 4))));  // part of a face
    // Two tetrahedra with a common corner that cross.
    const auto tetrahedron = [](std::array<double, 3> c, std::array<double, 3> d) {
        PolygonMesh out;
        out.points = {{0, 0, 0}, {4, 0, 0}, {c[0], c[1], c[2]}, {d[0], d[1], d[2]}};
        for (const auto& t : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
            out.add_face(std::vector<std::uint32_t>{static_cast<std::uint32_t>(t[0]),
                                                    static_cast<std::uint32_t>(t[1]),
                                                    static_cast<std::uint32_t>(t[2])});
        return out;
    };
    const PolygonMesh first = tetrahedron({0, 4, 0}, {0, 0, 4});
    EXPECT_FALSE(find(imported(first), imported(tetrahedron({0, 4, 1}, {1, 1, 6}))));
    EXPECT_TRUE(find(imported(first), imported(tetrahedron({0, 4, -1}, {1, 1, -6}))));
}

// The search by boxes is not begun where corners show it.
TEST(FindConforming, EndsBeforeTheSearchWhereACornerShowsIt) {
    std::size_t calls = 0;
    EXPECT_FALSE(find(imported(box(0, 0, 0)), imported(box(0, 0, 0, 4)), &calls));
    EXPECT_EQ(calls, 0U);
    EXPECT_TRUE(find(imported(box(0, 0, 0)), imported(box(0, 0, 2)), &calls));
    EXPECT_EQ(calls, 1U);
}

// Faces of a torus of four corners are planar up to rounding. Its mirror image has the other
// diagonals; between the two of each face there is a tetrahedron, or nothing.
TEST(FindConforming, TakesATorusAndItsMirrorImage) {
    const PolygonMesh torus = trisect::make_torus(0.7, 0.3, 24, 12);
    PolygonMesh mirrored;
    mirrored.points = torus.points;
    for (auto& p : mirrored.points) p[0] = -p[0];
    for (std::size_t f = 0; f < torus.face_count(); ++f) {
        const auto face = torus.face(f);
        std::vector<std::uint32_t> loop(face.rbegin(), face.rend());
        mirrored.add_face(loop);
    }
    const LatticeMesh a = imported(torus);
    const LatticeMesh b = imported(mirrored);
    const auto found = find(a, b);
    ASSERT_TRUE(found);
    for (const auto& mesh : found->meshes) {
        Counts of = counts(mesh);
        EXPECT_EQ(of[FacetRelation::Above] + of[FacetRelation::Below] + of[FacetRelation::Same],
                  static_cast<int>(a.triangles.size()));
        EXPECT_GT(of[FacetRelation::Above], 0);
        EXPECT_GT(of[FacetRelation::Below], 0);
    }
}

}  // namespace
