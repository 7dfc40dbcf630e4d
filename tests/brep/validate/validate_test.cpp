// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/validate/validate.h>

#include <random>

#include <gtest/gtest.h>

#include <trisect/brep/contact/triangle_contact.h>
#include <trisect/brep/import_mesh.h>

#include "support/lattice_arithmetic.h"
#include "support/mesh_builders.h"

namespace trisect {
namespace {

using test::cuboid;
using test::make_mesh;
using test::together;

// The report has exactly one kind of defect, this many times.
void expect_only(const ValidationReport& r, DefectKind kind, std::size_t count) {
    EXPECT_EQ(r.count(kind), count) << r.to_string();
    EXPECT_EQ(r.count(Severity::Error) + r.count(Severity::Warning), count) << r.to_string();
    ASSERT_FALSE(r.defects().empty());
    EXPECT_EQ(r.defects()[0].kind, kind);
    EXPECT_FALSE(r.defects()[0].sentence.empty());
}

TEST(Validate, CuboidIsASolid) {
    const auto r = validate(cuboid());
    EXPECT_TRUE(r.empty()) << r.to_string();
    EXPECT_TRUE(r.is_solid());
}

TEST(Validate, EmptyMeshIsASolidButWorthAWarning) {
    const auto r = validate(PolygonMesh{});
    expect_only(r, DefectKind::EmptyMesh, 1);
    EXPECT_TRUE(r.is_solid());
}

TEST(Validate, OpenEdge) {
    const auto r = validate(test::without_face(cuboid(), 1));
    expect_only(r, DefectKind::OpenEdge, 4);
    EXPECT_FALSE(r.is_solid());
    EXPECT_EQ(r.defects()[0].place[2], 1);
    EXPECT_EQ(r.defects()[0].vertices.size(), 2U);
    EXPECT_EQ(r.defects()[0].faces.size(), 1U);
}

TEST(Validate, FlippedFace) {
    auto m = cuboid();
    std::swap(m.corners[1], m.corners[3]);
    const auto r = validate(m);
    expect_only(r, DefectKind::FlippedFace, 4);
}

TEST(Validate, CubesThatShareAnEdge) {
    const auto r = validate(together(cuboid(), cuboid({1, 1, 0}, {2, 2, 1})));
    EXPECT_EQ(r.count(DefectKind::NonManifoldEdge), 1U);
    EXPECT_EQ(r.count(DefectKind::DuplicatePoint), 2U);
    EXPECT_TRUE(r.is_solid()) << r.to_string();
}

TEST(Validate, CubesThatShareACorner) {
    const auto r = validate(together(cuboid(), cuboid({1, 1, 1}, {2, 2, 2})));
    EXPECT_EQ(r.count(DefectKind::NonManifoldVertex), 1U);
    EXPECT_TRUE(r.is_solid()) << r.to_string();
}

TEST(Validate, CornerInsideAnEdge) {
    const auto m = make_mesh({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 4}, {2, 0, 0}},
                             {{3, 2, 1, 5, 0}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 1, 4}});
    const auto r = validate(m);
    EXPECT_EQ(r.count(DefectKind::TVertex), 3U) << r.to_string();
    EXPECT_EQ(r.count(DefectKind::OpenEdge), 0U);
    EXPECT_EQ(r.count(DefectKind::SelfIntersection), 0U) << r.to_string();
    EXPECT_TRUE(r.is_solid());
}

TEST(Validate, RepeatedCornerAndDegenerateFace) {
    auto m = cuboid();
    m.add_face(std::vector<std::uint32_t>{0, 0, 1});
    const auto r = validate(m);
    EXPECT_EQ(r.count(DefectKind::RepeatedCorner), 1U);
    EXPECT_EQ(r.count(DefectKind::DegenerateFace), 1U);
    EXPECT_EQ(r.count(DefectKind::OpenEdge), 0U);
}

TEST(Validate, NonPlanarFace) {
    auto m = cuboid();
    m.points[7][2] = 1.25;
    expect_only(validate(m), DefectKind::NonPlanarFace, 1);
}

TEST(Validate, NonSimpleFace) {
    const auto r =
        validate(make_mesh({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2, 3}}));
    EXPECT_EQ(r.count(DefectKind::NonSimpleFace), 1U);
}

