// SPDX-License-Identifier: Apache-2.0
//
// Facets of one plane by their corners, against their planes: on a small grid, where many are, and
// with coordinates of many digits, where few are and doubles do not decide.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/assembly/parts/coplanar_facets.h>
#include <trisect/kernel/predicates.h>

namespace {

using trisect::Coordinate;
using trisect::LatticeMesh;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::detail::BoundaryFacet;
using trisect::detail::Source;
using trisect::detail::TriangleNormal;

bool is_flat(const LatticeMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const TriangleNormal n(mesh.points[t[0]].doubles(), mesh.points[t[1]].doubles(),
                           mesh.points[t[2]].doubles());
    for (std::size_t k = 0; k < 3; ++k)
        if (std::fabs(n.n[k]) > n.error[k]) return false;
    return true;
}

/// Any triangles between points, of which none is flat; `point` makes one.
template <class MakePoint>
std::shared_ptr<const Source> triangles(std::mt19937& random, const MakePoint& point) {
    LatticeMesh mesh;
    for (int i = 0; i < 12; ++i) mesh.points.push_back(point());
    std::uniform_int_distribution<std::uint32_t> any(0, 11);
    while (mesh.triangles.size() < 40) {
        const std::array t{any(random), any(random), any(random)};
        if (!is_flat(mesh, t)) mesh.triangles.push_back(t);
    }
    return Source::make(std::move(mesh));
}

struct CoplanarCount {
    std::size_t alike = 0;
    std::size_t opposite = 0;
    std::size_t open = 0;
};

void compare(const BoundaryFacet& a, const BoundaryFacet& b, CoplanarCount& count) {
    const auto normal = [](const BoundaryFacet& f) {
        return TriangleNormal(f.source->corner(f.facet, 0).doubles(),
                              f.source->corner(f.facet, 1).doubles(),
                              f.source->corner(f.facet, 2).doubles());
    };
    const Plane p = a.source->support(a.facet);
    const Plane q = b.source->support(b.facet);
    const bool same = trisect::is_same_plane(p, q);
    const bool expected = same && trisect::same_orientation(p, q) == (a.flipped == b.flipped);
    const auto alike = trisect::detail::face_alike(a, normal(a), b, normal(b));
    if (!alike) {
        ++count.open;
        return;
    }
    EXPECT_EQ(*alike, expected);
    if (same) ++(expected ? count.alike : count.opposite);
}

void compare_all(const Source& s, const Source& t, CoplanarCount& count) {
    for (std::uint32_t f = 0; f < s.facet_count(); ++f)
        for (std::uint32_t g = 0; g < t.facet_count(); ++g)
            for (const bool flipped : {false, true})
                compare({&s, f, flipped}, {&t, g, false}, count);
}

TEST(CoplanarFacets, OnASmallGrid) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> coordinate(-2, 2);
    const auto point = [&] {
        return LatticePoint{Coordinate(coordinate(random)), Coordinate(coordinate(random)),
                            Coordinate(coordinate(random))};
    };
    CoplanarCount count;
    for (int i = 0; i < 6; ++i) {
        const auto s = triangles(random, point);
        const auto t = triangles(random, point);
        compare_all(*s, *s, count);
        compare_all(*s, *t, count);
    }
    EXPECT_GT(count.alike, 300U);
    EXPECT_GT(count.opposite, 300U);
    EXPECT_EQ(count.open, 0U);
}

// Points of a slanted plane, some a unit off it: x + 3 y + 7 z is 0 or 1 there.
TEST(CoplanarFacets, WithManyDigits) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> coordinate(-0x1p44, 0x1p44);
    std::bernoulli_distribution is_off(0.1);
    const auto point = [&] {
        const double y = std::nearbyint(coordinate(random));
        const double z = std::nearbyint(coordinate(random));
        const double x = -3 * y - 7 * z + (is_off(random) ? 1 : 0);
        return LatticePoint{Coordinate(x), Coordinate(y), Coordinate(z)};
    };
    CoplanarCount count;
    for (int i = 0; i < 6; ++i) {
        const auto s = triangles(random, point);
        const auto t = triangles(random, point);
        compare_all(*s, *s, count);
        compare_all(*s, *t, count);
    }
    EXPECT_GT(count.alike, 300U);
    EXPECT_GT(count.opposite, 300U);
}

}  // namespace
