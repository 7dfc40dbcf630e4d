// SPDX-License-Identifier: Apache-2.0
//
// SpaceTimeBoxes: candidate pairs of moving solids, with time intervals.
// A solid that moves is a body in four dimensions, and boxes around parts of it are found in
// pairs like any others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/interference/boxes/broad_phase.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/motion.h>

namespace trisect::hierarchies {

/// A box that contains a solid from one value of its motion's parameter to another.
struct SpaceTimeBox {
    trisect::detail::BodyBox space;
    double from = 0;
    double to = 0;
};

/// Two solids and a time, closed at both ends, within which they may meet.
struct SpaceTimePair {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    double from = 0;
    double to = 0;
    friend auto operator<=>(const SpaceTimePair&, const SpaceTimePair&) = default;
};

/// Solids under motions on a common parameter, from 0 to the largest number of pieces; a motion of
/// fewer pieces stands still afterwards.
///
/// Each motion is cut into intervals, halves of halves, until the box of an interval is hardly
/// larger than that of the solid; at most `most_boxes` for a piece. What is not in a pair at a time
/// does certainly not meet at that time. Answers do not depend on the order of calls.
///
/// Source: P. Hubbard, Interactive collision detection (IEEE Symposium on Research Frontiers in
/// Virtual Reality, 1993); S. Cameron, Collision detection by four-dimensional intersection testing
/// (IEEE Transactions on Robotics and Automation 6(3), 1990).
class SpaceTimeBoxes {
public:
    static constexpr std::size_t most_boxes = 128;

    /// Its number: 0, 1, ... An empty model meets nothing. O(vertices), and some ten microseconds a
    /// box.
    std::uint32_t add(const InterferenceModel& model, const Motion& motion);

    [[nodiscard]] std::size_t size() const { return bodies_.size(); }
    /// In the order of time, without gaps.
    [[nodiscard]] std::span<const SpaceTimeBox> boxes(std::uint32_t body) const {
        return bodies_[body];
    }

    /// All times within [from, to] at which boxes of two solids meet: disjoint intervals, as long
    /// as can be, in the order of their beginnings, then of the solids. O(n log n) and what is
    /// found, for n boxes within that time.
    [[nodiscard]] std::vector<SpaceTimePair> pairs(double from, double to) const;

private:
    std::vector<std::vector<SpaceTimeBox>> bodies_;
};

}  // namespace trisect::hierarchies
