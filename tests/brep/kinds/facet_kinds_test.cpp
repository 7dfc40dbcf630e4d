// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/kinds/facet_kinds.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/sphere.h>

#include "support/mesh_builders.h"

namespace {

using trisect::PolygonMesh;
using trisect::detail::FacetKind;
using trisect::test::cuboid;
using trisect::test::flipped;
using trisect::test::together;

// How many facets are plain, hidden, and meet others; {} where kinds are not found.
using Counts = std::array<std::ptrdiff_t, 3>;
Counts counts(const PolygonMesh& mesh) {
    const auto kinds = trisect::detail::facet_kinds(trisect::import_mesh(mesh).mesh);
    if (!kinds) return {};
    return {std::ranges::count(*kinds, FacetKind::Plain),
            std::ranges::count(*kinds, FacetKind::Hidden),
            std::ranges::count(*kinds, FacetKind::Meets)};
}

PolygonMesh ball(double radius, double at) {
    PolygonMesh mesh = trisect::make_icosphere(radius, 3);
    for (auto& p : mesh.points) p[0] += at;
    return mesh;
}

TEST(FacetKinds, AnEmbeddedMeshIsPlain) {
    EXPECT_EQ(counts(ball(1, 0)), (Counts{1280, 0, 0}));
    EXPECT_EQ(counts(together(ball(2, 0), flipped(ball(1, 0)))), (Counts{2560, 0, 0}));
    EXPECT_EQ(counts(together(ball(1, 0), ball(1, 5))), (Counts{2560, 0, 0}));
}

TEST(FacetKinds, AShellWithinAnotherOneIsHidden) {
    EXPECT_EQ(counts(together(ball(2, 0), ball(1, 0))), (Counts{1280, 1280, 0}));
    // -1 within, under the positive rule as little inside as 0.
    EXPECT_EQ(counts(together(ball(1, 0), flipped(ball(0.5, 4)))), (Counts{1280, 1280, 0}));
}

// Found by fuzzing programs: nothing told these from neighbours, and a set without points had a
// mesh.
TEST(FacetKinds, TwoTrianglesOfEqualCornersMeet) {
    PolygonMesh mesh = together(ball(1, 0), ball(1, 5));
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {{9, 0, 0}, {9, 1, 0}, {9, 0, 1}});
    mesh.add_triangle(first, first + 1, first + 2);
    mesh.add_triangle(first + 2, first + 1, first);
    EXPECT_EQ(counts(mesh), (Counts{2560, 0, 2}));
}

TEST(FacetKinds, ShellsThatCrossHideWhatLiesInTheOther) {
    const auto [plain, hidden, meets] = counts(together(ball(1, 0), ball(1, 1)));
    EXPECT_GT(plain, 1700);
    EXPECT_GT(hidden, 450);
    EXPECT_GT(meets, 50);
    EXPECT_LT(meets, 300);
    EXPECT_EQ(plain + hidden + meets, 2560);
}

TEST(FacetKinds, ShellsThatTouchInAnEdgeOrACornerMeetThere) {
    const PolygonMesh far = ball(1, 8);  // else most facets meet others
    EXPECT_EQ(counts(together(far, together(cuboid(), cuboid({1, 1, 0}, {2, 2, 1}))))[1], 0);
    EXPECT_GE(counts(together(far, together(cuboid(), cuboid({1, 1, 0}, {2, 2, 1}))))[2], 8);
    EXPECT_GE(counts(together(far, together(cuboid(), cuboid({1, 1, 1}, {2, 2, 2}))))[2], 6);
    EXPECT_GE(counts(together(far, together(cuboid(), cuboid({1, 0, 0}, {2, 1, 1}))))[2], 4);
}

TEST(FacetKinds, NotFoundWhereMostFacetsMeetOthers) {
    EXPECT_EQ(counts(together(cuboid(), cuboid())), Counts{});
}

}  // namespace
