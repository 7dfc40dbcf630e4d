// SPDX-License-Identifier: Apache-2.0
//
// Certificates of the first overlap: those of random scenes are accepted, corrupted ones are not,
// and what they claim is so by definition, in rationals.

#include <trisect/bsp/interference/overlap_certificate.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

#include "support/certified_pair.h"
#include "support/interference_oracle.h"
#include "support/models.h"
#include "support/moving_pair.h"

namespace overlap_certificate_test {
namespace {

using models::box;
using moving::by;
using trisect::ClearanceNode;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::OverlapCertificate;
using trisect::Pose;
using trisect::Relation;
using trisect::Screw;
using trisect::Solid;
using trisect::SupportingPlane;

using Case = moving::OverlapPair;

// Clang 14 has no std::source_location.
void expect_proved(const Case& c, bool is_overlap, int line = __builtin_LINE()) {
    SCOPED_TRACE(line);
    const OverlapCertificate certificate = c.certificate();
    EXPECT_EQ(certificate.is_overlap, is_overlap);
    EXPECT_TRUE(certificate.is_complete) << certificate.missing;
    EXPECT_EQ(c.check(certificate), "");
}

TEST(OverlapCertificates, OfNamedConfigurations) {
    const auto floor = box(0, 0, 0, 4, 4, 1);
    const auto block = box(1, 1, 1, 2, 2, 2);
    expect_proved({{floor, Motion(), block, by(0, 0, -1)}}, true);  // from flush contact
    expect_proved({{floor, Motion(), block, by(0, 0, 1)}}, false);  // separating
    expect_proved({{floor, Motion(), block, by(6, 1, 0)}}, false);  // sliding off the floor
    expect_proved({{floor, Motion(), block, by(6, 1, -1)}}, true);  // and into it
    expect_proved({{floor, Motion(), box(1, 1, 3, 2, 2, 4), by(0, 0, -4)}}, true);   // falling
    expect_proved({{floor, Motion(), box(1, 1, 3, 2, 2, 4), by(0, 0, -2)}}, false);  // a touch
    expect_proved({{floor, Motion(), box(0, 0, 3, 4, 4, 4), by(0, 0, -4)}}, true);  // the same face
    expect_proved({{floor, Motion(), box(4, 4, 3, 5, 5, 4), by(0, 0, -4)}},
                  false);  // along an edge
    expect_proved({{floor, Motion(), box(4, 4, 1, 5, 5, 2), by(-1, -1, -1)}}, true);  // corners
    expect_proved({{floor, Motion(), box(5, 5, 2, 6, 6, 3), by(-2, -2, 0)}}, false);
    expect_proved({{floor, Motion(), box(-3, 5, 1, -2, 6, 2), by(4, -4, 0)}}, false);  // grazing
    expect_proved({{floor, Motion(), box(1, 1, 0, 2, 2, 4), by(0, 0, -4)}}, true);  // at the start
}

TEST(OverlapCertificates, OfTurns) {
    const auto arm = box(0, 0, 0, 3, 4, 1);
    Screw screw;
    screw.turn = {1, 0, 0, 1};
    // The farthest corner of the arm turns past a wall: grazing, missing it, and hitting it.
    expect_proved({{box(-1, 5, 0, 1, 6, 1), Motion(), arm, Motion::screw(Pose(), screw)}}, false);
    expect_proved({{box(-1, 5 + 0x1p-20, 0, 1, 6, 1), Motion(), arm, Motion::screw(Pose(), screw)}},
                  false);
    expect_proved({{box(-1, 5 - 0x1p-20, 0, 1, 6, 1), Motion(), arm, Motion::screw(Pose(), screw)}},
                  true);
    // Turning on the floor, against a wall that it touches, and away from it.
    expect_proved({{box(-9, -9, -1, 9, 9, 0), Motion(), arm, Motion::screw(Pose(), screw)}}, false);
    expect_proved({{box(3, 0, 0, 4, 9, 1), Motion(), arm, Motion::screw(Pose(), screw)}}, false);
    expect_proved({{box(3, -9, 0, 4, 0, 1), Motion(), arm, Motion::screw(Pose(), screw)}}, false);
    screw.turn = {1, 0, 0, -1};
    expect_proved({{box(3, 0, 0, 4, 9, 1), Motion(), arm, Motion::screw(Pose(), screw)}}, true);
    expect_proved({{box(3, 0, 0, 4, 0.5, 1), Motion(), arm, Motion::screw(Pose(), screw)}}, true);
    screw.shift = {0, 0, -2};
    expect_proved({{box(-9, -9, -2, 9, 9, -1), Motion(), arm, Motion::screw(Pose(), screw)}}, true);
}

TEST(OverlapCertificates, OfSolidsInEachOthersHollows) {
    const auto solid = [](const trisect::Expression& e) { return InterferenceModel(evaluate(e)); };
    const auto of_box = [](double x0, double y0, double z0, double x1, double y1, double z1) {
        return trisect::Expression(Solid::from_mesh(trisect::make_box({x0, y0, z0}, {x1, y1, z1})));
    };
    // A key that slides in its keyway, out of it, and up.
    const auto way =
        solid(of_box(0, 0, 0, 9, 9, 3) - of_box(3, -1, 1, 6, 10, 4) - of_box(2, -1, 1, 7, 10, 2));
    const auto key = solid(of_box(3, 0, 1, 6, 9, 3) | of_box(2, 0, 1, 7, 9, 2));
    expect_proved({{way, Motion(), key, by(0, 20, 0)}}, false);
    expect_proved({{way, Motion(), key, by(0, 0, 1)}}, true);
    expect_proved({{way, Motion(), key, by(0, 0, -1)}}, true);
    expect_proved({{key, Motion(), way, by(0, 7, 0)}}, false);
    // A block that falls through a hole that just fits, onto a bar across it.
    const auto plate = of_box(0, 0, 0, 6, 6, 1) - of_box(2, 2, -1, 4, 4, 2);
    const auto block = box(2, 2, 3, 4, 4, 4);
    expect_proved({{solid(plate), Motion(), block, by(0, 0, -9)}}, false);
    expect_proved({{solid(plate | of_box(0, 2.5, -2, 6, 3, -1)), Motion(), block, by(0, 0, -9)}},
                  true);
}

TEST(OverlapCertificates, OfPiecesAndBothMoving) {
    const std::vector<Pose> poses{Pose(), Pose::from_translation({1, 0, 3}),
                                  Pose::from_translation({2, 0, -4})};
    const auto floor = box(0, 0, 0, 8, 8, 1);
    expect_proved({{floor, Motion(), box(1, 1, 1, 2, 2, 2), Motion::through(poses)}}, true);
    expect_proved({{floor, Motion::through(poses), box(1, 1, 1, 2, 2, 2), Motion::through(poses)}},
                  false);
    // Down to the floor, on along it, and down: the event is where a piece begins.
    const std::vector<Pose> steps{Pose(), Pose::from_translation({0, 0, -1}),
                                  Pose::from_translation({1, 0, -1}),
                                  Pose::from_translation({1, 0, -2})};
    expect_proved({{floor, Motion(), box(1, 1, 2, 2, 2, 3), Motion::through(steps)}}, true);
}

// The extent of a model along an axis.
std::array<double, 2> extent(const InterferenceModel& m, std::size_t axis) {
    const auto& d = trisect::detail::data_of(m);
    return {std::ldexp(d.lo[axis], m.lattice().exponent),
            std::ldexp(d.hi[axis], m.lattice().exponent)};
}

// Half of the pairs start near each other, of these every other one with boxes side by side; they
// slide, come apart, or go on into each other.
Case random_case(std::uint64_t seed) {
    if (seed % 2 == 0) return {moving::random_pair(seed)};
    reference::Random random(seed);
    Case c{moving::random_pair(seed + 1000000)};
    const auto along = [&random](int reach) {
        return static_cast<double>(random.between(-reach, reach));
    };
    std::array<double, 3> at{along(8), along(8), along(8)};
    Screw screw;
    screw.shift = {along(8), along(8), along(8)};
    if (random.chance(1, 3)) screw.shift[random.below(3)] = 0;
    if (random.chance(1, 3)) screw.turn = {2, 0, 0, random.between(-2, 2)};
    if (seed % 4 == 1 && !c.a.is_empty() && !c.b.is_empty()) {
        const std::size_t axis = random.below(3);
        at = {along(3), along(3), along(3)};
        at[axis] = extent(c.a, axis)[1] - extent(c.b, axis)[0];
        if (random.chance(1, 2)) screw.shift[axis] = 0;
    }
    c.motion_b = Motion::screw(Pose::from_translation(at), screw);
    return c;
}

TEST(OverlapCertificates, OfRandomScenesAreAccepted) {
    int overlaps = 0;
    int touching = 0;
    for (std::uint64_t seed = 1; seed <= 600; ++seed) {
        const Case c = random_case(seed);
        const OverlapCertificate certificate = c.certificate();
        EXPECT_EQ(c.check(certificate), "") << "seed " << seed;
        EXPECT_TRUE(certificate.is_complete) << "seed " << seed << ": " << certificate.missing;
        overlaps += certificate.is_overlap ? 1 : 0;
        touching += certificate.at_start.relation == Relation::Touching ? 1 : 0;
    }
    RecordProperty("overlaps", overlaps);
    RecordProperty("touching", touching);
    EXPECT_GT(overlaps, 100);
    EXPECT_GT(600 - overlaps, 200);
    EXPECT_GT(touching, 30);
}

// In contact with the floor all the time, so that only the event at the wall is no contact alone.
TEST(OverlapCertificates, OfRandomSolidsThatSlideOnAFloorAndIntoAWall) {
    int into_wall = 0;
    int stopping_before = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        reference::Random random(seed + 3000);
        const InterferenceModel b(engines::solid(reference::random_embedded_solid(random)));
        if (b.is_empty()) continue;
        const double z = extent(b, 2)[0];
        const double gap = static_cast<double>(random.between(1, 6));
        const double wall = extent(b, 0)[1] + gap;
        const auto of_box = [](double x0, double y0, double z0, double x1, double y1, double z1) {
            return trisect::Expression(
                Solid::from_mesh(trisect::make_box({x0, y0, z0}, {x1, y1, z1})));
        };
        const InterferenceModel a(evaluate(of_box(-40, -40, z - 1, 40, 40, z) |
                                           of_box(wall, -40, z - 1, wall + 2, 40, z + 20)));
        const auto way = static_cast<double>(random.between(1, 9));
        const Case c{{a, Motion(), b, by(way, static_cast<double>(random.between(-5, 5)), 0)}};
        const OverlapCertificate certificate = c.certificate();
        EXPECT_EQ(certificate.at_start.relation, Relation::Touching) << "seed " << seed;
        EXPECT_TRUE(certificate.is_complete) << "seed " << seed << ": " << certificate.missing;
        EXPECT_EQ(certificate.is_overlap, way > gap) << "seed " << seed;
        EXPECT_EQ(certificate.polynomial.empty(), !certificate.is_overlap) << "seed " << seed;
        EXPECT_EQ(c.check(certificate), "") << "seed " << seed;
        ++(certificate.is_overlap ? into_wall : stopping_before);
    }
    EXPECT_GT(into_wall, 20);
    EXPECT_GT(stopping_before, 5);
}

// A motion whose poses at all sixteenths of its time are exact.
struct DyadicMotion {
    Screw screw;

