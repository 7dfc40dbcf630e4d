// SPDX-License-Identifier: Apache-2.0
//
// Each field of a certificate of contact under enclosed motions, wrong on its own in a named
// configuration, and motions that are not known: the checker says what is wrong.

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/enclosed_certificate.h>
#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/bsp/solid.h>

#include "refusals.h"
#include "support/models.h"
#include "support/reason.h"

namespace enclosed_refusals_test {
namespace {

using models::box;
using refusals::expect_refused;
using refusals::of_triangles;
using trisect::EnclosedCertificate;
using trisect::EnclosedContact;
using trisect::EnclosedFreedomNode;
using trisect::EnclosedMotion;
using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::KeyFrame;
using trisect::Motion;
using trisect::MotionEnclosure;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;
using Outcome = EnclosedContact::Outcome;
using Changes = std::vector<refusals::Change<EnclosedCertificate>>;
using C = EnclosedCertificate;

constexpr const char* not_separate = "a plane does not separate";
constexpr const char* not_deep = "a point is not deep inside both";
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Case {
    InterferenceModel a;
    EnclosedMotion motion_a;
    InterferenceModel b;
    EnclosedMotion motion_b;

    [[nodiscard]] EnclosedCertificate certificate() const {
        return certify_enclosed_contact(a, motion_a, b, motion_b, {});
    }
    [[nodiscard]] std::string check(const EnclosedCertificate& c) const {
        return refusals::reason(trisect::check(c, a.brep(), motion_a, b.brep(), motion_b));
    }
};

// From place to place, in one unit of time each.
EnclosedMotion through(const std::vector<std::array<double, 3>>& places) {
    std::vector<KeyFrame> frames;
    for (const auto& p : places)
        frames.push_back({static_cast<double>(frames.size()), {1, 0, 0, 0}, p});
    return EnclosedMotion::through(frames);
}

EnclosedFreedomNode upright(double x) {
    EnclosedFreedomNode n;
    n.plane = {{1, 0, 0}, -ExactRational::from_double(x)};
    return n;
}

// A cube of side 1 that comes from 2 away and stops half in the other one.
TEST(EnclosedRefusals, OfACubeThatRunsIntoAnother) {
    const Case c{box(0, 0, 0, 1, 1, 1), EnclosedMotion(), box(0, 0, 0, 1, 1, 1),
                 through({{3, 0, 0}, {0.5, 0, 0}})};
    const EnclosedCertificate right = c.certificate();
    ASSERT_TRUE(right.is_complete);
    ASSERT_EQ(right.answer.outcome, Outcome::Contact);
    ASSERT_EQ(right.free.size(), 1U);
    auto changes = of_triangles(&C::triangles_a);
    const auto of_b = of_triangles(&C::triangles_b);
    changes.insert(changes.end(), of_b.begin(), of_b.end());
    const char* outside = "a span is not within the motion";
    const Changes more{
        {"there is no time of contact", [](C& d) { d.answer.contact_by.reset(); }},
        {"the contact is not within the motion", [](C& d) { d.answer.contact_by = -0.5; }},
        {"the contact is not within the motion", [](C& d) { d.answer.contact_by = 1.5; }},
        {"the contact is not within the motion", [](C& d) { d.answer.contact_by = not_a_number; }},
        {not_deep, [](C& d) { d.answer.contact_by = 0; }},
        {not_deep, [](C& d) { (*d.in_both)[1] += ExactRational(50); }},
        {"the contact is not proved", [](C& d) { d.in_both.reset(); }},
        {"", [](C& d) { d.in_both.reset(), d.is_complete = false; }},
        {"the outcome is another one", [](C& d) { d.answer.outcome = Outcome::None; }},
        {"the outcome is another one", [](C& d) { d.answer.outcome = Outcome::Undecided; }},
        {"times are missing", [](C& d) { d.free.clear(); }},
        {"times are missing", [](C& d) { d.free[0].span.to /= 2; }},
        {"it is not free for so long", [](C& d) { d.answer.free_until = *d.answer.contact_by; }},
        {"it is not free for so long", [](C& d) { d.answer.free_until = not_a_number; }},
        {"", [](C& d) { d.answer.free_until = 0.25; }},
        {outside, [](C& d) { d.free[0].span.from = -0.5; }},
        {outside, [](C& d) { d.free[0].span.from = not_a_number; }},
        {outside, [](C& d) { d.free[0].span.from = d.free[0].span.to * 1.5; }},
        {outside, [](C& d) { d.free[0].span.to = 1.5; }},
        {outside, [](C& d) { d.free[0].span.to = not_a_number; }},
        // They overlap at the end.
        {not_separate, [](C& d) { d.free[0].span.to = 1; }},
        {"the start of a span is not proved",
         [](C& d) { d.free[0].at_start.relation = Relation::Touching; }},
        {"the start of a span is not proved", [](C& d) { d.free[0].at_start.is_complete = false; }},
        {"at the start of a span: no proof that the boundaries are apart",
         [](C& d) { d.free[0].at_start.apart.clear(); }},
        {"the tree is no tree", [](C& d) { d.free[0].start.clear(); }},
        {"the tree is no tree", [](C& d) { d.free[0].freedom.clear(); }},
        // At the start the gap goes from 1 to 3; later on it closes.
        {"", [](C& d) { d.free[0].start = {upright(2)}; }},
        {not_separate, [](C& d) { d.free[0].start = {upright(1)}; }},
        {not_separate, [](C& d) { d.free[0].start = {upright(3)}; }},
        {not_separate, [](C& d) { d.free[0].start = {EnclosedFreedomNode()}; }},
        {not_separate, [](C& d) { d.free[0].freedom = {upright(2)}; }},
        {"a time is not in its range",
         [](C& d) {
             EnclosedFreedomNode split;
             split.kind = EnclosedFreedomNode::Kind::SplitTime;
             split.other = 2;
             d.free[0].start = {split, upright(2), upright(2)};
         }},
        {"",
         [](C& d) {
             EnclosedFreedomNode split;
             split.kind = EnclosedFreedomNode::Kind::SplitA;
             split.other = 2;
             d.free[0].start = {split, upright(2), upright(2)};
         }},
    };
    changes.insert(changes.end(), more.begin(), more.end());
    expect_refused(c, right, changes);
}

// It turns back before it arrives, at a time that no range may go past.
TEST(EnclosedRefusals, OfACubeThatTurnsBack) {
    const Case c{box(0, 0, 0, 1, 1, 1), EnclosedMotion(), box(0, 0, 0, 1, 1, 1),
                 through({{3, 0, 0}, {1.5, 0, 0}, {3, 0, 0}})};
    const EnclosedCertificate right = c.certificate();
    ASSERT_TRUE(right.is_complete);
    ASSERT_EQ(right.answer.outcome, Outcome::None);
    ASSERT_EQ(right.free.size(), 1U);
    const auto halved = [](double time, double x) {
        EnclosedFreedomNode split;
        split.kind = EnclosedFreedomNode::Kind::SplitTime;
        split.other = 2;
        split.time = time;
        return [=](C& d) { d.free[0].freedom = {split, upright(x), upright(x)}; };
    };
    const Changes changes{
        {"", halved(1, 1.25)},
        {not_separate, halved(1, 1.75)},
        {"a motion has a kink in a range", halved(0.5, 1.25)},
        {"a motion has a kink in a range", [](C& d) { d.free[0].freedom = {upright(1.25)}; }},
        {"times are missing", [=](C& d) { halved(1, 1.25)(d), d.free[0].span.to = 1.5; }},
        {"the outcome is another one", [](C& d) { d.answer.outcome = Outcome::Contact; }},
        {"the outcome is another one",
         [](C& d) {
             d.answer.undecided = {{0.5, 1}};
         }},
        {"",
         [](C& d) {
             d.answer.undecided = {{0.5, 1}};
             d.answer.outcome = Outcome::Undecided;
         }},
        {"the contact is not proved", [](C& d) { d.answer.contact_by = 1; }},
    };
    expect_refused(c, right, changes);
    // The same with both exchanged: the kink is one of A.
    const Case exchanged{c.b, c.motion_b, c.a, c.motion_a};
    EnclosedCertificate other = exchanged.certificate();
    ASSERT_EQ(exchanged.check(other), "");
    EnclosedFreedomNode plane = upright(1.25);
    refusals::turn_over(plane.plane);
    other.free[0].freedom = {plane};
    EXPECT_EQ(exchanged.check(other), "a motion has a kink in a range");
}

TEST(EnclosedRefusals, OfNothing) {
    const InterferenceModel nothing{Solid()};
    const Case cases[]{
        {nothing, EnclosedMotion(), box(0, 0, 0, 1, 1, 1), through({{}, {1, 0, 0}})},
        {box(0, 0, 0, 1, 1, 1), EnclosedMotion(), nothing, through({{}, {1, 0, 0}})}};
    for (const Case& c : cases)
        expect_refused<Case, C>(
            c, c.certificate(),
            {{"an empty solid touches nothing", [](C& d) { d.answer.outcome = Outcome::Contact; }},
             {"an empty solid touches nothing",
              [](C& d) { d.answer.outcome = Outcome::Undecided; }}});
}

// A frame that comes down around a post, which no single plane keeps from it.
TEST(EnclosedRefusals, TooFewNodesAreIncomplete) {
    const auto of_box = [](double x0, double y0, double z0, double x1, double y1, double z1) {
        return trisect::Expression(Solid::from_mesh(trisect::make_box({x0, y0, z0}, {x1, y1, z1})));
    };
    const Case c{
        box(-1, -1, 0, 1, 1, 4), EnclosedMotion(),
        InterferenceModel(evaluate(of_box(-4, -4, 5, 4, 4, 6) - of_box(-2, -2, 4, 2, 2, 7))),
        through({{0, 0, 0}, {0, 0, -4}})};
    const EnclosedCertificate few =
        certify_enclosed_contact(c.a, c.motion_a, c.b, c.motion_b, {}, 3);
    EXPECT_FALSE(few.is_complete);
    EXPECT_EQ(few.answer.outcome, Outcome::None);
    EXPECT_EQ(c.check(few), "");
    EXPECT_TRUE(c.certificate().is_complete);
}

// Like another motion, but for what it says of how far it deviates.
class Told : public trisect::MotionLaw {
public:
    Told(EnclosedMotion motion, std::function<void(MotionEnclosure&)> change)
        : motion_(std::move(motion)), change_(std::move(change)) {}
    [[nodiscard]] MotionEnclosure enclose(double from, double to) const override {
        MotionEnclosure e = motion_.enclose(from, to);
        change_(e);
        return e;
    }

private:
    EnclosedMotion motion_;
    std::function<void(MotionEnclosure&)> change_;
};

// Proofs about a motion that is known say nothing of one that is not, nor of one that deviates by
// more than the gap or the depth.
TEST(EnclosedRefusals, MotionsThatAreNotKnown) {
    const Case c{box(0, 0, 0, 1, 1, 1), EnclosedMotion(), box(0, 0, 0, 1, 1, 1),
                 through({{3, 0, 0}, {0.5, 0, 0}})};
    const EnclosedCertificate right = c.certificate();
    ASSERT_EQ(c.check(right), "");
    EnclosedCertificate contact_only = right;
    contact_only.is_complete = false;
    contact_only.free.clear();
    ASSERT_EQ(c.check(contact_only), "");
    constexpr double infinity = std::numeric_limits<double>::infinity();
    auto piece = trisect::detail::MotionPiece::still();
    piece.weight = trisect::detail::IntegerPolynomial({1, -2});
    const Motion without_end = trisect::detail::motion_of(piece);
    const std::vector<std::function<void(MotionEnclosure&)>> changes{
        [](MotionEnclosure& e) { e.by_length = infinity; },
        [](MotionEnclosure& e) { e.constant = infinity; },
        [](MotionEnclosure& e) { e.by_length = not_a_number; },
        [](MotionEnclosure& e) { e.constant = not_a_number; },
        [](MotionEnclosure& e) { e.by_length = -1; },
        [](MotionEnclosure& e) { e.constant = -1; },
        [](MotionEnclosure& e) { e.constant = 3; },
        [](MotionEnclosure& e) { e.by_length = 3; },
    };
    for (const auto& change : changes) {
        const auto told = [&](const EnclosedMotion& motion) {
            return EnclosedMotion(std::make_shared<Told>(motion, change), {0, 1});
        };
        const Case b_unknown{c.a, c.motion_a, c.b, told(c.motion_b)};
        const Case a_unknown{c.a, told(c.motion_a), c.b, c.motion_b};
        EXPECT_EQ(b_unknown.check(right), not_separate);
        EXPECT_EQ(a_unknown.check(right), not_separate);
        EXPECT_EQ(b_unknown.check(contact_only), not_deep);
        EXPECT_EQ(a_unknown.check(contact_only), not_deep);
    }
    // Two pieces where one is promised, and a weight with a root: these move nothing, so the proof
    // would hold otherwise.
    const Case resting{box(0, 0, 0, 1, 1, 1), EnclosedMotion(), box(3, 0, 0, 4, 1, 1),
                       through({{0, 0, 0}, {0, 0, 0}})};
    const EnclosedCertificate apart = resting.certificate();
    ASSERT_EQ(resting.check(apart), "");
    for (const Motion& motion : {Motion().then(Motion()), without_end}) {
        const auto law = std::make_shared<Told>(
            EnclosedMotion(), [&motion](MotionEnclosure& e) { e.motion = motion; });
        EXPECT_EQ((Case{resting.a, EnclosedMotion(law, {0, 1}), resting.b, resting.motion_b}.check(
                      apart)),
                  not_separate);
    }
}

}  // namespace
}  // namespace enclosed_refusals_test
