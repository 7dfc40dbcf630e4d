// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/query_oracle.h"
#include "support/random_result.h"

namespace {

using trisect::BrepIndex;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::PlaneRelation;
using trisect::SectionRegion;
using trisect::Solid;

brute::Point3 exact(const trisect::Point& p) {
    const trisect::HomogeneousPoint h = p.homogeneous();
    brute::Point3 out;
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = brute::rational(trisect::ExactRational(h.xyz[k]) / trisect::ExactRational(h.w));
    return out;
}

// Winding number of a loop about a point of the plane that is on no loop's line through it, seen
// along an axis that the plane's normal is not perpendicular to.
int winding(const trisect::SectionLoop& loop, const brute::Point3& p, std::size_t axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    int n = 0;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
        const brute::Point3 a = exact(loop.points[i]);
        const brute::Point3 b = exact(loop.points[(i + 1) % loop.points.size()]);
        if ((a[v] <= p[v]) == (b[v] <= p[v])) continue;
        const brute::Rational turn = (b[u] - a[u]) * (p[v] - a[v]) - (b[v] - a[v]) * (p[u] - a[u]);
        if (a[v] <= p[v] && turn > 0) ++n;
        if (b[v] <= p[v] && turn < 0) --n;
    }
    return n;
}

bool is_on_loop(const trisect::SectionLoop& loop, const brute::Point3& p) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
        const brute::Point3 a = exact(loop.points[i]);
        const brute::Point3 b = exact(loop.points[(i + 1) % loop.points.size()]);
        bool collinear = true;
        bool between = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t l = (k + 1) % 3;
            collinear = collinear && (b[k] - a[k]) * (p[l] - a[l]) == (b[l] - a[l]) * (p[k] - a[k]);
            between = between && std::min(a[k], b[k]) <= p[k] && p[k] <= std::max(a[k], b[k]);
        }
        if (collinear && between) return true;
    }
    return false;
}

// Every point of the plane is in the section's interior or on its outline when it is in the solid
// (except for loose parts), and outside when it is not.
void expect_section(const BrepIndex& index, const brute::Boundary& boundary, const Plane& plane,
                    reference::Random& random, std::uint64_t seed) {
    const auto regions = index.section(plane, {});
    const auto axis = static_cast<std::size_t>(plane.dominant_axis());
    const int turned = plane.normal(static_cast<int>(axis)) > 0 ? 1 : -1;
    const auto at = [&](std::size_t k) {
        return brute::rational(trisect::ExactRational(plane.normal(static_cast<int>(k))));
    };
    for (const SectionRegion& r : regions) ASSERT_GE(r.outer.points.size(), 3U);
    for (int i = 0; i < 40; ++i) {
        brute::Point3 p;
        for (auto& x : p) x = reference::fraction(random.between(-16, 16 * 32), 16);
        p[axis] = 0;
        const brute::Rational value = at(0) * p[0] + at(1) * p[1] + at(2) * p[2] +
                                      brute::rational(trisect::ExactRational(plane.offset()));
        p[axis] = -value / at(axis);
        int inside = 0;
        bool on = false;
        for (const SectionRegion& r : regions) {
            inside += turned * winding(r.outer, p, axis);
            on = on || is_on_loop(r.outer, p);
            for (const auto& hole : r.holes) {
                inside += turned * winding(hole, p, axis);
                on = on || is_on_loop(hole, p);
            }
        }
        const brute::Answer answer = boundary.locate(p);
        if (on) {
            EXPECT_NE(answer.location, trisect::Location::Outside) << "seed " << seed;
            EXPECT_NE(answer.location, trisect::Location::Inside) << "seed " << seed;
            continue;
        }
        ASSERT_TRUE(inside == 0 || inside == 1) << "seed " << seed;
        if (inside == 1) {
            EXPECT_NE(answer.location, trisect::Location::Outside) << "seed " << seed;
        } else {
            EXPECT_NE(answer.location, trisect::Location::Inside) << "seed " << seed;
            EXPECT_NE(answer.location, trisect::Location::OnFace) << "seed " << seed;
        }
    }
}

// A plane through lattice points near the solid, often one of its own.
Plane random_plane(const trisect::LatticeMesh& mesh, reference::Random& random) {
    for (;;) {
        std::array<LatticePoint, 3> c;
        if (random.chance(1, 3)) {
            const auto& t = mesh.triangles[random.below(mesh.triangles.size())];
            for (std::size_t i = 0; i < 3; ++i) c[i] = mesh.points[t[i]];
            if (random.chance(1, 2)) std::swap(c[0], c[1]);
        } else {
            for (auto& p : c)
                p = random.chance(1, 2) ? mesh.points[random.below(mesh.points.size())]
                                        : LatticePoint{random.between(0, 16), random.between(0, 16),
                                                       random.between(0, 16)};
        }
        if (!trisect::are_collinear(c[0], c[1], c[2])) return Plane::through(c[0], c[1], c[2]);
    }
}