    [[nodiscard]] Pose at(std::int64_t sixteenths) const {
        std::array<std::int64_t, 4> turn{16 * screw.turn[0]};
        std::array<double, 3> shift{};
        for (std::size_t i = 0; i < 3; ++i) {
            turn[i + 1] = sixteenths * screw.turn[i + 1];
            shift[i] = static_cast<double>(sixteenths) / 16 * screw.shift[i];
        }
        return Pose::from_quaternion(turn, shift);
    }
};

bool is_overlapping(Relation r) { return r != Relation::Disjoint && r != Relation::Touching; }

// Finder and checker of these proofs have code in common, so what is proved is compared with sets
// that are empty or not, by an engine that shares nothing with either.
TEST(OverlapCertificates, ClaimsAreSoAtAllSixteenthsOfTheTime) {
    int before = 0;
    int after = 0;
    int never = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        reference::Random random(seed + 7000);
        const reference::Operand solid_a = reference::random_embedded_solid(random);
        const std::int64_t off = random.between(6, 10);
        const reference::Operand solid_b =
            reference::translated(reference::random_embedded_solid(random), {0, 0, off});
        DyadicMotion motion;
        motion.screw.shift = {static_cast<double>(random.between(-2, 2)),
                              static_cast<double>(random.between(-2, 2)),
                              static_cast<double>(random.between(-12, -2))};
        if (random.chance(1, 3)) motion.screw.turn = {4, 0, 0, random.between(-2, 2)};
        const Case c{{InterferenceModel(engines::solid(solid_a)), Motion(),
                      InterferenceModel(engines::solid(solid_b)),
                      Motion::screw(Pose(), motion.screw)}};
        const OverlapCertificate certificate = c.certificate();
        ASSERT_EQ(c.check(certificate), "") << "seed " << seed;
        if (!certificate.is_complete) continue;
        const bool from_start = is_overlapping(certificate.at_start.relation);
        for (std::int64_t k = 0; k <= (from_start ? 0 : 16); ++k) {
            const ExactRational time = ExactRational(k).scaled(-4);
            const bool late = from_start || (certificate.is_overlap && certificate.upper < time);
            const bool is_known = late ? from_start || time < certificate.after.until
                                       : !certificate.is_overlap || time < certificate.lower;
            if (!is_known) continue;
            const brute::Scene scene{brute::Body::of(solid_a), brute::Body::of(solid_b), Pose(),
                                     motion.at(k)};
            const bool meet = !brute::contacts(c.a, scene.pose_a, c.b, scene.pose_b).empty();
            const std::optional<Relation> relation = brute::relation(scene, meet);
            if (!relation) continue;
            EXPECT_EQ(is_overlapping(*relation), late) << "seed " << seed << ", sixteenth " << k;
            ++(late ? after : certificate.is_overlap ? before : never);
        }
    }
    EXPECT_GT(before, 150);
    EXPECT_GT(after, 30);
    EXPECT_GT(never, 100);
}

