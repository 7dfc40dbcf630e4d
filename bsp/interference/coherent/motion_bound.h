// SPDX-License-Identifier: Apache-2.0
//
// MotionBound: a bound on motion within which an answer stays valid.
// It is that of two placed bodies (conservative advancement).
#pragma once

#include <array>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/relation/boundary.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// Two poses, and by how much any point of B may have moved since, as A sees it, before what was
/// known about them may be wrong. Asking takes no inverse and no product of poses, some 20 ns.
class MotionBound {
public:
    /// Boundaries must outlive it.
    MotionBound(const Boundary& a, const Boundary& b);

    /// `reserve` in lattice units of A; `b_to_a` is the map of these poses.
    void set(const Pose& a, const Pose& b, const ApproximateMap& b_to_a, double reserve);
    void clear() { reserve_ = 0; }
    /// Whether certainly no point of B has moved so far, under any poses between, too, that move
    /// points along straight lines. False may mean anything.
    [[nodiscard]] bool covers(const Pose& a, const Pose& b) const;

private:
    using Rows = std::array<double, 12>;
    // A ball around a body, in its own coordinates.
    struct Body {
        std::array<double, 3> center{};
        double radius = 0;
    };
    [[nodiscard]] static Body body_of(const Boundary& model);

    struct Difference;
    [[nodiscard]] static Difference difference(const Rows& now, const Rows& before);

    const Boundary* a_;
    const Boundary* b_boundary_;
    Body b_;         // in the user's units, like all that follows
    Body b_in_a_;    // where B was
    Rows rows_a_{};  // the poses
    Rows rows_b_{};
    double reserve_ = 0;  // in the world
    double stretch_ = 0;  // of A's inverse
};

}  // namespace trisect::detail
