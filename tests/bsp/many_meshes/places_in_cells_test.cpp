// SPDX-License-Identifier: Apache-2.0
//
// Facets by cells of a grid (places_in_cells.h), against comparing all with all.

#include <trisect/bsp/many_meshes/places_in_cells.h>

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/many_meshes/grid_counters.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/diagnostics.h>

namespace {

using trisect::Diagnostics;
using trisect::detail::GridCounters;
using trisect::detail::OutlineBox;
using trisect::detail::OutlinedSolid;
using trisect::detail::PlacesInCells;
using trisect::detail::SinglePlace;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

std::vector<OutlineBox> some_boxes(std::size_t count, std::mt19937& random) {
    std::uniform_real_distribution<double> at(-1000, 1000);
    std::uniform_real_distribution<double> size(0, 30);
    std::vector<OutlineBox> out(count);
    for (OutlineBox& b : out)
        for (std::size_t k = 0; k < 3; ++k) {
            b.lo[k] = at(random);
            b.hi[k] = b.lo[k] + size(random) * (random() % 100 == 0 ? 50 : 1);
        }
    return out;
}

OutlinedSolid solid_of(const std::vector<OutlineBox>& boxes) {
    OutlinedSolid out;
    out.boxes = boxes;
    for (const OutlineBox& b : boxes) out.box.add(b);
    return out;
}

TEST(PlacesInCells, BoxesThatMeetAreInOneCell) {
    std::mt19937 random(26050);
    const std::array boxes{some_boxes(40000, random), some_boxes(2000, random)};
    const std::array solids{solid_of(boxes[0]), solid_of(boxes[1])};
    std::array<std::vector<std::uint32_t>, 2> places;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::uint32_t f = 0; f < boxes[i].size(); f += i == 0 ? 1 : 2) places[i].push_back(f);
    const SinglePlace place({-1000, -1000, -1000}, {1000, 1000, 1000});
    const Diagnostics<GridCounters> diagnostics;
    const PlacesInCells cells({&solids[0], &solids[1]}, {places[0], places[1]}, place);
    EXPECT_EQ(diagnostics.counters().grids, 1U);
    EXPECT_EQ(diagnostics.counters().facets, 41000U);
    EXPECT_GT(cells.cell_count(), 1U);

    std::set<Pair> found;
    std::array<std::map<std::uint32_t, int>, 2> cells_of;
    std::array<std::map<std::uint32_t, bool>, 2> is_shared;
    for (std::size_t c = 0; c < cells.cell_count(); ++c) {
        for (std::size_t i = 0; i < 2; ++i)
            for (const PlacesInCells::Entry& e : cells.of(i, c)) {
                ++cells_of[i][e.place()];
                is_shared[i][e.place()] = e.is_shared();
                const OutlineBox& b = boxes[i][e.place()];
                EXPECT_TRUE(cells.bounds(c).meets(place.box(b.lo, b.hi)));
            }
        for (const PlacesInCells::Entry& a : cells.of(0, c))
            for (const PlacesInCells::Entry& b : cells.of(1, c))
                if (boxes[0][a.place()].meets(boxes[1][b.place()]))
                    found.insert({a.place(), b.place()});
    }
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(cells_of[i].size(), places[i].size());
        for (const auto& [f, count] : cells_of[i]) EXPECT_EQ(count > 1, is_shared[i][f]);
    }
    std::set<Pair> wanted;
    for (const std::uint32_t a : places[0])
        for (const std::uint32_t b : places[1])
            if (boxes[0][a].meets(boxes[1][b])) wanted.insert({a, b});
    EXPECT_EQ(found, wanted);
}

trisect::Solid sphere(std::uint32_t subdivisions, double x) {
    trisect::PolygonMesh mesh = trisect::make_icosphere(1, subdivisions);
    for (trisect::Point3d& p : mesh.points) {
        p[0] += x;
        p[1] += 0.3 * x;
    }
    return trisect::Solid::from_mesh(mesh);
}

// A union of three; the last step compares two with one.
TEST(PlacesInCells, AreForManyFacetsOnly) {
    const auto grids = [](std::uint32_t subdivisions) {
        const trisect::Expression all = trisect::Expression::any_of(
            {sphere(subdivisions, 0), sphere(subdivisions, 0.11), sphere(subdivisions, 0.23)});
        trisect::EvaluateOptions options;
        options.threads = 1;
        const Diagnostics<GridCounters> diagnostics;
        static_cast<void>(trisect::evaluate(all, options));
        const GridCounters made = diagnostics.counters();
        EXPECT_EQ(made.facets == 0, made.grids == 0);
        EXPECT_TRUE(made.grids == 0 || made.facets / made.grids >= 32768) << made.facets;
        return made.grids;
    };
    EXPECT_EQ(grids(3), 0U);
    EXPECT_EQ(grids(5), 2U);
}

}  // namespace
