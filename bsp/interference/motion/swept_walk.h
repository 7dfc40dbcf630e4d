// SPDX-License-Identifier: Apache-2.0
//
// SweptWalk: possibly intersecting box pairs of moving solids during an interval.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/boxes/obb_pose.h>
#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/bsp/interference/motion/ball_motion.h>

namespace trisect::detail {

/// One pose, and how far any point of a solid is from there during an interval.
struct SweptMap {
    ApproximateMap map;
    double sweep = 0;  ///< distance in A's lattice units
};

/// For all points within the box lo, hi of B.
[[nodiscard]] SweptMap swept_map(const BallMotion& motion, const std::array<double, 3>& lo,
                                 const std::array<double, 3>& hi);

/// A bound on how much the inverse of the map's matrix stretches any vector during the interval;
/// infinite where none is found.
[[nodiscard]] double inverse_stretch(const BallMotion& motion);

/// Boxes are divided while they are larger than the sweep; smaller ones had better wait for a
/// shorter interval.
class SweptWalk {
public:
    struct Pair {
        ObbId a;
        ObbId b;
    };
    using Pairs = std::vector<Pair>;

    /// \pre both trees have boxes.
    SweptWalk(const ObbTree& a, const ObbTree& b) : a_(a), b_(b) {}

    /// What of the pairs of `front` may meet: pairs of triangles, or of leaves of the trees, and
    /// pairs of boxes of which one is none but both are small. `pose` is grown by the sweep.
    /// Pairs for which `leave_out(box of A, box of B)` holds are dropped.
    template <class LeaveOut>
    void refine(const ObbPose& pose, double sweep, const Pairs& front, Pairs& leaves, Pairs& coarse,
                LeaveOut&& leave_out) {
        Pairs stack = meeting(pose, front);
        coarse.clear();
        while (!stack.empty()) {
            const Pair p = stack.back();
            stack.pop_back();
            if (leave_out(p.a, p.b)) continue;
            divide(pose, sweep, p, stack, leaves, coarse);
        }
    }
    void refine(const ObbPose& pose, double sweep, const Pairs& front, Pairs& leaves,
                Pairs& coarse) {
        refine(pose, sweep, front, leaves, coarse, [](ObbId, ObbId) { return false; });
    }
    /// Whether at least half of the pairs are small beside the sweep.
    [[nodiscard]] bool are_long(const ObbPose& pose, double sweep, const Pairs& leaves) const;

    /// Tests of one box against four so far.
    [[nodiscard]] std::uint64_t box_tests() const { return box_tests_; }

private:
    // Those whose boxes meet.
    [[nodiscard]] Pairs meeting(const ObbPose& pose, const Pairs& front);
    // Onto one of three lists.
    void divide(const ObbPose& pose, double sweep, const Pair& pair, Pairs& stack, Pairs& leaves,
                Pairs& coarse);
    void push_children(const ObbPose& pose, const Pair& pair, bool of_b, Pairs& stack);
    [[nodiscard]] double size_a(ObbId id) const;
    [[nodiscard]] double size_b(const ObbPose& pose, ObbId id) const;

    const ObbTree& a_;
    const ObbTree& b_;
    std::uint64_t box_tests_ = 0;
};

}  // namespace trisect::detail
