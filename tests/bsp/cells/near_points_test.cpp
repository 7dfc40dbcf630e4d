// SPDX-License-Identifier: Apache-2.0
//
// Groups of points that may be equal: the corners of boxes of a grid, where many points share a
// coordinate and several boxes share a corner, which their planes name in other ways again.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <trisect/bsp/cells/near_points.h>

#include "engines/engines.h"

namespace {

using trisect::detail::PlaneId;
using trisect::detail::PlaneName;
using trisect::detail::PointId;
using trisect::detail::Source;
using trisect::detail::Workbench;

/// Every corner of the box by name, and as the common point of three of its sides.
void add_points(const Source& source, Workbench& bench) {
    std::vector<PlaneId> sides;
    for (std::uint32_t f = 0; f < 12; ++f) {
        sides.push_back(bench.plane(PlaneName::support(&source, f)));
        for (int i = 0; i < 3; ++i) (void)bench.corner(&source, f, i);
    }
    for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t j = i + 1; j < 12; ++j)
            for (std::size_t k = j + 1; k < 12; ++k)
                if (trisect::meet_in_a_point(bench.plane_at(sides[i]), bench.plane_at(sides[j]),
                                             bench.plane_at(sides[k])))
                    (void)bench.meet(sides[i], sides[j], sides[k]);
}

std::vector<std::vector<PointId>> groups_of(const Workbench& bench, std::uint32_t threads = 1) {
    std::vector<std::vector<PointId>> groups;
    trisect::detail::for_each_near_group(
        bench,
        [&](std::span<const PointId> group) { groups.emplace_back(group.begin(), group.end()); },
        threads);
    return groups;
}

TEST(NearPoints, CornersOfAGridOfBoxesAreGroupedByValue) {
    std::vector<std::shared_ptr<const Source>> sources;
    Workbench bench;
    for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 3; ++y)
            for (int z = 0; z < 3; ++z) {
                const auto box =
                    reference::box({2 * x, 2 * y, 2 * z}, {2 * x + 2, 2 * y + 2, 2 * z + 2});
                sources.push_back(Source::make(engines::lattice_mesh(box)));
                add_points(*sources.back(), bench);
            }
    std::map<PointId, std::size_t> group_of;
    const auto groups = groups_of(bench);
    EXPECT_EQ(groups.size(), 64U);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        EXPECT_TRUE(std::ranges::is_sorted(groups[g]));
        for (const PointId p : groups[g]) {
            EXPECT_TRUE(group_of.insert({p, g}).second);
            EXPECT_TRUE(bench.same_point(p, groups[g][0]));
        }
    }
    EXPECT_EQ(group_of.size(), bench.point_count());
}

TEST(NearPoints, GroupsAreTheSameOnThreads) {
    std::vector<std::shared_ptr<const Source>> sources;
    Workbench bench;
    for (int i = 0; i < 6 * 6 * 8; ++i) {
        const std::array<int, 3> at{2 * (i % 6), 2 * (i / 6 % 6), 2 * (i / 36)};
        sources.push_back(Source::make(engines::lattice_mesh(
            reference::box({at[0], at[1], at[2]}, {at[0] + 2, at[1] + 2, at[2] + 2}))));
        add_points(*sources.back(), bench);
    }
    ASSERT_GT(bench.point_count(), 16384U);  // fewer are looked at by one thread
    const auto groups = groups_of(bench);
    EXPECT_EQ(groups.size(), std::size_t{7 * 7 * 9});
    for (const std::uint32_t threads : {2U, 5U}) EXPECT_EQ(groups_of(bench, threads), groups);
}

TEST(NearPoints, APointAloneIsInNoGroup) {
    const auto source = Source::make(engines::lattice_mesh(reference::box({0, 0, 0}, {4, 4, 4})));
    Workbench bench;
    EXPECT_TRUE(groups_of(bench).empty());
    for (std::uint32_t f = 0; f < 12; ++f)
        for (int i = 0; i < 3; ++i) (void)bench.corner(source.get(), f, i);
    EXPECT_EQ(bench.point_count(), 8U);
    EXPECT_TRUE(groups_of(bench).empty());
}

TEST(NearPoints, NeighboursAtTheEdgeOfTheLatticeKeepEqualOnesTogether) {
    constexpr std::int64_t far = (std::int64_t{1} << 52) - 8;
    const auto a = Source::make(
        engines::lattice_mesh(reference::box({far, far, far}, {far + 1, far + 1, far + 1})));
    const auto b = Source::make(
        engines::lattice_mesh(reference::box({far + 1, far, far}, {far + 2, far + 1, far + 1})));
    Workbench bench;
    add_points(*a, bench);
    add_points(*b, bench);
    std::map<PointId, std::size_t> group_of;
    const auto groups = groups_of(bench);
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (const PointId p : groups[g]) group_of[p] = g + 1;
    const auto n = static_cast<PointId>(bench.point_count());
    for (PointId p = 0; p < n; ++p)
        for (PointId q = p + 1; q < n; ++q)
            if (bench.same_point(p, q)) {
                EXPECT_NE(group_of[p], 0U);
                EXPECT_EQ(group_of[p], group_of[q]);
            }
}

}  // namespace
