// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <array>
#include <type_traits>
#include <utility>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/query_oracle.h"
#include "support/random_result.h"

namespace {

using trisect::BrepIndex;
using trisect::EdgeId;
using trisect::FaceId;
using trisect::HalfedgeId;
using trisect::Location;
using trisect::Place;
using trisect::Point;
using trisect::Solid;
using trisect::VertexId;

bool contains(const trisect::IndexCell& cell, const Point& p) {
    const auto& a = p.approximation();
    for (std::size_t k = 0; k < 3; ++k)
        if (a.c[k] < cell.lo[k] - a.error || a.c[k] > cell.hi[k] + a.error) return false;
    return true;
}

// From every entity to a place and back.
void expect_round_trips(const BrepIndex& index, std::uint64_t seed) {
    const trisect::Brep& b = index.brep();
    for (const VertexId v : b.vertices()) {
        const Place place = index.locate(b.point(v));
        ASSERT_EQ(place.location, Location::OnVertex) << "seed " << seed;
        const auto copies = b.copies(v);
        EXPECT_EQ(place.vertex,
                  copies.empty() ? v : *std::min_element(copies.begin(), copies.end()))
            << "seed " << seed;
        const auto cells = index.cells(v);
        ASSERT_FALSE(cells.empty());
        for (const auto& c : cells) EXPECT_TRUE(contains(c, b.point(v)));
    }
    // The middle of an edge, as doubles when its ends are on the lattice.
    for (const EdgeId e : b.edges()) {
        const HalfedgeId h = b.halfedge(e);
        EXPECT_FALSE(index.cells(e).empty());
        const Point& p = b.point(b.origin(h));
        const Point& q = b.point(b.target(h));
        if (!p.is_lattice() || !q.is_lattice()) continue;
        std::array<double, 3> middle{};
        for (std::size_t k = 0; k < 3; ++k)
            middle[k] = 0.5 * (p.approximation().c[k] + q.approximation().c[k]);
        const Place place = index.locate(middle);
        // Another part of the boundary may touch the edge there.
        if (place.location == Location::OnVertex) continue;
        ASSERT_EQ(place.location, Location::OnEdge) << "seed " << seed;
        const auto copies = b.copies(e);
        EXPECT_EQ(place.edge, copies.empty() ? e : *std::min_element(copies.begin(), copies.end()))
            << "seed " << seed;
    }
    for (const FaceId f : b.faces()) EXPECT_FALSE(index.cells(f).empty());
}

// A face's handle names a face whose plane holds the point and whose source is among the names.
void expect_faces(const BrepIndex& index, const trisect::LatticeMesh& mesh, std::uint64_t seed) {
    brute::PointMaker make(mesh, seed);
    for (int i = 0; i < 60; ++i) {
        const std::array<double, 3> p = i % 2 == 0 ? make.on_face() : make.any();
        const Place place = index.locate(p);
        EXPECT_EQ(place.face.is_valid(), place.location == Location::OnFace);
        if (!place.face.is_valid()) continue;
        const trisect::Plane& plane = index.brep().plane(place.face);
        brute::Rational value = brute::rational(trisect::ExactRational(plane.offset()));
        for (int k = 0; k < 3; ++k)
            value += brute::rational(trisect::ExactRational(plane.normal(k))) *
                     brute::Rational(p[static_cast<std::size_t>(k)]);
        EXPECT_EQ(value, 0) << "seed " << seed;
        const auto box = index.in_box(p, p);
        EXPECT_EQ(box.face_ids, std::vector{place.face}) << "seed " << seed;
        EXPECT_TRUE(box.edge_ids.empty());
        EXPECT_TRUE(box.vertex_ids.empty());
    }
}

TEST(BrepIndex, MovedFromIsThatOfTheEmptySet) {
    static_assert(std::is_nothrow_move_constructible_v<BrepIndex>);
    BrepIndex index(trisect::evaluate(~Solid()));
    const BrepIndex taken = std::move(index);
    // NOLINTNEXTLINE(bugprone-use-after-move): that is the test
    EXPECT_EQ(index.locate(std::array{1.0, 2.0, 3.0}).location, Location::Outside);
    EXPECT_TRUE(index.solid().is_empty());
    EXPECT_FALSE(index.has_brep());
    EXPECT_TRUE(index.with_brep().brep().is_empty());
    EXPECT_FALSE(index.nearest({1, 2, 3}).has_value());
    EXPECT_EQ(index.stats().polygons, 0U);
    index.refine();
    EXPECT_EQ(taken.locate(std::array{1.0, 2.0, 3.0}).location, Location::Inside);
}

TEST(Handles, OfFreshMeshesOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        reference::Random random(seed);
        const auto mesh = engines::lattice_mesh(reference::random_embedded_solid(random));
        const BrepIndex index = BrepIndex(Solid::from_lattice_mesh(mesh)).with_brep();
        expect_round_trips(index, seed);
        expect_faces(index, mesh, seed);
    }
}

TEST(Handles, OfResultsOfBooleansOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const brute::RandomResult result = brute::random_result(seed, 2, false);
        const BrepIndex index = BrepIndex(result.solid).with_brep();
        expect_round_trips(index, seed);
        expect_faces(index, result.mesh, seed);
    }
}

TEST(Handles, BoxesListWhatTheyTouch) {
    const BrepIndex index =
        BrepIndex(engines::solid(reference::box({0, 0, 0}, {4, 4, 4}), trisect::Embedding::Assume))
            .with_brep();
    EXPECT_EQ(index.in_box({-1, -1, -1}, {5, 5, 5}).vertex_ids.size(), 8U);
    EXPECT_EQ(index.in_box({-1, -1, -1}, {5, 5, 5}).edge_ids.size(), 12U);
    EXPECT_TRUE(index.in_box({1, 1, 1}, {3, 3, 3}).faces.empty());
    EXPECT_EQ(index.in_box({1, 1, 4}, {3, 3, 9}).face_ids.size(), 1U);
    EXPECT_EQ(index.in_box({4, 4, 1}, {5, 5, 2}).edge_ids.size(), 1U);
    EXPECT_EQ(index.in_box({4, 4, 1}, {5, 5, 2}).face_ids.size(), 2U);
}

}  // namespace
