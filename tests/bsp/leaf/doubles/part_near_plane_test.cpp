// SPDX-License-Identifier: Apache-2.0
//
// Triangles with corners near the other one's plane, of which doubles find that what they have
// there is beside that one, against integers.

#include <trisect/bsp/leaf/doubles/part_near_plane.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <trisect/bsp/cells/shift/shifted_pairs.h>

namespace part_near_plane_test {
namespace {

using trisect::LatticePoint;
using trisect::detail::are_apart_near_planes;
using trisect::detail::coplanar_overlap;
using trisect::detail::FacetCorners;
using trisect::detail::FilteredFacets;
using trisect::detail::FilteredPlane;
using trisect::detail::InfinitesimalShift;
using trisect::detail::Overlap;
using trisect::detail::relate_exactly;
using trisect::detail::ShiftedPair;
using trisect::detail::Vector3;

using Triangle = std::array<Vector3, 3>;

FilteredPlane plane_of(const Triangle& t, double extent) {
    return FilteredFacets::plane_of(t, {extent, extent, extent});
}

bool are_apart(const Triangle& a, const Triangle& b, double extent) {
    return are_apart_near_planes({a, plane_of(a, extent)}, {b, plane_of(b, extent)});
}

std::array<LatticePoint, 3> lattice_points(const Triangle& t) {
    std::array<LatticePoint, 3> out;
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = {trisect::Coordinate(t[i][0]), trisect::Coordinate(t[i][1]),
                  trisect::Coordinate(t[i][2])};
    return out;
}

bool has_area(const Triangle& t) {
    const Vector3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    return n[0] != 0 || n[1] != 0 || n[2] != 0;
}

// However the second one is moved.
void expect_no_common_point(const Triangle& a, const Triangle& b) {
    const auto at_a = lattice_points(a);
    const auto at_b = lattice_points(b);
    const FacetCorners first{&at_a[0], &at_a[1], &at_a[2]};
    const FacetCorners second{&at_b[0], &at_b[1], &at_b[2]};
    for (int way = 0; way < 8; ++way) {
        InfinitesimalShift shift;
        for (std::size_t k = 0; k < 3; ++k) shift.signs[k] = (way >> k & 1) != 0 ? 1 : -1;
        const ShiftedPair pair = relate_exactly(first, second, shift);
        EXPECT_EQ(pair.kind, ShiftedPair::Kind::Apart);
    }
}

// On a small grid, of one unit or of many, so that corners lie in planes or a little beside them.
TEST(PartNearPlane, TrianglesThatAreFoundApartAreSo) {
    std::mt19937 random(3);
    int near = 0;
    int found = 0;
    for (int i = 0; i < 60000; ++i) {
        SCOPED_TRACE("turn " + std::to_string(i));
        const double unit = i % 3 == 0 ? 1 : 0x1p38;
        const auto triangle = [&] {
            Triangle t;
            do {
                for (Vector3& p : t)
                    for (double& x : p) x = static_cast<double>(random() % 5) * unit;
            } while (!has_area(t));
            return t;
        };
        Triangle a = triangle();
        Triangle b = triangle();
        if (i % 3 == 2)
            for (Triangle* t : {&a, &b})
                for (Vector3& p : *t)
                    for (double& x : p) x += static_cast<double>(random() % 3) - 1;
        const double extent = 4 * unit + 2;
        const bool is_apart = are_apart(a, b, extent);
        EXPECT_EQ(is_apart, are_apart(b, a, extent));
        bool is_near = false;
        for (const Vector3& p : b) {
            const FilteredPlane plane = plane_of(a, extent);
            is_near = is_near || std::fabs(plane.value(p)) <= plane.bound;
        }
        near += is_near ? 1 : 0;
        if (!is_apart) continue;
        ++found;
        expect_no_common_point(a, b);
    }
    EXPECT_GT(near, 8000);
    EXPECT_GT(found, 5000);
}

TEST(PartNearPlane, AWallThatEndsBesideAFaceInItsPlane) {
    const Triangle face{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}};
    const Triangle beside{{{8, 8, 0}, {9, 7, 0}, {8, 8, -5}}};
    const Triangle on_corner{{{6, 8, 0}, {7, 7, 0}, {6, 6, -5}}};
    const Triangle touching{{{5, 5, 0}, {9, 9, 0}, {9, 9, -5}}};
    const Triangle over{{{2, 2, 0}, {9, 9, 0}, {9, 9, -5}}};
    EXPECT_TRUE(are_apart(face, beside, 20));
    EXPECT_TRUE(are_apart(face, on_corner, 20));
    EXPECT_FALSE(are_apart(face, touching, 20));
    EXPECT_FALSE(are_apart(face, over, 20));
}

// A corner in the plane, and the edge that is opposite goes through it: from there on it is over
// the face, or not.
TEST(PartNearPlane, ATriangleThatGoesThroughAPlaneFromACornerInIt) {
    const Triangle face{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}};
    const Triangle beside{{{12, 12, 0}, {20, 2, 8}, {20, 2, -8}}};
    const Triangle across{{{12, 12, 0}, {-20, -20, 8}, {-20, -20, -8}}};
    EXPECT_TRUE(are_apart(face, beside, 40));
    EXPECT_FALSE(are_apart(face, across, 40));
}

// A triangle so flat that its third corner is neither near the plane nor far from it.
TEST(PartNearPlane, NothingIsSaidWhereACornerIsNeitherNearNorFar) {
    const double big = 0x1p40;
    const Triangle face{{{0, 0, 0}, {big, 1, 0}, {1, big, 3}}};
    const FilteredPlane plane = plane_of(face, 4 * big);
    const double step = 64 * plane.bound / std::fabs(plane.normal[2]);
    ASSERT_GE(step, 0.25);
    const Triangle flat{{{2 * big, 0, 0}, {0, 2 * big, 0}, {3 * big, 3 * big, std::ceil(step)}}};
    EXPECT_FALSE(are_apart(face, flat, 4 * big));
}

}  // namespace
}  // namespace part_near_plane_test
