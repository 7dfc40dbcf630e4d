// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/import_mesh.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <trisect/brep/face/loop_triangulator.h>
#include <trisect/brep/validate/validate.h>

#include "support/lattice_arithmetic.h"
#include "support/mesh_builders.h"

namespace trisect {
namespace {

using test::cuboid;
using test::make_mesh;

// Six times the volume in lattice units.
double volume6(const LatticeMesh& m) {
    double v = 0;
    for (const auto& t : m.triangles) {
        const auto a = m.points[t[0]], b = m.points[t[1]], c = m.points[t[2]];
        v += static_cast<double>(a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
                                 a.z * (b.x * c.y - b.y * c.x));
    }
    return v;
}

TEST(ImportMesh, CornersThatRoundBeyondTheLargestDoubleAreRefused) {
    PolygonMesh mesh = cuboid({0, 0, 0}, {1, 1, 1});
    const auto scale = [&](double size) {
        for (Point3d& p : mesh.points)
            for (double& c : p) c = c == 0 ? 0 : size;
    };
    scale(std::numeric_limits<double>::max());
    const auto message = [&](const auto& work) -> std::string {
        try {
            work();
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::InvalidSolid);
            return e.what();
        }
        return "accepted";
    };
    const std::string vertex = "vertex 1: coordinate 1.7976931348623157e+308 ";
    const Lattice lattice{984};
    EXPECT_TRUE(
        message([&] { (void)import_mesh(mesh, {.lattice = lattice}); }).starts_with(vertex));
    EXPECT_TRUE(message([&] { (void)validate(mesh, {.lattice = lattice}); }).starts_with(vertex));
    scale(1.7e308);
    EXPECT_EQ(message([&] { (void)import_mesh(mesh, {.lattice = lattice}); }), "accepted");
    EXPECT_EQ(message([&] { (void)validate(mesh, {.lattice = lattice}); }), "accepted");
}

TEST(ImportMesh, CuboidOfQuadrilaterals) {
    const auto r = import_mesh(cuboid());
    EXPECT_EQ(r.mesh.triangles.size(), 12U);
    EXPECT_EQ(r.mesh.points.size(), 8U);
    EXPECT_TRUE(r.report.closed);
    EXPECT_FALSE(r.report.inside_out);
    EXPECT_TRUE(r.report.lattice.lossless);
    EXPECT_EQ(r.mesh.lattice.exponent, 0);
    EXPECT_EQ(volume6(r.mesh), 6);
    for (std::uint32_t t = 0; t < 12; ++t) EXPECT_EQ(r.mesh.face_of(t), t / 2);
    EXPECT_TRUE(r.report.defects.empty());
}

TEST(ImportMesh, TriangleMeshNeedsNoFaceTable) {
    const auto r = import_mesh(make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                         {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
    EXPECT_TRUE(r.mesh.face_of_triangle.empty());
    EXPECT_EQ(volume6(r.mesh), 1);
}

TEST(ImportMesh, EmptyMeshIsClosed) {
    const auto r = import_mesh(PolygonMesh{});
    EXPECT_TRUE(r.report.closed);
    EXPECT_FALSE(r.report.inside_out);
    EXPECT_TRUE(r.mesh.triangles.empty());
}

TEST(ImportMesh, InsideOutIsReportedAndNotRepaired) {
    const auto r = import_mesh(test::flipped(cuboid()));
    EXPECT_TRUE(r.report.inside_out);
    EXPECT_EQ(volume6(r.mesh), -6);
}

TEST(ImportMesh, SoupConnectsByValueNegativeZeroIncluded) {
    PolygonMesh soup;
    const auto box = cuboid();
    for (std::size_t f = 0; f < box.face_count(); ++f) {
        const auto begin = static_cast<std::uint32_t>(soup.points.size());
        for (const auto c : box.face(f)) {
            auto p = box.points[c];
            if (f % 2 == 0)
                for (double& v : p)
                    if (v == 0) v = -0.0;
            soup.points.push_back(p);
        }
        soup.add_face(std::vector<std::uint32_t>{begin, begin + 1, begin + 2, begin + 3});
    }
    const auto r = import_mesh(soup);
    EXPECT_EQ(r.report.welded_points, 16U);
    EXPECT_EQ(r.mesh.points.size(), 8U);
}

TEST(ImportMesh, MissingFaceIsRefusedWithItsEdges) {
    const auto open = test::without_face(cuboid(), 1);
    try {
        static_cast<void>(import_mesh(open));
        FAIL();
    } catch (const InvalidSolid& e) {
        EXPECT_EQ(e.code(), ErrorCode::InvalidSolid);
        EXPECT_EQ(e.report().count(DefectKind::OpenEdge), 4U);
        EXPECT_NE(std::string(e.what()).find("(0, 0, 1)"), std::string::npos) << e.what();
    }
    const auto r = import_mesh(open, {.require_closed = false});
    EXPECT_FALSE(r.report.closed);
    EXPECT_EQ(r.report.defects.count(DefectKind::OpenEdge), 4U);
}

TEST(ImportMesh, PointsOfNoTriangleAreLeftOut) {
    auto m = cuboid();
    m.points.insert(m.points.begin(), {7, 7, 7});
    for (auto& c : m.corners) ++c;
    const auto r = import_mesh(m);
    EXPECT_EQ(r.mesh.points.size(), 8U);
    EXPECT_EQ(volume6(r.mesh), 6);
}

// A square pyramid whose base has a corner 5 in the middle of a side.
PolygonMesh pyramid(std::vector<std::uint32_t> side_with_middle, bool with_sliver) {
    auto m = make_mesh({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 4}, {2, 0, 0}},
                       {{3, 2, 1, 5, 0}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    m.add_face(side_with_middle);
    if (with_sliver) m.add_triangle(0, 5, 1);
    return m;
}

TEST(ImportMesh, CornerInsideAnEdgeIsClosedAsChains) {
    const auto r = import_mesh(pyramid({0, 1, 4}, false));
    EXPECT_TRUE(r.report.closed);
    EXPECT_EQ(r.report.t_edges, 3U);
    EXPECT_EQ(volume6(r.mesh), 6 * 64.0 / 3);
}

TEST(ImportMesh, TriangleWithoutAreaMayCloseTheNames) {
    const auto r = import_mesh(pyramid({0, 1, 4}, true));
    EXPECT_TRUE(r.report.closed);
    // It is dropped, and the corner lies inside the side of its neighbour.
    EXPECT_EQ(r.report.t_edges, 3U);
    EXPECT_EQ(r.report.degenerate_faces_dropped, 1U);
    EXPECT_EQ(r.report.defects.count(DefectKind::DegenerateFace), 1U);
}

TEST(ImportMesh, CornerInsideASideOfThePolygonKeepsAllTrianglesProper) {
    const auto r = import_mesh(pyramid({0, 5, 1, 4}, false));
    EXPECT_EQ(r.report.t_edges, 0U);
    EXPECT_EQ(r.mesh.triangles.size(), 3U + 2U + 3U);
}

TEST(ImportMesh, PartialOverlapOfCollinearEdgesIsOpen) {
    auto m = pyramid({0, 1, 4}, false);
    m.points[5] = {2, -1, 0};  // off the line now
    EXPECT_THROW(static_cast<void>(import_mesh(m)), InvalidSolid);
}

PolygonMesh cuboid_with_lifted_corner(double lift) {
    auto m = cuboid();
    m.points[7][2] += lift;
    return m;
}

TEST(ImportMesh, NonplanarFacesAreCutAndCounted) {
    const auto r = import_mesh(cuboid_with_lifted_corner(0.25));
    EXPECT_EQ(r.report.nonplanar_faces, 1U);
    EXPECT_EQ(r.report.defects.count(DefectKind::NonPlanarFace), 1U);
    EXPECT_TRUE(r.report.closed);
}

TEST(ImportMesh, NonplanarFaceIsRefusedByName) {
    try {
        static_cast<void>(
            import_mesh(cuboid_with_lifted_corner(0.25), {.nonplanar = NonplanarPolicy::Refuse}));
        FAIL();
    } catch (const InvalidSolid& e) {
        EXPECT_NE(std::string(e.what()).find("face 1 at"), std::string::npos) << e.what();
    }
}

TEST(ImportMesh, RefitLevelsAnAxisAlignedFaceWithinTheAllowedMove) {
    const auto m = cuboid_with_lifted_corner(0x1p-8);
    const auto r = import_mesh(
        m, {.nonplanar = NonplanarPolicy::Refit, .refit_move = 0x1p-9, .lattice = Lattice{-16}});
    EXPECT_EQ(r.report.refitted_faces, 1U);
    EXPECT_EQ(r.report.nonplanar_faces, 0U);
    EXPECT_EQ(r.report.max_refit_move, 0x1p-9);
    EXPECT_THROW(static_cast<void>(import_mesh(m, {.nonplanar = NonplanarPolicy::Refit,
                                                   .refit_move = 0x1p-10,
                                                   .lattice = Lattice{-16}})),
                 UnsupportedError);
}

TEST(ImportMesh, RoundingToACoarseLatticeIsReported) {
    auto m = cuboid();
    m.points[7] = {1.25, 1, 1};
    m.points[5] = {1.25, 0, 1};
    const auto r = import_mesh(m, {.lattice = Lattice{0}});
    EXPECT_FALSE(r.report.lattice.lossless);
    EXPECT_EQ(r.report.lattice.moved, 2U);
    EXPECT_EQ(r.report.lattice.max_move, 0.25);
    EXPECT_EQ(r.report.lattice.flipped_faces, 0U);
}

TEST(ImportMesh, FacesThatRoundingFlattensAreCounted) {
    const auto r = import_mesh(cuboid({0, 0, 0}, {1, 1, 0.25}), {.lattice = Lattice{0}});
    EXPECT_EQ(r.report.lattice.flipped_faces, 4U);
    EXPECT_EQ(r.report.degenerate_faces_dropped, 4U);
    EXPECT_TRUE(r.report.closed);
}

TEST(ImportMesh, ConcavePolygonIsCutInsideIt) {
    // An L with a corner in the middle of a side, extruded.
    PolygonMesh m;
    const std::vector<std::array<double, 2>> l{{0, 0}, {2, 0}, {4, 0}, {4, 1},
                                               {1, 1}, {1, 3}, {0, 3}};
    const auto n = static_cast<std::uint32_t>(l.size());
    for (const double z : {0.0, 2.0})
        for (const auto& p : l) m.points.push_back({p[0], p[1], z});
    std::vector<std::uint32_t> top, bottom;
    for (std::uint32_t i = 0; i < n; ++i) {
        top.push_back(n + i);
        bottom.push_back(n - 1 - i);
        const std::uint32_t j = (i + 1) % n;
        m.add_face(std::vector<std::uint32_t>{i, j, n + j, n + i});
    }
    m.add_face(top);
    m.add_face(bottom);
    const auto r = import_mesh(m);
    EXPECT_EQ(volume6(r.mesh), 6 * 2 * 6);
    EXPECT_EQ(r.mesh.triangles.size(), 2 * (7U - 2U) + 14U);
    EXPECT_EQ(r.report.t_edges, 0U);
    EXPECT_TRUE(r.report.defects.empty());
}

TEST(ImportMesh, CrossingLoopIsReportedAndKeepsItsChain) {
    // A bow tie on top of its own mirrored copy: closed, without volume.
    const auto m =
        make_mesh({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2, 3}, {3, 2, 1, 0}});
    const auto r = import_mesh(m);
    EXPECT_TRUE(r.report.closed);
    EXPECT_EQ(r.report.defects.count(DefectKind::NonSimpleFace), 2U);
}

// A loop of left turns that runs around twice is not convex, wherever it starts.
TEST(ImportMesh, LoopOfLeftTurnsThatWindsTwiceKeepsItsChain) {
    std::vector<LatticePoint> points;
    for (int i = 0; i < 60; ++i) {
        const double angle = 2 * std::numbers::pi * 2 * (i + 0.5) / 60;
        const double r = 1e6 * (2 + 0.01 * i);
        points.push_back({std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle)), 7});
    }
    const auto doubled_area = [&](std::span<const std::uint32_t> loop) {
        std::int64_t sum = 0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const LatticePoint& a = points[loop[i]];
            const LatticePoint& b = points[loop[(i + 1) % loop.size()]];
            sum += a.x * b.y - a.y * b.x;
        }
        return sum;
    };
    std::vector<std::uint32_t> loop(points.size());
    std::iota(loop.begin(), loop.end(), 0U);
    for (std::size_t start = 0; start < loop.size(); ++start) {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        EXPECT_TRUE(detail::LoopTriangulator(points).triangulate(loop, triangles).planar);
        std::int64_t sum = 0;
        for (const auto& t : triangles) sum += doubled_area(t);
        EXPECT_EQ(sum, doubled_area(loop));
        std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    }
}

