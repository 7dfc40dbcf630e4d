// SPDX-License-Identifier: Apache-2.0
//
// Centres about which a mesh grows or shrinks to given sides of facets (growth_about.h).

#include <trisect/bsp/two_meshes/growth_about.h>

#include <vector>

#include <gtest/gtest.h>

#include <trisect/bsp/cells/shift/shifted_pairs.h>

namespace {

using trisect::LatticeMesh;
using trisect::detail::growth_about;
using trisect::detail::InfinitesimalShift;
using trisect::detail::side_of_shifted;
using trisect::detail::WantedSide;

// A facet of each side of a box; normals point out of it.
LatticeMesh box_sides(std::int64_t x, std::int64_t y, std::int64_t z) {
    LatticeMesh m;
    m.points = {{0, 0, 0}, {x, 0, 0}, {0, y, 0}, {x, y, 0},
                {0, 0, z}, {x, 0, z}, {0, y, z}, {x, y, z}};
    m.triangles = {{0, 4, 2}, {1, 3, 5}, {0, 1, 4}, {2, 6, 3}, {0, 2, 1}, {4, 5, 6}};
    return m;
}

std::vector<WantedSide> all_sides(bool above) {
    std::vector<WantedSide> out;
    for (std::uint32_t f = 0; f < 6; ++f) out.push_back({f, above, false});
    return out;
}

bool goes_to(const LatticeMesh& m, const InfinitesimalShift& shift,
             const std::vector<WantedSide>& sides) {
    for (const WantedSide& s : sides) {
        const auto& t = m.triangles[s.facet];
        const int side =
            side_of_shifted({&m.points[t[0]], &m.points[t[1]], &m.points[t[2]]}, shift);
        if (!s.is_wish && (side > 0) != s.above) return false;
    }
    return true;
}

TEST(GrowthAbout, CoversAllSidesOfABoxOrUncoversThem) {
    for (const std::int64_t z : {1, 7, 100000}) {
        const LatticeMesh m = box_sides(5, 300, z);
        for (const bool above : {true, false}) {
            const auto shift = growth_about(m, all_sides(above));
            ASSERT_TRUE(shift.has_value());
            EXPECT_EQ(shift->growth, above ? 1 : -1);
            EXPECT_TRUE(goes_to(m, *shift, all_sides(above)));
        }
    }
}

TEST(GrowthAbout, IsNoneForBothSidesOfAFacet) {
    const LatticeMesh m = box_sides(5, 5, 5);
    std::vector<WantedSide> sides = all_sides(true);
    sides.push_back({2, false, false});
    EXPECT_FALSE(growth_about(m, sides).has_value());
    sides.back().is_wish = true;
    const auto shift = growth_about(m, sides);
    ASSERT_TRUE(shift.has_value());
    EXPECT_TRUE(goes_to(m, *shift, sides));
}

// The centre is between the lattice's points.
TEST(GrowthAbout, FindsCentresInAUnitCube) {
    const LatticeMesh m = box_sides(1, 1, 1);
    const auto shift = growth_about(m, all_sides(true));
    ASSERT_TRUE(shift.has_value());
    EXPECT_FALSE(shift->centre.is_whole());
    EXPECT_TRUE(goes_to(m, *shift, all_sides(true)));
}

}  // namespace
