// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/mend.h>

#include <cmath>

#include <gtest/gtest.h>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/kernel/error.h>

#include "brep/mend/broken_meshes.h"

namespace trisect {
namespace {

using test::cuboid;
using test::cut_apart;
using test::volume_below;

MendOptions seams(double distance) {
    MendOptions options;
    options.seams = distance;
    return options;
}

TEST(CloseSeams, OfASphereThatWasCut) {
    const PolygonMesh sphere = make_uv_sphere(1, 40, 21);
    for (unsigned seed = 0; seed < 10; ++seed) {
        const double jitter = 1e-4;
        const PolygonMesh cut = cut_apart(sphere, jitter, seed);
        ASSERT_FALSE(validate(cut).is_solid());
        const double distance = 2 * jitter * std::sqrt(3.0);
        const MendedMesh out = mended(cut, seams(distance));
        EXPECT_TRUE(out.report.is_closed());
        EXPECT_EQ(out.report.joined.size(), cut.points.size() - sphere.points.size());
        EXPECT_LE(out.report.max_move, distance);
        EXPECT_EQ(out.mesh.points.size(), sphere.points.size());
        EXPECT_EQ(out.mesh.face_count(), sphere.face_count());
        EXPECT_TRUE(validate(out.mesh).is_solid()) << test::findings(out.mesh);
        // No vertex is farther than the distance and a jitter from where it was.
        EXPECT_NEAR(volume_below(out.mesh).to_double(), volume_below(sphere).to_double(),
                    4 * 3.15 * (distance + 2 * jitter));
        // Coordinates are some that were given.
        for (std::size_t i = 0; i < out.mesh.points.size(); ++i)
            EXPECT_EQ(out.mesh.points[i], cut.points[out.source_of_point[i]]);
    }
}

TEST(CloseSeams, TooSmallADistanceLeavesThemOpen) {
    const PolygonMesh cut = cut_apart(make_uv_sphere(1, 16, 9), 1e-3, 1);
    const MendedMesh out = mended(cut, seams(1e-9));
    EXPECT_TRUE(out.report.joined.empty());
    ASSERT_EQ(out.report.open.size(), 2U);
    for (const OpenBoundary& b : out.report.open) {
        EXPECT_TRUE(b.is_loop);
        EXPECT_EQ(b.edges, 16U);
        EXPECT_NEAR(b.length, 6.1, 0.2);
    }
}

TEST(CloseSeams, TheBoundIsExact) {
    // Two squares, 3/2^20 apart, along the diagonal of a box with sides 2, 2 and 1 (times 2^-20).
    PolygonMesh mesh = test::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    const double u = 0x1p-20;
    mesh.points.push_back({1 + 2 * u, 2 * u, u});
    mesh.points.push_back({5, 5, 5});
    mesh.points.push_back({6, 5, 7});
    mesh.add_triangle(3, 4, 5);
    EXPECT_EQ(mended(mesh, seams(3 * u)).report.joined.size(), 1U);
    EXPECT_EQ(mended(mesh, seams(std::nextafter(3 * u, 1))).report.joined.size(), 1U);
    EXPECT_EQ(mended(mesh, seams(std::nextafter(3 * u, 0))).report.joined.size(), 0U);
    const MendedMesh out = mended(mesh, seams(3 * u));
    EXPECT_EQ(out.report.joined[0], (JoinedVertex{3, 1, 3 * u}));
    EXPECT_EQ(out.report.max_move, 3 * u);
}

TEST(CloseSeams, NearestPairsFirst) {
    // Three vertices in a row at 0, 2 and 3: the last two are nearer. The first one is 3 away from
    // the last one, so the place of the one between is that of all.
    PolygonMesh mesh;
    for (const double x : {0.0, 2.0, 3.0}) {
        const auto n = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back({x, 0, 0});
        mesh.points.push_back({9 * x, 50, 60});
        mesh.points.push_back({9 * x, 100, 0});
        mesh.add_triangle(n, n + 1, n + 2);
    }
    const MendedMesh out = mended(mesh, seams(2));
    EXPECT_EQ(out.report.joined, (std::vector<JoinedVertex>{{0, 3, 2}, {6, 3, 1}}));
}

TEST(CloseSeams, ChainsDoNotMoveFar) {
    PolygonMesh mesh;
    for (int i = 0; i < 50; ++i) {
        const auto n = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back({1.0 * i, 0, 0});
        mesh.points.push_back({100.0 * i, 5000, 100});
        mesh.points.push_back({100.0 * i, 7000, -300});
        mesh.add_triangle(n, n + 1, n + 2);
    }
    const MendedMesh out = mended(mesh, seams(1.5));
    EXPECT_FALSE(out.report.joined.empty());
    EXPECT_EQ(out.report.max_move, 1);
    for (const JoinedVertex& j : out.report.joined)
        EXPECT_LE(std::abs(mesh.points[j.vertex][0] - mesh.points[j.into][0]), 1.5);
}

// Facets whose digits are cut off or rounded up at random: copies of a corner lie exactly on edges
// beside it, and must not go into them before they are joined.
TEST(CloseSeams, OfFacetsWithFewDigits) {
    PolygonMesh whole = test::in_triangles(cuboid({0, 0, 0}, {16, 16, 16}));
    PolygonMesh ball = test::in_triangles(make_uv_sphere(4, 12, 7));
    for (Point3d& p : ball.points) p[0] += 30;
    append(whole, ball);
    for (unsigned seed = 0; seed < 20; ++seed) {
        std::mt19937 random(seed);
        const double unit = 0x1p-10;
        PolygonMesh soup;
        for (std::size_t f = 0; f < whole.face_count(); ++f) {
            std::vector<std::uint32_t> loop;
            for (const std::uint32_t c : whole.face(f)) {
                Point3d p = whole.points[c];
                for (double& x : p)
                    x = (std::floor(x / unit) + static_cast<double>(random() % 2)) * unit;
                loop.push_back(static_cast<std::uint32_t>(soup.points.size()));
                soup.points.push_back(p);
            }
            soup.add_face(loop);
        }
        const MendedMesh out = mended(soup, seams(1.75 * unit));
        EXPECT_TRUE(out.report.is_closed());
        EXPECT_EQ(out.mesh.points.size(), whole.points.size());
        EXPECT_EQ(out.mesh.face_count(), whole.face_count());
    }
}

TEST(CloseSeams, VerticesOfOneFaceStayApart) {
    // All edges are shorter than the distance; diagonals are not.
    const PolygonMesh open = test::without_face(cuboid(), 1);
    const MendedMesh out = mended(open, seams(1.25));
    EXPECT_EQ(out.mesh.face_count(), open.face_count());
    EXPECT_EQ(out.report.joined.size(), 0U);
    ASSERT_EQ(out.report.open.size(), 1U);
    EXPECT_EQ(out.report.open[0].edges, 4U);
    EXPECT_EQ(out.report.open[0].length, 4);
    EXPECT_EQ(out.report.open[0].place[2], 1);
}

TEST(CloseSeams, VerticesInsideTheSurfaceStay) {
    // A closed box beside an open one, nearer than the distance.
    PolygonMesh mesh = cuboid();
    append(mesh, test::without_face(cuboid({1.001, 0, 0}, {2, 1, 1}), 4));
    const MendedMesh out = mended(mesh, seams(0.01));
    EXPECT_TRUE(out.report.joined.empty());
    EXPECT_TRUE(out.report.divided.empty());
    EXPECT_EQ(out.mesh, mesh);
}

// A cube whose lid consists of two halves, with and without a move of the vertices between them.
PolygonMesh with_halved_lid(double move) {
    PolygonMesh mesh = test::without_face(cuboid(), 1);
    for (const double x : {0.5, 0.5}) {
        mesh.points.push_back({x, 0 - move, 1});
        mesh.points.push_back({x, 1, 1 + move});
    }
    mesh.points[10][0] += move;
    mesh.add_face(std::vector<std::uint32_t>{4, 8, 9, 6});
    mesh.add_face(std::vector<std::uint32_t>{10, 5, 7, 11});
    return mesh;
}

TEST(CloseSeams, ZeroClosesExactTJunctions) {
    const PolygonMesh mesh = with_halved_lid(0);
    ASSERT_EQ(validate(mesh).count(DefectKind::TVertex), 6U) << test::findings(mesh);
    const MendedMesh out = mended(mesh, seams(0));
    EXPECT_EQ(out.report.divided.size(), 2U);
    EXPECT_EQ(out.report.max_gap, 0);
    EXPECT_TRUE(out.report.cut_faces.empty());  // they stay planar
    EXPECT_TRUE(validate(out.mesh).empty()) << test::findings(out.mesh);
    EXPECT_EQ(volume_below(out.mesh), ExactRational(1));
    const MendedMesh in_triangles = mended(test::in_triangles(mesh), seams(0));
    EXPECT_TRUE(validate(in_triangles.mesh).empty()) << test::findings(in_triangles.mesh);
    EXPECT_EQ(in_triangles.report.cut_faces.size(), 2U);
    EXPECT_EQ(volume_below(in_triangles.mesh), ExactRational(1));
}

TEST(CloseSeams, TJunctionsWithGaps) {
    const PolygonMesh mesh = with_halved_lid(1e-3);
    ASSERT_GT(validate(mesh).count(DefectKind::OpenEdge), 0U);
    const MendedMesh out = mended(mesh, seams(2e-3));
    EXPECT_EQ(out.report.joined.size(), 1U);
    EXPECT_EQ(out.report.divided.size(), 2U);
    EXPECT_NEAR(out.report.max_gap, 1e-3, 1e-9);
    EXPECT_TRUE(out.report.is_closed());
    EXPECT_TRUE(validate(out.mesh).is_solid()) << test::findings(out.mesh);
    EXPECT_NEAR(volume_below(out.mesh).to_double(), 1, 2e-3);
}

TEST(CloseSeams, StaggeredRows) {
    // Two strips whose vertices along the seam alternate.
    PolygonMesh mesh;
    const auto add = [&](double x, double y) {
        mesh.points.push_back({x, y, 0});
        return static_cast<std::uint32_t>(mesh.points.size() - 1);
    };
    const auto a = add(0, 1), b = add(6, 1), c = add(0, 0), d = add(6, 0);
    const auto p = add(2, 0), q = add(4, 0);
    const auto e = add(0, -1e-4), f = add(6, -1e-4), r = add(1, -1e-4), s = add(3, -1e-4);
    const auto t = add(5, -1e-4), g = add(0, -1), h = add(6, -1);
    mesh.add_face(std::vector<std::uint32_t>{c, p, q, d, b, a});
    mesh.add_face(std::vector<std::uint32_t>{g, h, f, t, s, r, e});
    const MendedMesh out = mended(mesh, seams(1e-3));
    EXPECT_EQ(out.report.joined.size(), 2U);
    EXPECT_EQ(out.report.divided.size(), 5U);
    ASSERT_EQ(out.report.open.size(), 1U);
    EXPECT_EQ(out.report.open[0].edges, 6U);  // around both
}

TEST(CloseSeams, SeamsAreClosedWhateverTheOrientation) {
    PolygonMesh cut = cut_apart(make_uv_sphere(1, 12, 7), 1e-4, 5);
    for (std::size_t f = 0; f < cut.face_count(); ++f)
        if (cut.points[cut.face(f)[0]][2] < 0) test::turn(cut, f);
    MendOptions options = seams(1e-3);
    options.orient_faces = true;
    options.orient_shells = true;
    const MendedMesh out = mended(cut, options);
    EXPECT_TRUE(validate(out.mesh).is_solid()) << test::findings(out.mesh);
}

TEST(CloseSeams, DegenerateFacesThatAriseAreLeftOut) {
    // A triangle between two faces of a seam becomes flat.
    PolygonMesh mesh = test::make_mesh({{0, 0, 0},
                                        {2, 0, 0},
                                        {1, 1, 0},
                                        {1, -1, 0},
                                        {1, 1e-4, 0},
                                        {1, 0, 0},
                                        {1, 0, 5},
                                        {1, 3, 5}},
                                       {{0, 4, 2}, {4, 1, 2}, {0, 3, 1}, {0, 1, 4}, {5, 6, 7}});
    // Vertex 4 is inside the surface: to open it, leave one face out.
    mesh = test::without_face(mesh, 0);
    const MendedMesh out = mended(mesh, seams(1e-3));
    EXPECT_EQ(out.report.joined, (std::vector<JoinedVertex>{{5, 4, 1e-4}}));
    PolygonMesh swapped = mesh;
    std::swap(swapped.points[4], swapped.points[5]);
    const MendedMesh flat = mended(swapped, seams(1e-3));
    EXPECT_EQ(flat.report.degenerate_faces, (std::vector<std::uint32_t>{2}));
}

TEST(CloseSeams, ManyVerticesWithinTheDistanceAreALimit) {
    PolygonMesh soup;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> at(0, 1);
    for (std::uint32_t i = 0; i < 3000; ++i) {
        for (int k = 0; k < 3; ++k) soup.points.push_back({at(random), at(random), at(random)});
        soup.add_triangle(3 * i, 3 * i + 1, 3 * i + 2);
    }
    EXPECT_THROW((void)mended(soup, seams(10)), LimitError);
}

TEST(CloseSeams, DistancesThatMakeNoSense) {
    for (const double d : {-1.0, std::nan(""), HUGE_VAL})
        EXPECT_THROW((void)mended(cuboid(), seams(d)), UsageError);
}

}  // namespace
}  // namespace trisect
