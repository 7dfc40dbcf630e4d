// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/facet_marks.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "engines/engines.h"

namespace {

using namespace trisect::detail;
using Visits = std::vector<std::pair<std::uint32_t, bool>>;

struct Seen {
    Visits visits;
    int groups = 0;
};

Seen by_groups(const FacetMarks& marks) {
    Seen seen;
    marks.for_each_whole(
        0, marks.group_count(),
        [&](std::uint32_t facet) {
            ++seen.groups;
            for (std::uint32_t k = 0; k < 8; ++k) seen.visits.emplace_back(facet + k, false);
        },
        [&](std::uint32_t facet, bool flipped) { seen.visits.emplace_back(facet, flipped); });
    return seen;
}

Visits one_by_one(const FacetMarks& marks) {
    Visits out;
    marks.for_each_whole(
        [&](std::uint32_t facet, bool flipped) { out.emplace_back(facet, flipped); });
    return out;
}

// The twelve facets of a box: a group of eight and half a group.
class FacetMarksOfABox : public testing::Test {
protected:
    std::shared_ptr<const Source> source_ =
        Source::make(engines::lattice_mesh(reference::box({0, 0, 0}, {4, 4, 4})));
    FacetMarks marks_{source_.get()};
};

TEST_F(FacetMarksOfABox, WholeGroupIsVisitedAtOnceAndHalfAGroupFacetByFacet) {
    for (std::uint32_t f = 0; f < 12; ++f) marks_.set_present(f, false);
    const Seen seen = by_groups(marks_);
    EXPECT_EQ(seen.groups, 1);
    EXPECT_EQ(seen.visits.size(), 12U);
    EXPECT_EQ(seen.visits, one_by_one(marks_));
}

TEST_F(FacetMarksOfABox, GroupWithAFlippedOrAWorkedFacetIsVisitedFacetByFacet) {
    for (std::uint32_t f = 0; f < 12; ++f) marks_.set_present(f, f == 3);
    EXPECT_EQ(by_groups(marks_).groups, 0);
    EXPECT_EQ(by_groups(marks_).visits, one_by_one(marks_));
    marks_.set_present(3, false);  // both ways
    EXPECT_EQ(by_groups(marks_).groups, 0);
    EXPECT_EQ(by_groups(marks_).visits.size(), 13U);
    marks_.set_worked(3, true);  // the other way passes through
    EXPECT_EQ(by_groups(marks_).groups, 1);
    marks_.set_worked(3, false);
    EXPECT_EQ(by_groups(marks_).groups, 0);
    EXPECT_EQ(by_groups(marks_).visits, one_by_one(marks_));
}

TEST_F(FacetMarksOfABox, RandomMarksAreVisitedInTheOrderOfFacets) {
    std::mt19937 random(1);
    for (int round = 0; round < 200; ++round) {
        FacetMarks marks(source_.get());
        for (std::uint32_t f = 0; f < 12; ++f)
            for (const bool flipped : {false, true}) {
                if ((random() % 16 == 0) == flipped) marks.set_present(f, flipped);
                if (random() % 20 == 0) marks.set_worked(f, flipped);
            }
        EXPECT_EQ(by_groups(marks).visits, one_by_one(marks)) << "round " << round;
    }
}

}  // namespace
