// SPDX-License-Identifier: Apache-2.0
//
// Lists of packed boxes on several threads (box_lists.h), against one.

#include <trisect/bsp/divide/box_lists.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace trisect::detail {
namespace {

// Within ±1000, up to `largest` long along each axis.
std::vector<PackedBox> random_boxes(std::size_t count, int largest) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> at(-1000, 1000);
    std::uniform_int_distribution<int> extent(0, largest);
    std::vector<PackedBox> out(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const int lo = at(random);
            out[i].lo[k] = static_cast<std::int16_t>(lo);
            out[i].minus_hi[k] = static_cast<std::int16_t>(-(lo + extent(random)));
        }
        out[i].id = static_cast<std::uint32_t>(i);
    }
    return out;
}

std::vector<std::uint32_t> ids_of(std::span<const PackedBox> boxes) {
    std::vector<std::uint32_t> out;
    for (const PackedBox& b : boxes) out.push_back(b.id);
    return out;
}

struct Halves {
    std::vector<std::uint32_t> below;
    std::vector<std::uint32_t> above;
    std::vector<std::uint32_t> across;
    friend bool operator==(const Halves&, const Halves&) = default;
};

Halves halves_of(std::span<const PackedBox> boxes, const ListCut& cut, std::uint32_t threads) {
    std::vector<PackedBox> room(boxes.size());
    std::vector<PackedBox> across(3);  // what was there before is gone
    const HalfSizes sizes = divide_list(boxes, cut, room, across, threads);
    EXPECT_EQ(sizes.below + sizes.above + across.size(), boxes.size());
    return {ids_of(std::span(room).first(sizes.below)), ids_of(std::span(room).last(sizes.above)),
            ids_of(across)};
}

// One by one.
Halves naive_halves(std::span<const PackedBox> boxes, const ListCut& cut) {
    Halves out;
    for (const PackedBox& b : boxes) {
        const bool below = b.low(cut.axis) < cut.first_above;
        const bool above = b.high(cut.axis) >= cut.first_above;
        (below && above ? out.across : below ? out.below : out.above).push_back(b.id);
    }
    out.above = {out.above.rbegin(), out.above.rend()};
    return out;
}

TEST(BoxLists, AreDividedAlikeByAnyNumberOfThreads) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, 2 * parallel_list - 1,
                                    2 * parallel_list, 5 * parallel_list + 17}) {
        const auto boxes = random_boxes(count, 60);
        for (const ListCut& cut : {ListCut{0, 0}, ListCut{1, -990}, ListCut{2, 2000}}) {
            const Halves wanted = naive_halves(boxes, cut);
            for (const std::uint32_t threads : {1U, 2U, 5U})
                EXPECT_EQ(halves_of(boxes, cut, threads), wanted) << count;
        }
    }
}

TEST(BoxLists, HaveTheBoxOfAll) {
    const auto boxes = random_boxes(4 * parallel_list + 3, 60);
    const PackedBox wanted = box_of(boxes.data(), boxes.size());
    for (const std::uint32_t threads : {1U, 2U, 5U}) {
        const PackedBox all = box_of_list(boxes, threads);
        EXPECT_EQ(all.lo, wanted.lo);
        EXPECT_EQ(all.minus_hi, wanted.minus_hi);
    }
}

TEST(BoxLists, ThoseThatMeetABoxComeInTheirOrder) {
    const auto boxes = random_boxes(4 * parallel_list + 3, 60);
    PackedBox at;
    at.lo = {-50, -50, -50};
    at.minus_hi = {-50, -50, -50};
    const PackedReach reach(at);
    std::vector<std::uint32_t> wanted;
    for (const PackedBox& b : boxes) {
        bool meets = true;
        for (std::size_t k = 0; k < 3; ++k) meets = meets && b.low(k) <= 50 && b.high(k) >= -50;
        if (meets) wanted.push_back(b.id);
    }
    EXPECT_FALSE(wanted.empty());
    for (const std::uint32_t threads : {1U, 2U, 5U}) {
        std::vector<std::uint32_t> ids;
        for_each_meeting(boxes, reach, threads, [&](const PackedBox& b) { ids.push_back(b.id); });
        EXPECT_EQ(ids, wanted);
    }
}

}  // namespace
}  // namespace trisect::detail
