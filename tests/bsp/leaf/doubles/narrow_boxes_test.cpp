// SPDX-License-Identifier: Apache-2.0
//
// Boxes in 16 bits a number (narrow_boxes.h) against those in doubles.

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <trisect/bsp/leaf/doubles/narrow_boxes.h>

namespace trisect::detail {
namespace {

struct DoubleBox {
    Vector3 lo;
    Vector3 hi;
};

bool meet(const DoubleBox& a, const DoubleBox& b, double gap = 0) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a.lo[k] > b.hi[k] + gap || b.lo[k] > a.hi[k] + gap) return false;
    return true;
}

SingleBox single(const DoubleBox& b) {
    SingleBox out;
    for (std::size_t k = 0; k < 3; ++k) {
        out.lo[k] = static_cast<float>(b.lo[k]);
        out.down[k] = static_cast<float>(-b.hi[k]);
    }
    return out;
}

// Ends are singles.
std::vector<DoubleBox> random_boxes(std::mt19937_64& random, std::size_t count, double extent,
                                    double size) {
    std::uniform_real_distribution<double> place(-extent, extent);
    std::uniform_real_distribution<double> side(0, size);
    std::vector<DoubleBox> out(count);
    for (DoubleBox& b : out)
        for (std::size_t k = 0; k < 3; ++k) {
            b.lo[k] = static_cast<float>(place(random));
            b.hi[k] = static_cast<float>(b.lo[k] + side(random));
        }
    return out;
}

// Bit by bit.
std::vector<std::uint8_t> found_by(const NarrowBoxes& boxes, const DoubleBox& probe) {
    std::vector<std::uint64_t> words(boxes.word_count());
    boxes.find_meeting(boxes.narrow(single(probe)), words);
    std::vector<std::uint8_t> out(64 * words.size());
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<std::uint8_t>(words[i / 64] >> i % 64 & 1U);
    return out;
}

TEST(NarrowBoxes, FindAllThatMeetAndNoneThatAreClearlyApart) {
    std::mt19937_64 random(1);
    for (const std::size_t count : {1U, 3U, 16U, 17U, 63U, 64U, 65U, 200U}) {
        const std::vector<DoubleBox> listed = random_boxes(random, count, 50, 30);
        NarrowBoxes boxes;
        boxes.start(single({{-50, -50, -50}, {80, 80, 80}}));
        for (const DoubleBox& b : listed) boxes.add(single(b));
        EXPECT_EQ(boxes.size(), count);
        for (const DoubleBox& probe : random_boxes(random, 50, 50, 30)) {
            const std::vector<std::uint8_t> found = found_by(boxes, probe);
            for (std::size_t i = 0; i < found.size(); ++i) {
                if (i >= count) {
                    EXPECT_EQ(found[i], 0);
                } else if (meet(listed[i], probe)) {
                    EXPECT_EQ(found[i], 1);
                } else if (!meet(listed[i], probe, 2 * 130 * 0x1p-15)) {
                    EXPECT_EQ(found[i], 0);
                }
            }
        }
    }
}

TEST(NarrowBoxes, FindBoxesThatReachBeyondThePlaceOrTouch) {
    std::mt19937_64 random(2);
    // Places of no extent, and ones that hold a small part of the boxes.
    for (const auto& [lo, hi] : std::vector<DoubleBox>{{{0, 0, 0}, {0, 0, 0}},
                                                       {{-1, -1, 7}, {1, 2, 7}},
                                                       {{3, -4, 5}, {3.001, 4, 1e37}},
                                                       {{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}}}) {
        const std::vector<DoubleBox> listed = random_boxes(random, 100, 50, 30);
        NarrowBoxes boxes;
        boxes.start(single({lo, hi}));
        for (const DoubleBox& b : listed) boxes.add(single(b));
        std::vector<DoubleBox> probes = random_boxes(random, 50, 50, 30);
        for (std::size_t i = 0; i < 50; ++i) probes.push_back({listed[i].hi, listed[i].hi});
        for (std::size_t i = 0; i < 50; ++i)
            probes.push_back({{-100, -100, -100}, {listed[i].lo[0], 100, 100}});
        for (const DoubleBox& probe : probes) {
            const std::vector<std::uint8_t> found = found_by(boxes, probe);
            for (std::size_t i = 0; i < listed.size(); ++i)
                EXPECT_TRUE(found[i] == 1 || !meet(listed[i], probe));
        }
    }
}

TEST(NarrowBoxes, StartAnew) {
    NarrowBoxes boxes;
    for (int turn = 0; turn < 3; ++turn) {
        boxes.start(single({{0, 0, 0}, {1, 1, 1}}));
        EXPECT_EQ(boxes.word_count(), 0U);
        boxes.add(single({{0, 0, 0}, {0.25, 0.25, 0.25}}));
        EXPECT_EQ(boxes.word_count(), 1U);
        EXPECT_EQ(found_by(boxes, {{0.25, 0.25, 0.25}, {1, 1, 1}})[0], 1);
        EXPECT_EQ(found_by(boxes, {{0.5, 0, 0}, {1, 1, 1}})[0], 0);
    }
}

}  // namespace
}  // namespace trisect::detail
