// SPDX-License-Identifier: Apache-2.0
//
// Facets that two meshes have in common, and which of them bound a result (equal_facets.h).

#include <trisect/bsp/two_meshes/equal_facets.h>

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace {

using trisect::LatticeMesh;
using trisect::detail::Crossings;
using trisect::detail::EqualFacets;
using Fate = EqualFacets::Fate;

// Four corners; not all need to be used.
LatticeMesh mesh(std::vector<std::array<std::uint32_t, 3>> triangles) {
    LatticeMesh out;
    out.points = {{0, 0, 0}, {5, 0, 0}, {0, 7, 0}, {0, 0, 3}};
    out.triangles = std::move(triangles);
    return out;
}

// Of a union, an intersection and a difference of solids that lie below their facets.
constexpr Crossings::Operand outside{.open = 0};
constexpr Crossings::Operand inside{.open = 1};

std::array<std::vector<Fate>, 2> fates(const LatticeMesh& a, const LatticeMesh& b,
                                       const Crossings::Operand& of_a,
                                       const Crossings::Operand& of_b) {
    std::array<std::vector<std::uint32_t>, 2> all;
    for (std::uint32_t i = 0; i < a.triangles.size(); ++i) all[0].push_back(i);
    for (std::uint32_t i = 0; i < b.triangles.size(); ++i) all[1].push_back(i);
    return EqualFacets({&a, &b}, all, {of_a, of_b}).fates;
}

TEST(EqualFacets, AreFoundInAnyOrderOfTheirCorners) {
    const LatticeMesh a = mesh({{0, 1, 2}, {0, 1, 3}, {1, 2, 3}});
    const LatticeMesh b = mesh({{2, 1, 3}, {3, 0, 1}, {0, 3, 2}});
    const auto found = fates(a, b, outside, outside);
    EXPECT_EQ(found[0], (std::vector{Fate::Own, Fate::Kept, Fate::Dropped}));
    EXPECT_EQ(found[1], (std::vector{Fate::Dropped, Fate::Dropped, Fate::Own}));
}

// Solids on the same side of a facet, and on both sides of it.
TEST(EqualFacets, BoundTheResultWhereTheSolidsAreOnOneSideOrOnlyOneIs) {
    const LatticeMesh a = mesh({{0, 1, 2}});
    const LatticeMesh b = mesh({{0, 2, 1}});
    const auto fate = [](const LatticeMesh& x, const LatticeMesh& y, const auto& p, const auto& q) {
        return fates(x, y, p, q)[0][0];
    };
    // Unions.
    EXPECT_EQ(fate(a, a, outside, outside), Fate::Kept);
    EXPECT_EQ(fate(a, b, outside, outside), Fate::Dropped);
    // Intersections.
    EXPECT_EQ(fate(a, a, inside, inside), Fate::Kept);
    EXPECT_EQ(fate(a, b, inside, inside), Fate::Dropped);
    // Differences: the first solid is open where it is, the second one where it is not.
    EXPECT_EQ(fate(a, a, inside, outside), Fate::Dropped);
    EXPECT_EQ(fate(a, b, inside, outside), Fate::Kept);
}

}  // namespace
