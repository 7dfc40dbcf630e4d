// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/crowd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <trisect/bsp/many_meshes/outlines/box_sweep.h>

namespace trisect::detail {

namespace {

// In how many boxes of operands a point of their common box lies, on average: so many, or this part
// of all where they are few.
constexpr double crowded_depth = 2.5;
constexpr double crowded_part = 0.3;

// In fewer, neighbours are compared first; from here on that is less than what cells compare and
// assembly puts together.
constexpr double near_depth = 2;

// The part of the common box that the first operand's has, where all others are tools in it.
constexpr double large_first_part = 0.5;

// The part of all operands of which boxes stand on each other: there cells are arranged exactly.
constexpr double standing_part = 0.5;

// The part of all operands that may touch others, of those that are compared pair by pair for it.
constexpr double touching_part = 0.125;

constexpr std::size_t most_cutters = 64;

// Whether a box ends where another one begins, and they have a part of a plane in common.
bool stands(const Box& a, const Box& b) {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        if ((a.hi[k] == b.lo[k] || b.hi[k] == a.lo[k]) && a.lo[u] < b.hi[u] && b.lo[u] < a.hi[u] &&
            a.lo[v] < b.hi[v] && b.lo[v] < a.hi[v])
            return true;
    }
    return false;
}

bool are_enough(std::span<const std::uint8_t> found, double part) {
    const auto count = static_cast<double>(std::ranges::count(found, 1));
    return count > 0 && count >= part * static_cast<double>(found.size());
}

// Whether enough boxes begin or end at a coordinate at which another one ends or begins.
bool may_stand(std::span<const Box> boxes) {
    std::vector<std::uint8_t> found(boxes.size(), 0);
    std::vector<std::int64_t> begins;
    std::vector<std::int64_t> ends;
    for (std::size_t k = 0; k < 3; ++k) {
        begins.clear();
        ends.clear();
        for (const Box& b : boxes) {
            begins.push_back(b.lo[k]);
            ends.push_back(b.hi[k]);
        }
        std::ranges::sort(begins);
        std::ranges::sort(ends);
        for (std::size_t i = 0; i < boxes.size(); ++i)
            if (std::ranges::binary_search(ends, boxes[i].lo[k]) ||
                std::ranges::binary_search(begins, boxes[i].hi[k]))
                found[i] = 1;
    }
    return are_enough(found, standing_part);
}

// Whether two boxes begin or end at one coordinate, or lie about one: then edges of round shapes
// cross edges.
bool may_touch(const Box& a, const Box& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a.lo[k] == b.lo[k] || a.lo[k] == b.hi[k] || a.hi[k] == b.lo[k] || a.hi[k] == b.hi[k] ||
            a.lo[k] + a.hi[k] == b.lo[k] + b.hi[k])
            return true;
    return false;
}

}  // namespace

Crowd crowd_of(std::span<const Box> boxes) {
    Box all;
    for (const Box& b : boxes) all.add(b);
    const auto part_of = [&](const Box& box) {
        double part = 1;
        for (std::size_t k = 0; k < 3; ++k)
            part *= static_cast<double>(box.hi[k] - box.lo[k] + 1) /
                    static_cast<double>(all.hi[k] - all.lo[k] + 1);
        return part;
    };
    double sum = 0;
    for (const Box& b : boxes) sum += part_of(b);
    if (sum >= std::min(crowded_depth, crowded_part * static_cast<double>(boxes.size())))
        return Crowd::All;
    if (part_of(boxes[0]) >= large_first_part) return Crowd::InFirst;
    return sum >= near_depth ? Crowd::Near : Crowd::None;
}

// Looks at neighbours in the order along each axis.
bool do_stand(std::span<const Box> boxes) {
    if (!may_stand(boxes)) return false;
    constexpr std::size_t most_looked_at = 64;
    std::vector<std::uint8_t> found(boxes.size(), 0);
    std::vector<std::uint32_t> order(boxes.size());
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::ranges::sort(order, {},
                          [&](std::uint32_t s) { return std::pair(boxes[s].lo[axis], s); });
        for (std::size_t i = 0; i < order.size(); ++i) {
            const Box& a = boxes[order[i]];
            const std::size_t end = std::min(order.size(), i + 1 + most_looked_at);
            for (std::size_t j = i + 1; j < end && boxes[order[j]].lo[axis] <= a.hi[axis]; ++j)
                if (stands(a, boxes[order[j]])) found[order[i]] = found[order[j]] = 1;
        }
    }
    return are_enough(found, standing_part);
}

bool are_apart(std::span<const Box> boxes) {
    std::vector<std::uint32_t> all(boxes.size());
    std::iota(all.begin(), all.end(), 0U);
    bool out = true;
    for_each_meeting(boxes, all, [&](std::uint32_t, std::uint32_t) { out = false; });
    return out;
}

// Whether that holds for enough of those that meet, or none do.
bool may_touch_or_are_apart(std::span<const Box> boxes) {
    std::vector<std::uint32_t> all(boxes.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<std::uint8_t> found(boxes.size(), 0);
    bool none_meet = true;
    for_each_meeting(boxes, all, [&](std::uint32_t i, std::uint32_t j) {
        none_meet = false;
        if ((found[i] == 0 || found[j] == 0) && may_touch(boxes[i], boxes[j]))
            found[i] = found[j] = 1;
    });
    return none_meet || are_enough(found, touching_part);
}

bool meets_many(std::span<const Box> boxes) {
    const auto size = [](const Box& b) {
        double out = 1;
        for (std::size_t k = 0; k < 3; ++k) out *= static_cast<double>(b.hi[k] - b.lo[k] + 1);
        return out;
    };
    const auto largest = std::ranges::max_element(boxes, {}, size);
    const auto met =
        std::ranges::count_if(boxes, [&](const Box& b) { return b.overlaps(*largest); });
    return static_cast<std::size_t>(met) > most_cutters;
}

}  // namespace trisect::detail