TEST(Section, FreshMeshesOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        reference::Random random(seed);
        const auto mesh = engines::lattice_mesh(reference::random_embedded_solid(random));
        const BrepIndex index(Solid::from_lattice_mesh(mesh));
        const auto boundary = brute::Boundary::of_mesh(mesh, 0);
        for (int i = 0; i < 5; ++i)
            expect_section(index, boundary, random_plane(mesh, random), random, seed);
    }
}

TEST(Section, ResultsOfBooleansOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        reference::Random random(seed);
        const brute::RandomResult result = brute::random_result(seed, 2, false);
        const BrepIndex index(result.solid);
        const brute::Boundary& boundary = result.boundary;
        const trisect::LatticeMesh& mesh = result.mesh;
        for (int i = 0; i < 5; ++i)
            expect_section(index, boundary, random_plane(mesh, random), random, seed);
    }
}

Solid cube(std::int64_t lo, std::int64_t hi) {
    return engines::solid(reference::box({lo, lo, lo}, {hi, hi, hi}), trisect::Embedding::Assume);
}

TEST(Section, OfACubeInItsOwnFacesIsTheFace) {
    const BrepIndex index(cube(0, 4));
    for (const std::int64_t z : {0, 2, 4}) {
        for (const bool flipped : {false, true}) {
            Plane plane = Plane::axis_aligned(2, 1, z);
            if (flipped) plane = plane.flipped();
            const auto regions = index.section(plane, {});
            ASSERT_EQ(regions.size(), 1U);
            EXPECT_EQ(regions[0].outer.points.size(), 4U);
            EXPECT_TRUE(regions[0].holes.empty());
        }
    }
    EXPECT_TRUE(index.section(Plane::axis_aligned(2, 1, 5), {}).empty());
}

TEST(Section, OfABoxWithACavityHasAHole) {
    const BrepIndex index(evaluate(cube(0, 8) - cube(2, 6)));
    const auto regions = index.section(Plane::axis_aligned(0, 1, 4), {});
    ASSERT_EQ(regions.size(), 1U);
    EXPECT_EQ(regions[0].outer.points.size(), 4U);
    ASSERT_EQ(regions[0].holes.size(), 1U);
    EXPECT_EQ(regions[0].holes[0].points.size(), 4U);
}

TEST(Section, OfAHalfSpaceIsUnbounded) {
    const BrepIndex index(Solid::half_space(Plane::axis_aligned(2, 1, 0), {}));
    EXPECT_THROW((void)index.section(Plane::axis_aligned(0, 1, 0), {}), trisect::UnsupportedError);
}

TEST(RelationToPlane, OfACube) {
    const BrepIndex index(cube(0, 4));
    EXPECT_EQ(index.relation_to(Plane::axis_aligned(2, 1, 5), {}), PlaneRelation::Below);
    EXPECT_EQ(index.relation_to(Plane::axis_aligned(2, 1, 4), {}), PlaneRelation::TouchingBelow);
    EXPECT_EQ(index.relation_to(Plane::axis_aligned(2, 1, 3), {}), PlaneRelation::Straddling);
    EXPECT_EQ(index.relation_to(Plane::axis_aligned(2, 1, 0), {}), PlaneRelation::TouchingAbove);
    EXPECT_EQ(index.relation_to(Plane::axis_aligned(2, 1, -1), {}), PlaneRelation::Above);
    EXPECT_EQ(BrepIndex(Solid()).relation_to(Plane::axis_aligned(2, 1, 0), {}),
              PlaneRelation::Empty);
}

TEST(Section, OfPlanesInTheUsersUnitsAndOnALattice) {
    // Sizes of a tenth need a fine lattice.
    const Solid box = Solid::from_mesh(trisect::make_box({1.1, 1.1, 1.1}));
    const BrepIndex index(box);
    ASSERT_NE(index.solid().lattice(), trisect::Lattice{});
    const auto regions = index.section({0, 0, 1, -0.5});
    ASSERT_EQ(regions.size(), 1U);
    EXPECT_EQ(regions[0].outer.rounded[0][2], 0.5);
    EXPECT_EQ(index.relation_to({0, 0, 1, -0.5}), PlaneRelation::Straddling);
    EXPECT_EQ(index.relation_to({0, 0, 1, -2}), PlaneRelation::Below);
    const Plane plane = trisect::plane_on_lattice({0, 0, 1, -0.5}, {});
    EXPECT_THROW((void)index.section(plane, {}), trisect::UsageError);
    EXPECT_THROW((void)index.relation_to(plane, {}), trisect::UsageError);
    EXPECT_THROW((void)index.section({0, 0, 0, 1}), trisect::UsageError);
    EXPECT_EQ(index.locate({0, 0, 0}).location, trisect::Location::OnVertex);
    EXPECT_EQ(index.locate({0.5, 0.5, 0.5}).location, trisect::Location::Inside);
    EXPECT_THROW((void)index.locate({0, 0}), trisect::UsageError);
}

}  // namespace
