// SPDX-License-Identifier: Apache-2.0
//
// Certified rounding: named configurations in which plain rounding fails, and random results.

#include <trisect/bsp/certified_rounding.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/brep/winding_number.h>
#include <trisect/bsp/brep_index.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/solids.h"

namespace {

using solids::box;
using trisect::Brep;
using trisect::certified_rounding;
using trisect::CertifiedRounding;
using trisect::Expression;
using trisect::PolygonMesh;
using trisect::Precision;
using trisect::RoundingOptions;
using trisect::Solid;
using Outcome = CertifiedRounding::Outcome;

RoundingOptions floats() {
    RoundingOptions o;
    o.precision = Precision::Float;
    return o;
}

// What is said of the mesh, asked again; and that the volume moved no more than it may.
void expect_proved(const Brep& brep, const CertifiedRounding& r) {
    EXPECT_TRUE(r.certificate.holds());
    const trisect::ValidationReport report = trisect::validate(r.mesh);
    EXPECT_TRUE(report.lattice().lossless);
    EXPECT_TRUE(report.is_solid() || r.mesh.face_count() == 0) << report.to_string();
    if (r.mesh.face_count() == 0) return;
    const Solid exact = Solid::from_brep(brep);
    const trisect::BrepIndex index(exact);
    const trisect::BrepIndex of_mesh(Solid::from_mesh(r.mesh));
    const double radius = r.radius;
    for (int i = 0; i < 125; ++i) {
        const trisect::Point3d p{0.37 + 1.7 * (i % 5), 0.41 + 1.7 * (i / 5 % 5),
                                 0.43 + 1.7 * (i / 25)};
        const auto nearest = index.nearest(p);
        // Radius is in the maximum norm.
        if (!nearest || std::sqrt(nearest->squared_distance.to_double()) <= 2 * radius) continue;
        EXPECT_EQ(index.locate(p).location, of_mesh.locate(p).location);
    }
}

TEST(CertifiedRounding, OfLatticeCornersIsPlain) {
    const Brep brep =
        evaluate(Expression(box(0, 0, 0, 4, 4, 4)) - Expression(box(1, 1, 1, 5, 5, 5))).to_brep();
    const CertifiedRounding r = certified_rounding(brep);
    EXPECT_EQ(r.outcome, Outcome::Plain);
    EXPECT_EQ(r.radius, 0);
    EXPECT_EQ(r.unit, 0);
    EXPECT_EQ(r.mesh.points, trisect::to_polygon_mesh(brep).points);
    expect_proved(brep, r);
}

TEST(CertifiedRounding, OfTheEmptySet) {
    EXPECT_EQ(certified_rounding(Brep()).mesh.face_count(), 0U);
}

// Walls thinner than a float's last bit: rounded, both sides fall together or cross.
TEST(CertifiedRounding, ThinWallsCollapseOrStay) {
    for (const double thick : {0x1p-20, 0x1p-23, 0x1p-24, 0x1p-26, 0x1p-40}) {
        const Solid frame =
            evaluate(Expression(box(0, 0, 0, 8, 8, 8)) - Expression(box(1, 1, 5 + thick, 7, 7, 7)) -
                     Expression(box(1, 1, 1, 7, 7, 5)));
        const Brep brep = frame.to_brep();
        const CertifiedRounding r = certified_rounding(brep, floats());
        EXPECT_NE(r.outcome, Outcome::Failed) << thick;
        EXPECT_LE(r.radius, 0x1p-18) << thick;
        expect_proved(brep, r);
    }
}

// A needle between two slanted planes: its sides cross when corners are rounded to floats.
TEST(CertifiedRounding, SlantedSlivers) {
    int repaired = 0;
    for (int i = 1; i <= 20; ++i) {
        const double slope = 0x1p-22 * i;
        PolygonMesh wedge = trisect::make_box({0.1, 0.1, 0.1}, {7.3, 6.9, 5.7});
        for (trisect::Point3d& p : wedge.points)
            if (p[2] > 1) p[2] = 0.1 + slope * p[0] + slope / 3 * p[1];
        const Solid thin = Solid::from_mesh(wedge);
        const Solid ball = Solid::from_mesh(trisect::make_icosphere(5, 1));
        const Brep brep = evaluate(Expression(thin) - Expression(ball)).to_brep();
        const CertifiedRounding r = certified_rounding(brep, floats());
        EXPECT_NE(r.outcome, Outcome::Failed) << i;
        repaired += r.outcome == Outcome::Repaired ? 1 : 0;
        expect_proved(brep, r);
    }
    RecordProperty("repaired", repaired);
}

TEST(CertifiedRounding, OfRandomResultsOnASmallGrid) {
    reference::Random random(23);
    std::array<int, 4> outcomes{};
    for (int round = 0; round < 120; ++round) {
        const Solid a = engines::solid(reference::random_embedded_solid(random));
        const Solid b = engines::solid(reference::random_embedded_solid(random));
        const Solid c = engines::solid(reference::random_embedded_solid(random));
        const Brep brep = evaluate((Expression(a) ^ Expression(b)) - Expression(c)).to_brep();
        const CertifiedRounding r =
            certified_rounding(brep, round % 2 == 0 ? RoundingOptions{} : floats());
        ++outcomes[static_cast<std::size_t>(r.outcome)];
        EXPECT_NE(r.outcome, Outcome::Failed) << round;
        expect_proved(brep, r);
    }
    RecordProperty("plain", outcomes[0]);
    RecordProperty("gridded", outcomes[1]);
    RecordProperty("repaired", outcomes[2]);
}

// A hollow ball, less or more another one, 2^20 from the origin along two axes. Doubles there are
// so far apart that the balls are some hundred of them wide.
class BallsFarAway {
public:
    BallsFarAway(double size, unsigned subdivisions)
        : size_(size),
          brep_(evaluate((Expression(ball(3, 0, subdivisions)) -
                          Expression(ball(2.5, 0.01, subdivisions))) ^
                         Expression(ball(3, 0.3, subdivisions)))
                    .to_brep()) {}
    [[nodiscard]] const Brep& brep() const { return brep_; }
    [[nodiscard]] Solid ball(double radius, double along, unsigned subdivisions) const {
        PolygonMesh m = trisect::make_icosphere(radius * size_, subdivisions);
        for (trisect::Point3d& p : m.points)
            for (std::size_t i = 0; i < 2; ++i) p[i] += 0x1p20 + along * size_;
        return Solid::from_mesh(m);
    }
    // How many points inside and outside are farther from the boundary than the set may have moved;
    // these lie in the mesh as in the exact set.
    [[nodiscard]] std::array<int, 2> expect_same_beyond_radius(const CertifiedRounding& r) const {
        trisect::SolidOptions any;
        any.embedding = trisect::Embedding::Resolve;
        const trisect::BrepIndex exact(Solid::from_brep(brep_));
        const trisect::BrepIndex rounded(Solid::from_mesh(r.mesh, any));
        std::array<int, 2> count{};
        for (int i = 0; i < 729; ++i) {
            const auto at = [&](int k) { return size_ * (k - 4) * 0.83; };
            const trisect::Point3d p{0x1p20 + at(i % 9), 0x1p20 + at(i / 9 % 9), at(i / 81)};
            // Distances in the maximum norm are at least 0.57 times these.
            if (std::sqrt(exact.nearest(p)->squared_distance.to_double()) * 0.57 <= r.radius)
                continue;
            const trisect::Location location = exact.locate(p).location;
            EXPECT_EQ(location, rounded.locate(p).location);
            ++count[location == trisect::Location::Inside ? 0 : 1];
        }
        return count;
    }

private:
    double size_;
    Brep brep_;
};

TEST(CertifiedRounding, BallsOfFewUnitsTakeASecondRound) {
    const BallsFarAway balls(0x1p-24, 1);
    const CertifiedRounding r = certified_rounding(balls.brep());
    EXPECT_EQ(r.outcome, Outcome::Repaired);
    EXPECT_GE(r.rounds, 2U);
    EXPECT_GT(r.snapped_vertices, 0U);
    EXPECT_GT(r.first_pairs, 0U);
    EXPECT_TRUE(r.certificate.holds());
    EXPECT_TRUE(trisect::validate(r.mesh).is_solid());
    const auto [inside, outside] = balls.expect_same_beyond_radius(r);
    EXPECT_GT(inside, 20);
    EXPECT_GT(outside, 300);
}

TEST(CertifiedRounding, WhatFailsStaysWithinItsRadius) {
    RoundingOptions two;
    two.max_rounds = 2;
    const BallsFarAway balls(0x1p-25, 2);
    const CertifiedRounding r = certified_rounding(balls.brep(), two);
    EXPECT_EQ(r.outcome, Outcome::Failed);
    EXPECT_EQ(r.rounds, 2U);
    EXPECT_GT(r.snapped_vertices, 0U);
    EXPECT_FALSE(r.certificate.holds());
    const auto [inside, outside] = balls.expect_same_beyond_radius(r);
    EXPECT_GT(inside, 0);
    EXPECT_GT(outside, 50);
}

// A roof that stands on its ridge: an edge from (1,1,2) to (1,3,2), inside the top of a box.
PolygonMesh upturned_roof(double x, double y, double z) {
    PolygonMesh roof;
    for (const trisect::Point3d& p :
         {trisect::Point3d{1, 1, 2}, {0, 1, 4}, {2, 1, 4}, {1, 3, 2}, {0, 3, 4}, {2, 3, 4}})
        roof.points.push_back({p[0] + x, p[1] + y, p[2] + z});
    for (const std::array<std::uint32_t, 3>& t : {std::array<std::uint32_t, 3>{0, 2, 1},
                                                  {3, 4, 5},
                                                  {0, 4, 3},
                                                  {0, 1, 4},
                                                  {1, 5, 4},
                                                  {1, 2, 5},
                                                  {2, 3, 5},
                                                  {2, 0, 3}})
        roof.add_triangle(t[0], t[1], t[2]);
    return roof;
}

TEST(CertifiedRounding, AnEdgeInsideAFaceDividesIt) {
    const Brep brep =
        evaluate(Expression(Solid::from_mesh(trisect::make_box({0, 0, 0}, {4, 4, 2}))) |
                 Expression(Solid::from_mesh(upturned_roof(0, 0, 0))))
            .to_brep();
    const PolygonMesh plain = to_polygon_mesh(brep);
    const trisect::Certificate before = certify(brep, plain);
    EXPECT_FALSE(before.holds());
    const auto divided = divided_at_contacts(plain, before);
    ASSERT_TRUE(divided);
    EXPECT_TRUE(divided->certificate.holds());
    EXPECT_LT(divided->radius, 1e-14);
    // Corners are those of the roof: no new ones, and none twice.
    EXPECT_EQ(divided->mesh.points.size(), plain.points.size());
    ASSERT_EQ(divided->parents.size(), divided->mesh.face_count());
    EXPECT_GT(divided->mesh.face_count(), plain.face_count());
    EXPECT_TRUE(trisect::validate(divided->mesh).is_solid());
    const CertifiedRounding r = certified_rounding(brep);
    EXPECT_EQ(r.outcome, Outcome::Repaired);
    EXPECT_EQ(r.unit, 0);
    expect_proved(brep, r);
}

// Three roofs in a row and across each other, at coordinates that are no short fractions.
TEST(CertifiedRounding, EdgesInsideFacesAreDividedAtRoundedCorners) {
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        RoundingOptions options;
        options.precision = precision;
        const double top = 0.1 + 0.7;
        PolygonMesh box = trisect::make_box({0.1, 0.1, 0.1}, {6.3, 6.9, top});
        Expression all(Solid::from_mesh(box));
        for (int i = 0; i < 3; ++i)
            all = all | Expression(
                            Solid::from_mesh(upturned_roof(0.3 + 1.3 * i, 0.7 + 0.9 * i, top - 2)));
        const Brep brep = evaluate(all).to_brep();
        const CertifiedRounding r = certified_rounding(brep, options);
        EXPECT_NE(r.outcome, Outcome::Failed);
        expect_proved(brep, r);
    }
}

TEST(CertifiedRounding, RoundsAreBounded) {
    RoundingOptions none = floats();
    none.max_rounds = 0;
    PolygonMesh wedge = trisect::make_box({0.1, 0.1, 0.1}, {7.3, 6.9, 5.7});
    for (trisect::Point3d& p : wedge.points)
        if (p[2] > 1) p[2] = 0.1 + 0x1p-30 * (p[0] + p[1]);
    const Brep brep = evaluate(Expression(Solid::from_mesh(wedge)) -
                               Expression(Solid::from_mesh(trisect::make_icosphere(5, 1))))
                          .to_brep();
    const CertifiedRounding r = certified_rounding(brep, none);
    EXPECT_EQ(r.rounds, 0U);
    EXPECT_EQ(r.outcome == Outcome::Failed, !r.certificate.holds());
}

}  // namespace