TEST(Validate, DuplicateFace) {
    auto m = cuboid();
    m.add_face(std::vector<std::uint32_t>{5, 7, 6, 4});
    EXPECT_EQ(validate(m).count(DefectKind::DuplicateFace), 1U);
}

TEST(Validate, DuplicateOppositeFacesBetweenGluedCubes) {
    const auto r = validate(together(cuboid(), cuboid({1, 0, 0}, {2, 1, 1})));
    EXPECT_EQ(r.count(DefectKind::DuplicateOppositeFaces), 1U);
    EXPECT_FALSE(r.is_solid());
}

TEST(Validate, UnusedAndDuplicatePoints) {
    auto m = cuboid();
    m.points.push_back({5, 5, 5});
    m.points.push_back({1, 1, 1});
    const auto r = validate(m);
    EXPECT_EQ(r.count(DefectKind::UnusedPoint), 2U);
    EXPECT_EQ(r.count(DefectKind::DuplicatePoint), 1U);
    EXPECT_TRUE(r.is_solid());
}

TEST(Validate, CrossingCuboids) {
    const auto r = validate(together(cuboid({0, 0, 0}, {4, 4, 4}), cuboid({1, 1, 3}, {3, 3, 9})));
    EXPECT_EQ(r.count(DefectKind::SelfIntersection), 4U) << r.to_string();
    EXPECT_EQ(r.defects()[0].place[2], 4);
}

TEST(Validate, CuboidStandingOnAnotherOverlapsInAPlane) {
    const auto r = validate(together(cuboid({0, 0, 0}, {4, 4, 4}), cuboid({1, 1, 4}, {3, 3, 9})));
    EXPECT_GE(r.count(DefectKind::SelfIntersection), 1U);
    EXPECT_NE(r.to_string().find("overlap in their plane"), std::string::npos) << r.to_string();
}

TEST(Validate, CuboidsThatTouchEdgeAcrossEdgeInOnePoint) {
    // Two tetrahedra whose edges cross at the origin.
    const auto a = make_mesh({{-2, 0, 0}, {2, 0, 0}, {0, 2, -2}, {0, -2, -2}},
                             {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3}});
    const auto b = make_mesh({{0, -2, 0}, {0, 2, 0}, {2, 0, 2}, {-2, 0, 2}},
                             {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3}});
    const auto ra = validate(a);
    EXPECT_EQ(ra.count(DefectKind::FlippedFace), 0U);
    const auto r = validate(together(a, b));
    EXPECT_EQ(r.count(DefectKind::FacesTouch), 4U) << r.to_string();
    EXPECT_EQ(r.count(DefectKind::SelfIntersection), 0U) << r.to_string();
}