// Another time for the event.
bool shift_event(OverlapCertificate& c, const ExactRational& by) {
    if (c.polynomial.empty()) return false;
    const ExactRational time = c.lower + by;
    if (time.sign() <= 0 || !(time < ExactRational(1))) return false;
    const ExactRational width = ExactRational(1).scaled(-60);
    c.polynomial = {-time, ExactRational(1)};
    c.lower = time - width;
    c.upper = time + width;
    return true;
}

// Takes the proof of a piece away; false where there is nothing to change.
bool corrupt_clearance(OverlapCertificate& c, reference::Random& random) {
    using Kind = ClearanceNode::Kind;
    if (c.clearance.empty()) return false;
    auto& tree = c.clearance[random.below(c.clearance.size())];
    ClearanceNode& n = tree[random.below(tree.size())];
    switch (random.below(5)) {
        case 0:
            if (n.kind == Kind::Separated) return false;
            n.other = 0;
            return true;
        case 1: {
            if (n.kind != Kind::Separated) return false;
            // Nothing need be kept away from an empty part.
            const trisect::ExactPoint none;
            if (n.plane.plane.normal == none && n.plane.along_a == none) return false;
            for (std::size_t k = 0; k < 3; ++k) {
                n.plane.plane.normal[k] = -n.plane.plane.normal[k];
                n.plane.along_a[k] = -n.plane.along_a[k];
            }
            n.plane.plane.offset = -n.plane.plane.offset;
            return true;
        }
        case 2:
            if (n.kind != Kind::SplitTime) return false;
            n.time += ExactRational(2);
            return true;
        case 3:
            if (n.kind != Kind::SplitA) return false;
            n.cut.normal = {};
            return true;
        default:
            tree.pop_back();
            return true;
    }
}

