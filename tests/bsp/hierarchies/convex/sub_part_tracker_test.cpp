// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/hierarchies/convex/sub_part_tracker.h>

#include <gtest/gtest.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/kernel/error.h>

#include <trisect/bsp/interference/relation/interference_model_data.h>

#include "engines/engines.h"
#include "reference/random_solids.h"

namespace {

using namespace trisect;
using namespace trisect::hierarchies;

// Distances, not bounded features: what the tree of oriented boxes finds.
void expect_right(SubPartTracker& tracker, const InterferenceModel& a, const Pose& pose_a,
                  const InterferenceModel& b, const Pose& pose_b) {
    tracker.update(pose_a, pose_b);
    const ExactRational exact = *exact_squared_distance(a, pose_a, b, pose_b);
    ASSERT_EQ(tracker.squared_distance(), exact);
    EXPECT_EQ(tracker.meet(), exact.sign() == 0);
    const auto square = [](double v) {
        return ExactRational::from_double(v) * ExactRational::from_double(v);
    };
    EXPECT_LE(square(tracker.bounds().lower), exact);
    EXPECT_GE(square(tracker.bounds().upper), exact);
}

TEST(SubPartTracker, RandomSolidsOnASmallGridWithAllBranchings) {
    int compared = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        reference::Random random(seed);
        const InterferenceModel a(engines::solid(reference::random_embedded_solid(random)));
        const InterferenceModel b(engines::solid(reference::random_embedded_solid(random)));
        if (a.is_empty() || b.is_empty() || !trisect::detail::data_of(a).all_lattice ||
            !trisect::detail::data_of(b).all_lattice)
            continue;
        const HullTreeOptions options{2U << seed % 4, 1};
        const HullTree ta(a, options);
        const HullTree tb(b, options);
        SubPartTracker tracker(a, ta, b, tb);
        for (int i = 0; i < 6; ++i) {
            const auto some = [&random](int most) {
                return static_cast<double>(random.between(-most, most));
            };
            const Pose pose = i % 2 == 0 ? Pose::from_translation({some(12), some(12), some(4)})
                                         : Pose::from_quaternion({3, random.between(-2, 2), 0, 1},
                                                                 {some(12), some(12), some(4)});
            expect_right(tracker, a, Pose(), b, pose);
            ++compared;
        }
    }
    EXPECT_GT(compared, 100);
}

TEST(SubPartTracker, TwoToriTurningThroughEachOther) {
    const InterferenceModel torus(Solid::from_mesh(make_torus(4, 1, 24, 12)));
    const HullTree tree(torus, {4, 1});
    SubPartTracker tracker(torus, tree, torus, tree);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(i);
        const Pose pose = Pose::from_quaternion({20, 20, i - 30, 0}, {4.0 + i / 16.0, 0, 0.0});
        expect_right(tracker, torus, Pose(), torus, pose);
    }
}

TEST(SubPartTracker, ANotchOnTheFarSideIsNeverLookedInto) {
    const Solid cube = Solid::from_mesh(make_box({0, 0, 0}, {4, 4, 4}));
    const Solid notch = Solid::from_mesh(make_box({2, 2, -1}, {5, 5, 5}));
    const InterferenceModel l(evaluate(cube - notch));
    const HullTree tree(l, {4, 1});
    SubPartTracker tracker(l, tree, l, tree);
    // Turned by half, back to back: real faces.
    expect_right(tracker, l, Pose(), l, Pose::from_quaternion({0, 0, 0, 1}, {-1, 4, 0}));
    EXPECT_EQ(tracker.counts().walks.walks, 1U);
    EXPECT_EQ(tracker.counts().accepted, 1U);
    // A corner of one into the notch of the other.
    expect_right(tracker, l, Pose(), l, Pose::from_translation({2.5, 2.5, 0}));
    EXPECT_GT(tracker.counts().opened, 0U);
}

TEST(SubPartTracker, RefusesLargeLeaves) {
    const InterferenceModel box(Solid::from_mesh(make_box({0, 0, 0}, {1, 1, 1})));
    const HullTree tree(box, {2, 4});
    EXPECT_THROW(SubPartTracker(box, tree, box, tree), UsageError);
}

}  // namespace
