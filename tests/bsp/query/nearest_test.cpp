// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/query_oracle.h"
#include "support/random_result.h"

namespace {

using trisect::BrepIndex;
using trisect::Location;
using trisect::Nearest;
using trisect::Solid;

brute::Point3 exact(const Nearest& n) {
    return {brute::rational(n.point[0]), brute::rational(n.point[1]), brute::rational(n.point[2])};
}

brute::Rational squared(const brute::Point3& a, const brute::Point3& b) {
    brute::Rational sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

void expect_agreement(const BrepIndex& index, const brute::Boundary& boundary,
                      const trisect::LatticeMesh& mesh, bool named, std::uint64_t seed) {
    brute::PointMaker make(mesh, seed);
    for (int i = 0; i < 30; ++i) {
        const std::array<double, 3> p = make.any();
        const auto expected = boundary.squared_distance(brute::point(p));
        const auto found = index.nearest(p);
        ASSERT_EQ(found.has_value(), expected.has_value());
        if (!found) continue;
        ASSERT_EQ(brute::rational(found->squared_distance), *expected) << "seed " << seed;
        EXPECT_EQ(squared(exact(*found), brute::point(p)), *expected);
        EXPECT_TRUE(brute::agrees(found->place, boundary.locate(exact(*found)), named));
        const auto edge = index.nearest_edge(p);
        const auto vertex = index.nearest_vertex(p);
        ASSERT_TRUE(edge && vertex);
        EXPECT_LE(found->squared_distance, edge->squared_distance);
        EXPECT_LE(edge->squared_distance, vertex->squared_distance);
        EXPECT_NE(boundary.locate(exact(*edge)).location, Location::OnFace);
        EXPECT_EQ(boundary.locate(exact(*vertex)).location, Location::OnVertex);
        const auto distance = index.signed_distance(p);
        const Location l = boundary.locate(brute::point(p)).location;
        EXPECT_EQ(distance->sign, l == Location::Outside ? 1 : (l == Location::Inside ? -1 : 0));
    }
}

TEST(Nearest, FreshMeshesOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        reference::Random random(seed);
        const auto mesh = engines::lattice_mesh(reference::random_embedded_solid(random));
        const Solid solid = Solid::from_lattice_mesh(mesh);
        expect_agreement(BrepIndex(solid), brute::Boundary::of_mesh(mesh, solid.source_id()), mesh,
                         true, seed);
    }
}

TEST(Nearest, ResultsOfBooleansOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const brute::RandomResult result = brute::random_result(seed, 2, false);
        expect_agreement(BrepIndex(result.solid), result.boundary, result.mesh, false, seed);
    }
}

TEST(Nearest, OfACubeNamesFaceEdgeAndVertex) {
    const BrepIndex index =
        BrepIndex(engines::solid(reference::box({0, 0, 0}, {4, 4, 4}), trisect::Embedding::Assume))
            .with_brep();
    const auto face = index.nearest({2, 2, 7});
    EXPECT_EQ(face->place.location, Location::OnFace);
    EXPECT_TRUE(face->place.face.is_valid());
    EXPECT_EQ(face->distance, 3);
    const auto edge = index.nearest({2, 7, 8});
    EXPECT_EQ(edge->place.location, Location::OnEdge);
    EXPECT_TRUE(edge->place.edge.is_valid());
    EXPECT_EQ(edge->distance, 5);
    const auto vertex = index.nearest({5, 5, 5});
    EXPECT_EQ(vertex->place.location, Location::OnVertex);
    EXPECT_TRUE(vertex->place.vertex.is_valid());
    EXPECT_EQ(vertex->squared_rounded, 3);
    EXPECT_EQ(index.nearest_vertex({1, 1, 1})->squared_rounded, 3);
    EXPECT_EQ(index.nearest_edge({1, 1, 2})->squared_rounded, 2);
    EXPECT_EQ(index.signed_distance({1, 2, 2})->distance(), -1);
    EXPECT_FALSE(BrepIndex(Solid()).nearest({0, 0, 0}));
}

}  // namespace
