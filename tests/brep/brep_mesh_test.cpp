// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/brep_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include <trisect/brep/measure.h>
#include <trisect/kernel/error.h>

#include "support/breps.h"

namespace {

using namespace trisect;
using namespace trisect::test;

// Every directed edge of a closed manifold mesh appears once and so does its opposite.
void expect_closed_manifold(const PolygonMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        for (std::size_t i = 0; i < loop.size(); ++i)
            ++edges[{loop[i], loop[(i + 1) % loop.size()]}];
    }
    for (const auto& [edge, n] : edges) {
        EXPECT_EQ(n, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
    }
}

LatticeMesh to_lattice_mesh(const PolygonMesh& mesh, Lattice lattice) {
    LatticeMesh out;
    LatticeReport report;
    out.lattice = lattice;
    out.points = to_lattice(mesh.points, lattice, report);
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        out.triangles.push_back({mesh.face(f)[0], mesh.face(f)[1], mesh.face(f)[2]});
    return out;
}

TEST(BrepMesh, FacesWithHolesBecomeMatchingTriangles) {
    const Brep b = prism({rectangle(0, 0, 9, 9), reversed(rectangle(3, 3, 6, 6))}, 9, Lattice{-8});
    MeshMap map;
    const PolygonMesh mesh = to_polygon_mesh(b, {}, &map);
    EXPECT_EQ(mesh.points.size(), b.counts().vertices);
    EXPECT_EQ(mesh.face_count(), 8U * 2 + 2 * 8);
    expect_closed_manifold(mesh);
    ASSERT_EQ(map.face.size(), mesh.face_count());
    EXPECT_EQ(map.source.back(), (FaceSource{0, 9}));
    EXPECT_TRUE(std::is_sorted(map.face.begin(), map.face.end()));
    EXPECT_EQ(exact_volume(to_lattice_mesh(mesh, Lattice{-8})), exact_volume(b));
    EXPECT_EQ(*area(to_lattice_mesh(mesh, Lattice{-8})).exact, *area(b).exact);
}

TEST(BrepMesh, PolygonsAreKeptOnRequest) {
    const Brep b = prism({rectangle(0, 0, 9, 9), reversed(rectangle(3, 3, 6, 6))}, 9);
    const PolygonMesh mesh = to_polygon_mesh(b, {.triangles = false});
    EXPECT_EQ(mesh.face_count(), 8U + 2 * 8);
    EXPECT_EQ(mesh.face(0).size(), 4U);
    expect_closed_manifold(mesh);
}

TEST(BrepMesh, ContactsStayApart) {
    const Brep b = SolidSketch().box({0, 0, 0}, {1, 1, 1}).box({1, 1, 0}, {2, 2, 1}).build();
    const PolygonMesh mesh = to_polygon_mesh(b);
    EXPECT_EQ(mesh.points.size(), 16U);
    expect_closed_manifold(mesh);
}

TEST(BrepMesh, HoleThatTouchesTheRim) {
    // The hole's corner lies on a corner of the outline: one place, two fans, two vertices.
    const Polygon outline{{0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}};
    const Polygon hole{{4, 0, 0}, {3, 3, 0}, {5, 3, 0}};
    const Brep b = prism({outline, hole}, 2);
    EXPECT_EQ(b.edge_contact_count(), 1U);
    const PolygonMesh mesh = to_polygon_mesh(b);
    expect_closed_manifold(mesh);
    EXPECT_EQ(exact_volume(to_lattice_mesh(mesh, {})), exact_volume(b));
}

TEST(BrepMesh, RoundTripThroughALatticeMesh) {
    const PolygonMesh mesh = to_polygon_mesh(cube(5, Lattice{-8}));
    LatticeMesh lattice_mesh = to_lattice_mesh(mesh, Lattice{-8});
    for (std::uint32_t i = 0; i < 12; ++i) lattice_mesh.face_of_triangle.push_back(i / 2);
    const Brep b = brep_from_lattice_mesh(lattice_mesh, 3);
    EXPECT_EQ(b.counts(), (BrepCounts{8, 36, 18, 12, 12, 1}));
    EXPECT_EQ(b.source(FaceId(11)), (FaceSource{3, 5}));
    EXPECT_EQ(to_polygon_mesh(b), mesh);
}

TEST(BrepMesh, OpenMeshIsRefused) {
    LatticeMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    EXPECT_THROW((void)brep_from_lattice_mesh(mesh), Error);
}

TEST(BrepMesh, EmptyInBothDirections) {
    EXPECT_TRUE(brep_from_lattice_mesh({}).is_empty());
    EXPECT_EQ(to_polygon_mesh(Brep()), PolygonMesh{});
}

}  // namespace