TEST(ImportMesh, RepeatedCornersAndTwoCornerFacesBoundNothing) {
    auto m = cuboid();
    m.add_face(std::vector<std::uint32_t>{0, 0, 1, 1});
    m.add_face(std::vector<std::uint32_t>{2, 2, 2});
    m.add_face(std::vector<std::uint32_t>{});
    const auto r = import_mesh(m);
    EXPECT_EQ(r.report.degenerate_faces_dropped, 3U);
    EXPECT_EQ(r.mesh.triangles.size(), 12U);
}

TEST(ImportMesh, HostileIndicesAndCoordinatesAreRefused) {
    auto m = cuboid();
    m.corners[3] = 8;
    EXPECT_THROW(static_cast<void>(import_mesh(m)), UsageError);
    m = cuboid();
    m.face_begin[2] = 3;
    EXPECT_THROW(static_cast<void>(import_mesh(m)), UsageError);
    m = cuboid();
    m.face_begin.clear();
    EXPECT_THROW(static_cast<void>(import_mesh(m)), UsageError);
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        m = cuboid();
        m.points[2][1] = bad;
        EXPECT_THROW(static_cast<void>(import_mesh(m)), LimitError);
    }
}

TEST(ImportMesh, AFaceOfMoreCornersThanSupportedIsAnError) {
    PolygonMesh m;
    std::vector<std::uint32_t> parabola((std::size_t{1} << 17) + 1);
    for (std::size_t i = 0; i < parabola.size(); ++i) {
        const auto x = static_cast<double>(i);
        parabola[i] = static_cast<std::uint32_t>(i);
        m.points.push_back({x, x * x, 0});
    }
    m.add_face(parabola);
    EXPECT_THROW(static_cast<void>(import_mesh(m)), LimitError);
}

