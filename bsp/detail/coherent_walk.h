// SPDX-License-Identifier: Apache-2.0
//
// CoherentWalk: whether two boundaries cross or are apart, for a sequence of poses that change
// little.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/detail/approximate_map.h>
#include <trisect/bsp/detail/interference_model_data.h>
#include <trisect/bsp/detail/obb_pose.h>
#include <trisect/bsp/detail/obb_walk.h>

namespace trisect::detail {

/// Keeps, between questions, a crossing pair of triangles or the front of the walk that found the
/// boundaries apart. Every answer is as good as that of a fresh walk. For one thread; models must
/// outlive it.
class CoherentWalk {
public:
    /// \pre both models have triangles
    CoherentWalk(const InterferenceModelData& a, const InterferenceModelData& b) : a_(&a), b_(&b) {}

    enum class Answer : std::uint8_t {
        Crossing,  ///< certainly an edge passes through a face, and both are clear there
        Apart,     ///< certainly no common point
        Unknown    ///< doubles cannot tell
    };
    [[nodiscard]] Answer ask(const ApproximateMap& b_to_a);
    /// Of the last answer, Apart: whether the boundaries were apart before it, too, and all the way
    /// from there along straight lines. Then each shell is on the side on which it was.
    [[nodiscard]] bool is_unmoved() const { return unmoved_; }
    void forget();

    [[nodiscard]] const WalkCounters& counters() const { return counters_; }
    /// How often a whole walk was made.
    [[nodiscard]] std::uint64_t fresh_walks() const { return fresh_; }

private:
    // One test of a box against four, or a pair of leaves. Lanes in `done` have entries of their
    // own below them; the others were apart by so much that they stay apart until `expiry`.
    struct Entry {
        double expiry = 0;
        ObbId a;
        ObbId b;
        std::uint8_t done = 0;
        std::optional<bool> open_b = std::nullopt;  // which side's children the lanes are
    };
    struct Witness {
        ObbId a;
        ObbId b;
    };

    [[nodiscard]] bool opens_b(const Entry& e) const;
    bool visit(Entry e);
    [[nodiscard]] bool are_clear(std::uint32_t i, std::uint32_t j) const;
    bool visit_leaves(Entry e);
    bool cross_below(ObbId a, ObbId b, std::uint64_t budget);
    bool crosses_near_witness();
    Answer walk_fresh();
    Answer renew_front();
    Answer answer() const { return unknown_ == 0 ? Answer::Apart : Answer::Unknown; }
    void keep(const Entry& e);

    const InterferenceModelData* a_;
    const InterferenceModelData* b_;
    ApproximateMap map_;
    std::optional<ObbPose> pose_;
    std::optional<ObbPose> last_;
    double error_ = 0;
    std::optional<Witness> witness_;
    std::vector<Entry> front_;  // a heap, the first to expire on top
    std::vector<ObbWalk::Pair> open_;
    bool has_front_ = false;
    bool unmoved_ = false;
    double odometer_ = 0;
    std::size_t fresh_size_ = 0;
    std::uint64_t unknown_ = 0;  // pairs of triangles in this question
    std::uint64_t fresh_ = 0;
    WalkCounters counters_;
};

}  // namespace trisect::detail
