// SPDX-License-Identifier: Apache-2.0
//
// Manifold's interface over ours: what a program that was written for it relies on. That library's
// own tests are run by scripts/run-suites.

#include <cmath>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <manifold/cross_section.h>
#include <manifold/manifold.h>

namespace {

using manifold::CrossSection;
using manifold::Manifold;
using manifold::MeshGL64;
using manifold::OpType;
using manifold::vec3;

TEST(ManifoldInterface, BooleansAreExact) {
    const Manifold cube = Manifold::Cube();
    const Manifold other = cube.Translate({0.5, 0.5, 0.5});
    EXPECT_EQ((cube + other).Volume(), 1.875);
    EXPECT_EQ((cube ^ other).Volume(), 0.125);
    EXPECT_EQ((cube - other).Volume(), 0.875);
    EXPECT_TRUE((cube - cube).IsEmpty());
    // No length is too small.
    const Manifold sliver = cube ^ cube.Translate({1 - 1e-14, 0, 0});
    EXPECT_FALSE(sliver.IsEmpty());
}

TEST(ManifoldInterface, RunsTellTheOriginalsApart) {
    const Manifold cube = Manifold::Cube();
    const Manifold ball = Manifold::Sphere(0.4, 16).Translate({1, 1, 1});
    const MeshGL64 mesh = (cube - ball).GetMeshGL64();
    ASSERT_EQ(mesh.runOriginalID.size(), 2U);
    EXPECT_EQ(mesh.runOriginalID[0], static_cast<std::uint32_t>(cube.OriginalID()));
    EXPECT_FALSE(mesh.Backside(0));
    EXPECT_TRUE(mesh.Backside(1));
    EXPECT_EQ(mesh.runIndex.back(), mesh.triVerts.size());
    EXPECT_EQ(mesh.GetRunTransform(1)[3], vec3(1.0));
    // Faces in one plane stay apart where they are of two originals, and are joined within one.
    const Manifold row = cube + Manifold::Cube().Translate({1, 0, 0});
    EXPECT_EQ(row.NumVert(), 12U);
    EXPECT_EQ(row.NumTri(), 20U);
    EXPECT_EQ((cube + cube.Translate({1, 1, 0})).Decompose().size(), 2U);
}

TEST(ManifoldInterface, PropertiesAreInterpolated) {
    const auto height = [](double* to, vec3 p, const double*) { to[0] = p.z; };
    const Manifold cube = Manifold::Cube().SetProperties(1, height);
    const MeshGL64 mesh = (cube - Manifold::Sphere(0.7, 12).Translate({0, 0, 1})).GetMeshGL64();
    ASSERT_EQ(mesh.numProp, 4U);
    for (std::size_t t = mesh.runIndex[0]; t < mesh.runIndex[1]; ++t) {
        const double* vertex = &mesh.vertProperties[4 * mesh.triVerts[t]];
        EXPECT_NEAR(vertex[3], vertex[2], 1e-12);
    }
    EXPECT_EQ(mesh.NumVert() - mesh.mergeFromVert.size(), Manifold(mesh).NumVert());
}

TEST(ManifoldInterface, NormalsFollow) {
    const Manifold hollow =
        Manifold::Cube(vec3(4.0), true) - Manifold::Sphere(1).CalculateNormals();
    const MeshGL64 mesh = hollow.Rotate(30, 40, 50).GetMeshGL64();
    ASSERT_TRUE(mesh.HasNormals(1));
    for (std::size_t t = mesh.runIndex[1]; t < mesh.runIndex[2]; ++t) {
        const double* vertex = &mesh.vertProperties[mesh.numProp * mesh.triVerts[t]];
        EXPECT_LT(dot(vec3(vertex), vec3(vertex + 3)), -0.9);
    }
}

TEST(ManifoldInterface, ErrorsArePassedOn) {
    MeshGL64 mesh = Manifold::Tetrahedron().GetMeshGL64();
    mesh.triVerts.pop_back();
    EXPECT_EQ(Manifold(mesh).Status(), Manifold::Error::PropertiesWrongLength);
    mesh = Manifold::Tetrahedron().GetMeshGL64();
    std::swap(mesh.triVerts[0], mesh.triVerts[1]);
    const Manifold open(mesh);
    EXPECT_EQ(open.Status(), Manifold::Error::NotManifold);
    EXPECT_EQ((open + Manifold::Cube()).Translate(vec3(1.0)).Status(), open.Status());
    EXPECT_EQ(Manifold::Cube(vec3(0.0)).Status(), Manifold::Error::InvalidConstruction);
    EXPECT_THROW(static_cast<void>(Manifold::Cube().SmoothOut()), manifold::NotSupported);
}

TEST(ManifoldInterface, SectionsAndSums) {
    const CrossSection ring = CrossSection::Circle(2, 32) - CrossSection::Circle(1, 32);
    EXPECT_EQ(ring.NumContour(), 2U);
    const Manifold pipe = Manifold::Extrude(ring.ToPolygons(), 3);
    EXPECT_EQ(pipe.Genus(), 1);
    EXPECT_NEAR(pipe.Volume(), 3 * ring.Area(), 1e-12);
    EXPECT_NEAR(CrossSection(pipe.Slice(1)).Area(), ring.Area(), 1e-12);
    const Manifold corner = Manifold::Cube(vec3(2.0)) - Manifold::Cube();
    EXPECT_EQ(corner.MinkowskiSum(Manifold::Cube()).Volume(), 26);
    EXPECT_EQ(Manifold::Cube(vec3(3.0)).MinkowskiDifference(Manifold::Cube()).Volume(), 8);
}

TEST(ManifoldInterface, Questions) {
    const Manifold pair = Manifold::Cube() + Manifold::Cube().Translate({0, 0, 3});
    const auto hits = pair.RayCast({0.5, 0.5, -1}, {0.5, 0.5, 5});
    ASSERT_EQ(hits.size(), 4U);
    EXPECT_DOUBLE_EQ(hits[2].position.z, 3);
    EXPECT_EQ(hits[2].normal.z, -1);
    EXPECT_EQ(pair.MinGap(Manifold::Cube().Translate({0, 0, 1.5}), 9), 0.5);
    EXPECT_EQ(pair.WindingNumber({vec3(0.5), {0.5, 0.5, 2}}), (std::vector<int>{1, 0}));
    std::stringstream file;
    EXPECT_TRUE(pair.WriteOBJ(file));
    EXPECT_EQ(Manifold::ReadOBJ(file).Volume(), 2);
}

// Both parts come from one evaluation, with the runs and properties of two.
TEST(ManifoldInterface, SplitsAreThoseOfTwoOperations) {
    const manifold::Manifold a = manifold::Manifold::Sphere(1, 32);
    const manifold::Manifold b = manifold::Manifold::Sphere(0.75, 24).Translate({0.5, 0.25, 0.125});
    const auto expect_same = [](const manifold::Manifold& m, const manifold::Manifold& wanted) {
        EXPECT_EQ(m.Volume(), wanted.Volume());
        const auto mesh = m.GetMeshGL64();
        const auto expected = wanted.GetMeshGL64();
        EXPECT_EQ(mesh.triVerts, expected.triVerts);
        EXPECT_EQ(mesh.vertProperties, expected.vertProperties);
        EXPECT_EQ(mesh.runIndex, expected.runIndex);
    };
    const auto [common, rest] = a.Split(b);
    expect_same(common, a ^ b);
    expect_same(rest, a - b);
    EXPECT_TRUE(a.Split(a).second.IsEmpty());
    const auto [above, below] = a.SplitByPlane({1, 2, 3}, 0.125);
    expect_same(above, a.TrimByPlane({1, 2, 3}, 0.125));
    EXPECT_EQ(below.Volume(), a.TrimByPlane({-1, -2, -3}, -0.125).Volume());
    EXPECT_TRUE(manifold::Manifold().Split(a).first.IsEmpty());
}

}  // namespace