TEST(ImportMesh, FullRangeOfCoordinates) {
    const double big = 0x1p53 - 1;
    const auto r =
        import_mesh(cuboid({-big, -big, -big}, {big, big, big}), {.lattice = Lattice{0}});
    EXPECT_TRUE(r.report.closed);
    EXPECT_FALSE(r.report.inside_out);
    EXPECT_EQ(r.mesh.triangles.size(), 12U);
}

TEST(ImportMesh, SignOfATinyVolumeFarOutIsExact) {
    const double o = 0x1p52;
    auto m =
        make_mesh({{o, o, o}, {o + 1, o + 2, o + 3}, {o + 2, o + 3, o + 5}, {o - 9, o + 7, o + 1}},
                  {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    const auto r = import_mesh(m, {.lattice = Lattice{0}});
    const auto s = import_mesh(test::flipped(m), {.lattice = Lattice{0}});
    EXPECT_NE(r.report.inside_out, s.report.inside_out);
}

TEST(ImportMesh, StarPolygonsWithManyReflexCornersKeepTheirArea) {
    std::mt19937 random(20240611);  // NOLINT
    for (int round = 0; round < 50; ++round) {
        const std::uint32_t n = 5 + static_cast<std::uint32_t>(random() % 40);
        PolygonMesh m;
        long long area2 = 0;
        std::vector<std::array<long long, 2>> p;
        for (std::uint32_t i = 0; i < n; ++i) {
            const double angle = 6.283185307179586 * i / n;
            const double radius = 1000.0 * static_cast<double>(1 + random() % 9);
            p.push_back(
                {std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle))});
        }
        std::vector<std::uint32_t> top, bottom;
        for (std::uint32_t i = 0; i < n; ++i) {
            const auto& a = p[i];
            const auto& b = p[(i + 1) % n];
            area2 += a[0] * b[1] - a[1] * b[0];
            top.push_back(n + i);
            bottom.push_back(n - 1 - i);
        }
        for (const double z : {0.0, 1.0})
            for (const auto& q : p)
                m.points.push_back({static_cast<double>(q[0]), static_cast<double>(q[1]), z});
        m.add_face(top);
        m.add_face(bottom);
        for (std::uint32_t i = 0; i < n; ++i)
            m.add_face(std::vector<std::uint32_t>{i, (i + 1) % n, n + (i + 1) % n, n + i});
        const auto r = import_mesh(m);
        EXPECT_EQ(r.mesh.triangles.size(), 2 * (n - 2) + 2 * n);
        EXPECT_EQ(volume6(r.mesh), static_cast<double>(3 * area2));
        EXPECT_TRUE(r.report.defects.empty()) << r.report.defects.to_string();
        for (std::size_t t = 0; t < n - 2; ++t) {
            const auto& tri = r.mesh.triangles[t];
            const auto u = r.mesh.points[tri[1]] - r.mesh.points[tri[0]];
            const auto v = r.mesh.points[tri[2]] - r.mesh.points[tri[0]];
            EXPECT_GT(u.x * v.y - u.y * v.x, 0);
        }
    }
}

}  // namespace
}  // namespace trisect
