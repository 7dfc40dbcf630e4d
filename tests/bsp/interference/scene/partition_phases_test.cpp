// SPDX-License-Identifier: Apache-2.0
//
// What the partitions of space cost as broad phases, in counts: linear for similar sizes, and
// graceful where sizes differ.
#include <trisect/bsp/interference/scene/broad_phases.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "reference/random_solids.h"

namespace {

using reference::Random;
using trisect::detail::BodyBox;
using trisect::detail::BodyPair;
using trisect::detail::BroadPhase;
using trisect::detail::BroadPhaseWork;

/// A box with sides from size / 2 to size, somewhere in a cube; all multiples of 1/16.
BodyBox box_of_size(Random& random, double size, double room) {
    BodyBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] =
            static_cast<double>(random.between(0, static_cast<std::int64_t>(room * 16))) / 16;
        box.hi[k] = box.lo[k] + size * static_cast<double>(random.between(8, 16)) / 16;
    }
    return box;
}

/// So that every one of n boxes of size 1 meets about one other.
double room_for(std::size_t n) { return 2 * std::cbrt(static_cast<double>(n)); }

struct Outcome {
    BroadPhaseWork work;
    std::size_t found = 0;
};

Outcome run(BroadPhase& phase, const std::vector<BodyBox>& boxes) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) phase.insert(i, boxes[i]);
    std::vector<BodyPair> pairs;
    phase.pairs(pairs);
    return {phase.work(), pairs.size()};
}

std::size_t all_pairs(const std::vector<BodyBox>& boxes) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) n += boxes[i].meets(boxes[j]) ? 1 : 0;
    return n;
}

TEST(PartitionPhases, SimilarSizesTakeAFewCellsATestAndALookUpEach) {
    for (const std::size_t n : {500U, 4000U, 32000U}) {
        Random random(n);
        std::vector<BodyBox> boxes;
        for (std::size_t i = 0; i < n; ++i) boxes.push_back(box_of_size(random, 1, room_for(n)));
        const auto grid = run(*trisect::hierarchies::make_hash_grid(), boxes);
        const auto grids = run(*trisect::hierarchies::make_hierarchical_grid(), boxes);
        const auto octree = run(*trisect::hierarchies::make_octree_phase(), boxes);
        const auto kd = run(*trisect::hierarchies::make_kd_tree_phase(), boxes);
        for (const Outcome& r : {grids, octree, kd}) EXPECT_EQ(r.found, grid.found);
        // The same bounds for all n.
        EXPECT_LE(grid.work.cells, 5 * n);
        EXPECT_LE(grid.work.box_tests, 8 * n);
        EXPECT_EQ(grids.work.cells, n);
        // Sides from 1/2 to 1: at most two grids, 27 cells in each.
        EXPECT_LE(grids.work.lookups, 2 * 27 * n);
        EXPECT_LE(grids.work.box_tests, 16 * n);
        EXPECT_LE(kd.work.cells, 4 * n + 64);
        EXPECT_LE(kd.work.box_tests, 40 * n);
        EXPECT_LE(octree.work.box_tests, 40 * n);
    }
}

TEST(PartitionPhases, AGiantAmongDwarfs) {
    Random random(5);
    constexpr std::size_t n = 5000;
    const double room = room_for(n);
    std::vector<BodyBox> boxes;
    for (std::size_t i = 0; i < n; ++i) boxes.push_back(box_of_size(random, 1, room));
    for (std::size_t i = 0; i < 4; ++i) boxes.push_back(box_of_size(random, room / 2, room / 2));
    const std::size_t expected = all_pairs(boxes);
    const auto grid = run(*trisect::hierarchies::make_hash_grid(), boxes);
    const auto grids = run(*trisect::hierarchies::make_hierarchical_grid(), boxes);
    const auto octree = run(*trisect::hierarchies::make_octree_phase(), boxes);
    const auto kd = run(*trisect::hierarchies::make_kd_tree_phase(), boxes);
    for (const Outcome& r : {grid, grids, octree, kd}) EXPECT_EQ(r.found, expected);
    // The uniform grid compares each giant with everything, and nothing else grows.
    EXPECT_LE(grid.work.cells, 5 * n + 4);
    EXPECT_LE(grid.work.box_tests, (8 + 4) * n);
    EXPECT_GE(grid.work.box_tests, 4 * n);
    // A dwarf looks into 27 cells of one more grid.
    EXPECT_EQ(grids.work.cells, n + 4);
    EXPECT_LE(grids.work.lookups, 4 * 27 * n);
    EXPECT_LE(grids.work.box_tests, (16 + 4) * n);
    EXPECT_LE(kd.work.cells, 4 * n + 100);
}

// Sizes over twelve powers of two: no uniform grid suits them.
TEST(PartitionPhases, SizesOfAllKindsAreWhatTheHierarchicalGridIsFor) {
    Random random(6);
    constexpr std::size_t n = 4000;
    std::vector<BodyBox> boxes;
    for (std::size_t i = 0; i < n; ++i) {
        const auto power = static_cast<int>(random.between(-6, 6));
        boxes.push_back(box_of_size(random, std::ldexp(1.0, power), 400));
    }
    const std::size_t expected = all_pairs(boxes);
    const auto grid = run(*trisect::hierarchies::make_hash_grid(), boxes);
    const auto grids = run(*trisect::hierarchies::make_hierarchical_grid(), boxes);
    EXPECT_EQ(grid.found, expected);
    EXPECT_EQ(grids.found, expected);
    EXPECT_EQ(grids.work.cells, boxes.size());
    EXPECT_LT(10 * grids.work.box_tests, grid.work.box_tests);
}

TEST(PartitionPhases, OnlyWhatChangesItsCellIsMovedInTheHierarchicalGrid) {
    const auto phase = trisect::hierarchies::make_hierarchical_grid();
    Random random(7);
    std::vector<BodyBox> boxes;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        boxes.push_back(box_of_size(random, 0.99, 50));
        phase->insert(i, boxes.back());
    }
    std::vector<BodyPair> pairs;
    phase->pairs(pairs);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        boxes[i].lo[0] += 1.0 / 64;
        boxes[i].hi[0] += 1.0 / 64;
        phase->update(i, boxes[i]);
    }
    phase->pairs(pairs);
    EXPECT_EQ(pairs.size(), all_pairs(boxes));
    // No corner that is a multiple of 1/16 enters the next cell by a step of 1/64.
    EXPECT_EQ(phase->work().moves, 0U);
}

}  // namespace
