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
using trisect::Place;
using trisect::Solid;

// A point moved onto a splitter of the cell that it is in.
std::array<double, 3> onto_wall(const BrepIndex& index, std::array<double, 3> p,
                                reference::Random& random) {
    const trisect::IndexCell cell = index.cell_at(p);
    const std::size_t k = random.below(3);
    const double splitter = random.chance(1, 2) ? cell.lo[k] : cell.hi[k];
    if (std::abs(splitter) < 1e15) p[k] = splitter;
    return p;
}

void expect_agreement(const BrepIndex& index, const brute::Boundary& boundary,
                      const trisect::LatticeMesh& mesh, bool named, std::uint64_t seed, int count) {
    brute::PointMaker make(mesh, seed);
    for (int i = 0; i < count; ++i) {
        std::array<double, 3> p = make.any();
        if (i % 8 == 0) p = onto_wall(index, p, make.random());
        const Place place = index.locate(p);
        const brute::Answer answer = boundary.locate(brute::point(p));
        ASSERT_TRUE(brute::agrees(place, answer, named))
            << "seed " << seed << " point " << p[0] << " " << p[1] << " " << p[2] << ": "
            << brute::to_string(place) << " instead of " << brute::to_string(answer);
    }
}

TEST(Locate, FreshMeshesOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        reference::Random random(seed);
        const auto mesh = engines::lattice_mesh(reference::random_embedded_solid(random));
        const Solid solid = Solid::from_lattice_mesh(mesh);
        const BrepIndex index(solid);
        expect_agreement(index, brute::Boundary::of_mesh(mesh, solid.source_id()), mesh, true, seed,
                         150);
    }
}

TEST(Locate, ResultsOfBooleansOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const brute::RandomResult result = brute::random_result(seed, 3, true);
        expect_agreement(BrepIndex(result.solid), result.boundary, result.mesh, false, seed, 150);
    }
}

}  // namespace
