// SPDX-License-Identifier: Apache-2.0
//
// LeastDistanceSearch: the least distance of moving boundaries, for one question.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <trisect/bsp/interference/approach/swept_view.h>
#include <trisect/bsp/interference/least_distance.h>
#include <trisect/bsp/interference/motion/swept_walk.h>
#include <trisect/bsp/interference/relation/boundary.h>
#include <trisect/bsp/interference/relation/pair_distance.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

class LeastDistanceSearch {
public:
    /// All must outlive this. \pre both have triangles \throw UsageError
    LeastDistanceSearch(const Boundary& a, const EnclosedMotion& motion_a, const Boundary& b,
                        const EnclosedMotion& motion_b, const LeastDistanceOptions& options);

    void run();

    [[nodiscard]] double lower() const { return lower_; }
    [[nodiscard]] double upper() const { return upper_; }
    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] bool is_narrow() const { return is_narrow_; }
    /// The pair of triangles that is as near as `upper` at that time.
    [[nodiscard]] const DistanceCandidate& nearest() const { return nearest_; }
    [[nodiscard]] Pose pose_a(double time) const { return pose_of(motion_a_, time); }
    [[nodiscard]] Pose pose_b(double time) const { return pose_of(motion_b_, time); }
    /// What it took.
    [[nodiscard]] std::size_t ranges() const { return ranges_; }
    [[nodiscard]] std::size_t questions() const { return questions_; }

private:
    using Pairs = SweptWalk::Pairs;

    [[nodiscard]] static Pose pose_of(const EnclosedMotion& motion, double time) {
        return motion.enclose(time, time).motion.pose_at(0);
    }
    double ask(double time, double limit);
    void sample();
    void descend(double from, double to);
    [[nodiscard]] double goal() const;
    [[nodiscard]] bool is_beyond(double from, double to, double distance, const Pairs& front,
                                 Pairs& rest);
    void keep_what_may_be_near(const SweptView& view, Pairs& leaves, Pairs& rest);
    void visit(double from, double to, const Pairs& front);

    const Boundary& a_;
    const EnclosedMotion& motion_a_;
    const Boundary& b_;
    const EnclosedMotion& motion_b_;
    LeastDistanceOptions options_;
    SweptViews views_;
    SweptWalk walk_;
    double floor_ = 0;  // of a range of time
    double lower_ = 0;
    double upper_ = 0;
    double time_ = 0;
    bool is_narrow_ = true;
    DistanceCandidate nearest_;
    std::size_t ranges_ = 0;
    std::size_t questions_ = 0;
};

}  // namespace trisect::detail
