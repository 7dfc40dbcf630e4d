// SPDX-License-Identifier: Apache-2.0
//
// Moves of corners by which all facets go outwards (outward_moves.h).

#include <trisect/bsp/two_meshes/outward_moves.h>

#include <cstdint>
#include <memory>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/brep/primitives/prism.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/cells/shift/shifted_pairs.h>

namespace outward_moves_test {
namespace {

using trisect::LatticeMesh;
using trisect::detail::CornerMoves;
using trisect::detail::FacetCorners;
using trisect::detail::InfinitesimalShift;
using trisect::detail::outward_moves;

// How many facets do not go to the wanted side of their own planes as a whole.
std::size_t count_others(const LatticeMesh& mesh, bool inwards) {
    std::vector<std::uint32_t> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    const std::shared_ptr<const CornerMoves> moves = outward_moves(mesh, all, inwards);
    InfinitesimalShift shift;
    shift.moves = moves.get();
    std::size_t others = 0;
    for (const auto& t : mesh.triangles) {
        const FacetCorners f{&mesh.points[t[0]], &mesh.points[t[1]], &mesh.points[t[2]]};
        others += side_of_shifted(f, f, shift) == (inwards ? -1 : 1) ? 0U : 1U;
    }
    return others;
}

LatticeMesh lattice_mesh(const trisect::PolygonMesh& mesh) {
    return trisect::import_mesh(mesh).mesh;
}

TEST(OutwardMoves, TakeAllFacetsOutwardsOrInwards) {
    // Corners with three planes that turn in and out, saddles, and thin blades.
    const trisect::Outline steps{{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
    const trisect::Outline blade{{0, 0}, {1, 0.0009765625}, {2, 0}, {1, 0.001953125}};
    for (const trisect::PolygonMesh& mesh :
         {trisect::make_prism(steps, 2), trisect::make_prism(blade, 0.0009765625),
          trisect::make_regular_prism(40, 1, 2), trisect::make_torus(0.7, 0.3, 30, 15)})
        for (const bool inwards : {false, true})
            EXPECT_EQ(count_others(lattice_mesh(mesh), inwards), 0U);
}

// Three facets around a corner whose normals are in no half of space.
TEST(OutwardMoves, OfACornerWithoutAnySayNothing) {
    LatticeMesh mesh;
    mesh.points = {{0, 0, 0}, {9, 0, 1},  {-5, 8, 1}, {-5, -8, 1},
                   {9, 0, 5}, {-5, 8, 5}, {-5, -8, 5}};
    mesh.triangles = {{0, 1, 4}, {0, 2, 5}, {0, 3, 6}};
    EXPECT_GT(count_others(mesh, false), 0U);
}

TEST(OutwardMoves, LeaveOtherCornersWhereTheyAre) {
    const LatticeMesh mesh = lattice_mesh(trisect::make_regular_prism(8, 1, 2));
    const std::vector<std::uint32_t> one{3};
    const auto moves = outward_moves(mesh, one, false);
    std::size_t moved = 0;
    for (const CornerMoves::Vector& v : moves->vectors)
        moved += v == CornerMoves::Vector{} ? 0U : 1U;
    EXPECT_EQ(moved, 3U);
}

}  // namespace
}  // namespace outward_moves_test
