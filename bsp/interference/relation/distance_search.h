// SPDX-License-Identifier: Apache-2.0
//
// DistanceSearch: the closest triangles of two posed models, by certified bounds.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <trisect/bsp/interference/boxes/obb_pose.h>
#include <trisect/bsp/interference/relation/bound_queue.h>
#include <trisect/bsp/interference/relation/boundary.h>
#include <trisect/bsp/interference/relation/pair_distance.h>
#include <trisect/kernel/pose.h>
#include <trisect/kernel/support/spares.h>

namespace trisect::detail {

/// What a search did.
struct DistanceCounters {
    std::uint64_t node_tests = 0;      ///< bounds of one box against four
    std::uint64_t triangle_pairs = 0;  ///< distances of triangles in doubles
};

/// For one thread; models must outlive it. Distances are in the user's units.
class DistanceSearch {
public:
    /// \pre both models have triangles.
    DistanceSearch(const Boundary& a, const Pose& pose_a, const Boundary& b, const Pose& pose_b);

    using Candidate = DistanceCandidate;
    /// Looks for the distance alone: of pairs that are equally near, within the width of the
    /// interval, one is enough. The interval may be twice as wide for that, and `candidates` are
    /// not all that may be the closest. What is certainly at `limit` or farther is not looked at.
    void run_for_bounds(double limit = std::numeric_limits<double>::infinity());
    /// Looks for the closest pair. What is certainly at `limit` or farther is not looked at; with
    /// `stop` the search ends as soon as something is certainly nearer. Triangles of an earlier
    /// answer may be given as a start.
    void run(double limit = std::numeric_limits<double>::infinity(), bool stop = false,
             std::optional<std::array<std::uint32_t, 2>> start = {});

    /// Bounds on the distance, if it is below the limit. `lower` is infinite when nothing was
    /// found.
    [[nodiscard]] double lower() const { return lower_; }
    [[nodiscard]] double upper() const { return upper_; }
    /// All pairs that may be the closest, the one with the least upper bound first.
    [[nodiscard]] const std::vector<Candidate>& candidates() const { return arrays_->candidates; }
    [[nodiscard]] const DistanceCounters& counters() const { return counters_; }

private:
    struct Arrays {
        BoundQueue queue;
        std::vector<BoundedPair> stack;
        std::vector<Candidate> candidates;
        [[nodiscard]] std::size_t bytes() const {
            return queue.bytes() + stack.capacity() * sizeof(BoundedPair) +
                   candidates.capacity() * sizeof(Candidate);
        }
    };
    void start(double limit);
    void search();
    void compare(std::uint32_t a, std::uint32_t b);
    void note(const Candidate& c);
    [[nodiscard]] bool is_beyond(double least) const {
        return least > enough_ || least > upper_ || least >= limit_;
    }
    [[nodiscard]] bool is_done() const { return upper_ <= 0 || (stop_ && upper_ < limit_); }
    void descend(const BoundedPair& from);
    void put(const BoundedPair& pair);
    void compare_leaves(ObbChild a, ObbChild b);
    void expand(const BoundedPair& e);
    void finish();

    const Boundary* a_;
    const Boundary* b_;
    std::optional<PairDistance> pairs_;
    std::optional<ObbPose> pose_;
    double unit_ = 0;  // gaps of boxes to lower bounds in the world
    double limit_ = 0;
    double lower_ = 0;
    double upper_ = 0;
    // What is farther than this is not looked at, since it is as near as the nearest so far, or
    // farther. `skipped_` is the least that this was.
    double enough_ = 0;
    double skipped_ = 0;
    bool all_ = true;
    bool stop_ = false;
    std::uint32_t descents_ = 0;
    Spare<Arrays> arrays_;
    DistanceCounters counters_;
};

}  // namespace trisect::detail
