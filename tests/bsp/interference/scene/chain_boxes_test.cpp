// SPDX-License-Identifier: Apache-2.0
//
// Boxes of a snake's links: what a frame costs in counts. Answers: articulated_test.cpp.

#include <trisect/bsp/interference/scene/chain_boxes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace {

using trisect::detail::BodyBox;
using trisect::detail::BodyPair;
using trisect::hierarchies::make_chain_boxes;

// A box about each link of a chain bent by the same angle at every joint.
std::vector<BodyBox> snake(std::size_t links, double bend) {
    std::vector<BodyBox> r;
    double x = 0;
    double y = 0;
    for (std::size_t i = 0; i < links; ++i) {
        const double a = bend * static_cast<double>(i);
        const double u = x + std::cos(a);
        const double v = y + std::sin(a);
        r.push_back({{std::min(x, u) - 0.1, std::min(y, v) - 0.1, -0.1},
                     {std::max(x, u) + 0.1, std::max(y, v) + 0.1, 0.1}});
        x = u;
        y = v;
    }
    return r;
}

TEST(ChainBoxes, AStretchedChainIsPartedByItsUpperBoxes) {
    for (const std::size_t links : {64U, 1024U}) {
        const auto phase = make_chain_boxes();
        const auto boxes = snake(links, 0.001);
        for (std::uint32_t i = 0; i < links; ++i) phase->insert(i, boxes[i]);
        std::vector<BodyPair> pairs;
        phase->pairs(pairs);
        EXPECT_EQ(pairs.size(), links - 1);  // each meets the next one
        EXPECT_LT(phase->work().box_tests, 9 * links);
    }
}

TEST(ChainBoxes, WhatMovedIsRefittedAndNothingElse) {
    constexpr std::uint32_t links = 1024;
    const auto phase = make_chain_boxes();
    const auto boxes = snake(links, 0.001);
    for (std::uint32_t i = 0; i < links; ++i) phase->insert(i, boxes[i]);
    std::vector<BodyPair> pairs;
    phase->pairs(pairs);
    EXPECT_EQ(phase->work().moves, links - 1);
    phase->pairs(pairs);
    EXPECT_EQ(phase->work().moves, 0U);
    // The last joint turns: one link, ten levels.
    BodyBox moved = boxes[links - 1];
    moved.hi[2] += 1;
    phase->update(links - 1, moved);
    phase->pairs(pairs);
    EXPECT_EQ(phase->work().moves, 10U);
    EXPECT_EQ(pairs.size(), links - 1);
}

}  // namespace