TEST(Validate, CornerOnAFaceTouches) {
    const auto tetrahedron = make_mesh({{2, 2, 4}, {1, 1, 8}, {3, 1, 8}, {2, 3, 8}},
                                       {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
    // The top is cut along a diagonal that avoids (2, 2).
    auto box = cuboid({0, 0, 0}, {4, 4, 4});
    box.points[7] = {4, 5, 4};
    box.points[3] = {4, 5, 0};
    const auto r = validate(together(box, tetrahedron));
    EXPECT_EQ(r.count(DefectKind::SelfIntersection), 0U) << r.to_string();
    EXPECT_EQ(r.count(DefectKind::FacesTouch), 3U) << r.to_string();
    EXPECT_TRUE(r.is_solid());
}

TEST(Validate, InsideOutShell) {
    expect_only(validate(test::flipped(cuboid())), DefectKind::InsideOutShell, 1);
}

TEST(Validate, CavityIsASolid) {
    const auto r = validate(
        together(cuboid({0, 0, 0}, {9, 9, 9}), test::flipped(cuboid({2, 2, 2}, {5, 5, 5}))));
    EXPECT_TRUE(r.empty()) << r.to_string();
}

TEST(Validate, IslandInACavityIsASolid) {
    const auto shell =
        together(cuboid({0, 0, 0}, {9, 9, 9}), test::flipped(cuboid({2, 2, 2}, {7, 7, 7})));
    const auto r = validate(together(shell, cuboid({3, 3, 3}, {4, 4, 4})));
    EXPECT_TRUE(r.empty()) << r.to_string();
}

TEST(Validate, ShellInsideAnotherWithTheSameOrientation) {
    const auto r = validate(together(cuboid({0, 0, 0}, {9, 9, 9}), cuboid({2, 2, 2}, {5, 5, 5})));
    expect_only(r, DefectKind::ShellNesting, 1);
    EXPECT_EQ(r.defects()[0].faces[0], 6U);
}

TEST(Validate, CavityThatTouchesTheOutsideInACornerIsASolid) {
    auto outer = cuboid({0, 0, 0}, {9, 9, 9});
    // Corner 0 of the cavity is the outer corner itself.
    auto inner = test::flipped(make_mesh({{0, 0, 0}, {5, 4, 4}, {4, 5, 4}, {4, 4, 5}},
                                         {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
    const auto r = validate(together(outer, inner));
    EXPECT_EQ(r.count(DefectKind::NonManifoldVertex), 1U);
    EXPECT_TRUE(r.is_solid()) << r.to_string();
}

TEST(Validate, ShellAmongOthersThatTouchAllOfItsCorners) {
    for (const bool is_flipped : {false, true}) {
        const PolygonMesh middle = cuboid({1, 1, 1}, {2, 2, 2});
        PolygonMesh all = is_flipped ? test::flipped(middle) : middle;
        for (const double x : {0.0, 2.0})
            for (const double y : {0.0, 2.0})
                for (const double z : {0.0, 2.0})
                    all = together(all, cuboid({x, y, z}, {x + 1, y + 1, z + 1}));
        const auto r = validate(all);
        EXPECT_EQ(r.count(DefectKind::InsideOutShell), is_flipped ? 1U : 0U) << r.to_string();
        EXPECT_EQ(r.count(DefectKind::ShellNesting), 0U) << r.to_string();
    }
}

TEST(Validate, ListIsLimitedCountsAreNot) {
    PolygonMesh m;
    for (int i = 0; i < 50; ++i)
        m = together(
            m, make_mesh({{i * 3.0, 0, 0}, {i * 3.0 + 1, 0, 0}, {i * 3.0, 1, 0}}, {{0, 1, 2}}));
    const auto r = validate(m, {.list_limit = 7});
    EXPECT_EQ(r.count(DefectKind::OpenEdge), 150U);
    EXPECT_EQ(r.defects().size(), 7U);
}

TEST(Validate, LimitOfPairsIsAnError) {
    EXPECT_THROW(static_cast<void>(validate(cuboid(), {.pair_limit = 3})), LimitError);
}

TEST(Validate, InvalidSolidCarriesItsReport) {
    const InvalidSolid e(validate(test::without_face(cuboid(), 0)));
    EXPECT_EQ(e.code(), ErrorCode::InvalidSolid);
    EXPECT_EQ(e.report().count(DefectKind::OpenEdge), 4U);
    EXPECT_NE(std::string(e.what()).find("4 open_edge"), std::string::npos) << e.what();
}

TEST(Validate, LatticeMeshGivesTheSameReport) {
    const auto m = together(cuboid({0, 0, 0}, {4, 4, 4}), cuboid({1, 1, 3}, {3, 3, 9}));
    const auto r = validate(import_mesh(m).mesh);
    EXPECT_GE(r.count(DefectKind::SelfIntersection), 4U);
}

// A contact decided by brute force: segments of one against the other by orientation signs of small
// integers.
int det_sign(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint d) {
    a = a - d;
    b = b - d;
    c = c - d;
    const auto v = a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) +
                   a.z * (b.x * c.y - b.y * c.x);
    return v > 0 ? 1 : (v < 0 ? -1 : 0);
}

// Whether p + t (q - p), 0 < t < 1, passes strictly through the inside of the triangle.
bool pierces(LatticePoint p, LatticePoint q, const std::array<LatticePoint, 3>& t) {
    if (det_sign(t[0], t[1], t[2], p) * det_sign(t[0], t[1], t[2], q) >= 0) return false;
    const int a = det_sign(p, q, t[0], t[1]);
    const int b = det_sign(p, q, t[1], t[2]);
    const int c = det_sign(p, q, t[2], t[0]);
    return a != 0 && a == b && b == c;
}

TEST(Validate, EndsAtTheFirstDefectWhereThatIsAskedFor) {
    const auto crossing = together(cuboid({0, 0, 0}, {4, 4, 4}), cuboid({1, 1, 1}, {3, 3, 9}));
    ValidateOptions options;
    const std::size_t all = validate(crossing, options).count(DefectKind::SelfIntersection);
    options.until_first = true;
    EXPECT_GT(all, 1U);
    EXPECT_EQ(validate(crossing, options).count(DefectKind::SelfIntersection), 1U);
    EXPECT_TRUE(validate(cuboid({0, 0, 0}, {4, 4, 4}), options).empty());
}

TEST(TriangleContact, ProperCrossingsAgreeWithOrientationSigns) {
    std::mt19937 random(7);  // NOLINT
    const auto coordinate = [&] { return static_cast<std::int64_t>(random() % 9); };
    int crossings = 0;
    for (int round = 0; round < 20000; ++round) {
        std::vector<LatticePoint> p(6);
        for (auto& q : p) q = {coordinate(), coordinate(), coordinate()};
        if (are_collinear(p[0], p[1], p[2]) || are_collinear(p[3], p[4], p[5])) continue;
        bool equal_corners = false;
        for (int i = 0; i < 3; ++i)
            for (int k = 3; k < 6; ++k)
                equal_corners = equal_corners ||
                                p[static_cast<std::size_t>(i)] == p[static_cast<std::size_t>(k)];
        if (equal_corners) continue;
        const std::array<LatticePoint, 3> a{p[0], p[1], p[2]};
        const std::array<LatticePoint, 3> b{p[3], p[4], p[5]};
        bool proper = false;
        for (std::size_t i = 0; i < 3; ++i)
            proper = proper || pierces(a[i], a[(i + 1) % 3], b) || pierces(b[i], b[(i + 1) % 3], a);
        const auto contact = detail::find_contact(p, {0, 1, 2}, {3, 4, 5});
        if (proper) {
            EXPECT_EQ(contact.kind, detail::ContactKind::Cross);
            ++crossings;
        }
        // Symmetric, also under renaming of corners.
        const auto swapped = detail::find_contact(p, {5, 3, 4}, {1, 0, 2});
        EXPECT_EQ(contact.kind, swapped.kind);
        if (contact.kind != detail::ContactKind::None) {
            EXPECT_EQ(side_of(contact.witness, Plane::through(a[0], a[1], a[2])), Side::On);
            EXPECT_EQ(side_of(contact.witness, Plane::through(b[0], b[1], b[2])), Side::On);
        }
    }
    EXPECT_GT(crossings, 1000);
}

TEST(TriangleContact, NeighboursOverAnEdgeFoldedOntoEachOther) {
    const std::vector<LatticePoint> p{{0, 0, 0}, {4, 0, 0},  {0, 4, 0},
                                      {1, 1, 0}, {2, -3, 0}, {1, 1, 5}};
    EXPECT_EQ(detail::find_contact(p, {0, 1, 2}, {1, 0, 3}).kind, detail::ContactKind::Overlap);
    EXPECT_EQ(detail::find_contact(p, {0, 1, 2}, {1, 0, 4}).kind, detail::ContactKind::None);
    EXPECT_EQ(detail::find_contact(p, {0, 1, 2}, {1, 0, 5}).kind, detail::ContactKind::None);
}

TEST(TriangleContact, NeighboursInACornerThatCrossBeyondIt) {
    const std::vector<LatticePoint> p{{0, 0, 0}, {4, 0, 0}, {0, 4, 0},    {2, 2, 3},  {2, 2, -3},
                                      {2, 1, 3}, {9, 9, 9}, {-2, -2, -3}, {-2, -2, 3}};
    EXPECT_EQ(detail::find_contact(p, {0, 1, 2}, {0, 3, 4}).kind, detail::ContactKind::Cross);
    EXPECT_EQ(detail::find_contact(p, {0, 1, 2}, {0, 5, 6}).kind, detail::ContactKind::None);
    EXPECT_EQ(detail::find_contact(p, {0, 1, 2}, {0, 7, 8}).kind, detail::ContactKind::None);
}

TEST(TriangleContact, CollinearEdgesThatShareACornerTouch) {
    const std::vector<LatticePoint> p{{0, 0, 0}, {4, 0, 0}, {0, 4, 0},
                                      {2, 0, 0}, {1, 0, 5}, {1, -3, 0}};
    EXPECT_EQ(detail::find_contact(p, {0, 1, 2}, {0, 3, 4}).kind, detail::ContactKind::Touch);
    EXPECT_EQ(detail::find_contact(p, {0, 1, 2}, {0, 3, 5}).kind, detail::ContactKind::Touch);
}

}  // namespace
}  // namespace trisect