bool corrupt(OverlapCertificate& c, reference::Random& random) {
    switch (random.below(8)) {
        case 0:
            // The solids are free up to there, and for longer.
            return shift_event(c, -ExactRational(1).scaled(-12));
        case 1:
            return shift_event(c, ExactRational(1).scaled(-12));
        case 2:
            if (c.triangles_a.empty()) return false;
            c.triangles_a.pop_back();
            return true;
        case 3:
            if (c.triangles_b.empty()) return false;
            c.triangles_b[random.below(c.triangles_b.size())].vertex[1] = trisect::VertexId();
            return true;
        case 4:
            c.is_overlap = !c.is_overlap;
            return true;
        case 5:
            if (c.triangles_a.empty() || !c.is_overlap) return false;
            c.after.in_a[random.below(4)][random.below(3)] += ExactRational(1000);
            return true;
        case 6:
            if (c.triangles_a.empty() || !c.is_overlap) return false;
            c.after.until = c.upper;
            c.after.in_b[1] = c.after.in_b[0];
            return true;
        default:
            return corrupt_clearance(c, random);
    }
}

TEST(OverlapCertificates, CorruptedAreRejected) {
    reference::Random random(11);
    int corrupted = 0;
    for (std::uint64_t seed = 2000; corrupted < 1000; ++seed) {
        const Case c = random_case(seed);
        const OverlapCertificate right = c.certificate();
        for (int k = 0; k < 20; ++k) {
            OverlapCertificate wrong = right;
            if (!corrupt(wrong, random)) continue;
            EXPECT_NE(c.check(wrong), "") << "seed " << seed << ", change " << k;
            ++corrupted;
        }
    }
}

}  // namespace
}  // namespace overlap_certificate_test
