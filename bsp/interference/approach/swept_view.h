// SPDX-License-Identifier: Apache-2.0
//
// SweptViews: relative motions of two solids over ranges of time.
// With a margin for what enclosures leave open.
#pragma once

#include <vector>

#include <trisect/bsp/interference/enclosed_motion.h>
#include <trisect/bsp/interference/motion/ball_motion.h>
#include <trisect/bsp/interference/motion/swept_walk.h>
#include <trisect/bsp/interference/relation/boundary.h>

namespace trisect::detail {

/// What A sees of B during a range of time.
struct SweptView {
    BallMotion motion;
    SweptMap swept;     ///< B's sweep, without the margin
    double margin = 0;  ///< in A's lattice units; infinite when nothing is known
};

/// Of two boundaries under enclosed motions. All must outlive this.
class SweptViews {
public:
    /// \throw UsageError for durations that do not match
    SweptViews(const Boundary& a, const EnclosedMotion& motion_a, const Boundary& b,
               const EnclosedMotion& motion_b);

    /// The times at which either motion may have a kink, from 0 to the duration.
    [[nodiscard]] const std::vector<double>& breaks() const { return breaks_; }
    /// What is farther than the margin from each other under the enclosures is apart in truth.
    /// \throw UnsupportedError when the relative motion of two enclosures has a degree above 8;
    /// what the motions throw.
    [[nodiscard]] SweptView view(double from, double to) const;
    /// What is farther than the margin from each other under the enclosures is in truth farther
    /// than `distance`, in the user's units. \throw as above
    [[nodiscard]] SweptView view(double from, double to, double distance) const;
    /// How far the distance of the boundaries under the enclosures at a time may be off.
    [[nodiscard]] double deviation_at(double time) const;

private:
    struct Enclosures {
        MotionEnclosure a;
        MotionEnclosure b;
    };
    [[nodiscard]] Enclosures enclose(double from, double to) const {
        return {motion_a_.enclose(from, to), motion_b_.enclose(from, to)};
    }
    [[nodiscard]] double deviation(const Enclosures& e) const {
        return e.a.by_length * reach_a_ + e.a.constant + e.b.by_length * reach_b_ + e.b.constant;
    }
    [[nodiscard]] SweptView view_without_margin(const Enclosures& e) const;

    const Boundary& a_;
    const EnclosedMotion& motion_a_;
    const Boundary& b_;
    const EnclosedMotion& motion_b_;
    std::vector<double> breaks_;
    double reach_a_;
    double reach_b_;
};

/// A bound on how far a solid reaches from the origin, in the user's units.
[[nodiscard]] double reach_of(const Boundary& data);

/// Whether the linear part of a motion is about a multiple of a rotation, as far as a look at both
/// ends and the middle shows.
[[nodiscard]] bool is_about_similar(const MotionPiece& piece);

/// A bound on |x| / |M x| for the linear part M of a motion, during all of it; infinite where none
/// is found. For similarities, exactly such, it is the number up to roundings.
[[nodiscard]] double inverse_stretch_of(const MotionPiece& piece);

}  // namespace trisect::detail
