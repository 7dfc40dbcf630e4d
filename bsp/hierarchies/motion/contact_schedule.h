// SPDX-License-Identifier: Apache-2.0
//
// ContactSchedule: next examination times of pairs of moving bodies.
// No contact is missed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/interference/boxes/broad_phase.h>
#include <trisect/kernel/pose.h>
#include <trisect/kernel/support/function_ref.h>

namespace trisect::hierarchies {

/// A speed that no point of a rigid body exceeds which moves with this velocity and turns this fast
/// (radians in a unit of time) about a point from which none of it is farther than the radius:
/// |v| + w r, rounded up.
[[nodiscard]] double speed_bound(const std::array<double, 3>& velocity, double angular_speed,
                                 double radius);

/// How far a point of the box is moved at most between two poses, rounded up: an upper bound of
/// |p1 x - p0 x| for all x of the box, which is in the body's own coordinates and the user's units.
/// Infinite beyond the doubles.
[[nodiscard]] double displacement_bound(const trisect::detail::BodyBox& box, const Pose& from,
                                        const Pose& to);

/// Pairs of bodies in a heap by the earliest time at which they can meet.
///
/// Promise: if a body's points never move farther in a time than its speed times that time, and
/// distances from tests are lower bounds, then whenever two bodies have a common point at a time
/// for which due() is called, that call tests them. Proof: after a test at time s with distance d
/// at least, a common point at time t needs (u + v)(t - s) >= d for the speeds u and v; the pair is
/// due at a time rounded down from s + d / (u + v), the sum rounded up. Speeds that change keep
/// this: the distance left at that moment is d - (u + v)(t - s), rounded down.
///
/// Memory: 40 bytes a pair. A test costs O(log pairs), a change of a speed O(bodies log pairs).
/// Source: Lin, Efficient collision detection for animation and robotics (thesis, Berkeley 1993);
/// Mirtich, Efficient algorithms for two-phase collision detection (MERL TR-97-23).
class ContactSchedule {
public:
    /// All pairs, all due at any time from `now` on. \throw UsageError for speeds that are negative
    /// or not a number (infinite ones are allowed), for these and all times given later.
    explicit ContactSchedule(std::span<const double> speeds, double now = 0);

    /// Returns a lower bound of the distance at the present time; 0 or less keeps a pair due.
    using Test = FunctionRef<double(std::uint32_t first, std::uint32_t second)>;
    /// Tests each pair that is due at a time not after `now`, once. Returns how many.
    /// \throw UsageError when time runs backwards.
    std::size_t due(double now, Test test);

    /// From `now` on. \throw UsageError for times before the last one.
    void set_speed(std::uint32_t body, double speed, double now);

    [[nodiscard]] std::size_t pair_count() const { return pairs_.size(); }
    /// The time at which the next pair is due; infinite when none ever is.
    [[nodiscard]] double next();

private:
    struct Pair {
        double tested = 0;    ///< when
        double distance = 0;  ///< then, at least
        std::uint32_t stamp = 0;
    };
    struct Entry {
        double time;
        std::uint32_t first;
        std::uint32_t second;
        std::uint32_t stamp;
    };
    [[nodiscard]] Pair& pair(std::uint32_t first, std::uint32_t second);
    void schedule(std::uint32_t first, std::uint32_t second);
    void drop_outdated();
    void advance(double now);

    std::vector<double> speeds_;
    std::vector<Pair> pairs_;  // (0, 1), (0, 2), (1, 2), (0, 3), ...
    std::vector<Entry> heap_;
    std::vector<Entry> tested_;
    double now_ = 0;
};

}  // namespace trisect::hierarchies
