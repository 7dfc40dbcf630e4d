// SPDX-License-Identifier: Apache-2.0
//
// EnclosedQuery: the search for the first contact under enclosed motions.
// How the boundaries are given is left open.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/interference/approach/swept_view.h>
#include <trisect/bsp/interference/boxes/obb_walk.h>
#include <trisect/bsp/interference/enclosed_contact.h>
#include <trisect/bsp/interference/motion/swept_walk.h>
#include <trisect/bsp/interference/relation/boundary.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// The search, for one question. \pre the solids are not empty.
class EnclosedQuery {
public:
    EnclosedQuery(const EnclosedQuery&) = delete;
    EnclosedQuery& operator=(const EnclosedQuery&) = delete;
    virtual ~EnclosedQuery() = default;

    /// Without witnesses.
    [[nodiscard]] EnclosedContact run();

    /// Triangles that certainly pass through each other at the contact.
    struct Crossing {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
    };
    [[nodiscard]] const std::optional<Crossing>& crossing() const { return crossing_; }
    [[nodiscard]] const FirstContactCounters& counters() const { return counters_; }

protected:
    /// All must outlive this. \throw UsageError for a width or durations that do not match
    EnclosedQuery(const Boundary& a, const EnclosedMotion& motion_a, const Boundary& b,
                  const EnclosedMotion& motion_b, const EnclosedContactOptions& options);

    [[nodiscard]] virtual Relation relation_at(const Pose& pose_a, const Pose& pose_b) = 0;
    [[nodiscard]] virtual const BrepIndex& index_a() = 0;
    [[nodiscard]] virtual const BrepIndex& index_b() = 0;

private:
    using Pairs = SweptWalk::Pairs;
    using Undecided = std::vector<TimeSpan>;

    [[nodiscard]] SweptView view(double from, double to) const { return views_.view(from, to); }
    [[nodiscard]] bool is_free(const SweptView& view, const Pairs& front, bool is_last,
                               Pairs& rest);
    void keep_what_may_meet(const SweptView& view, Pairs& leaves, Pairs& rest);
    void visit(double from, double to, const Pairs& front);
    void give_up(double from, double to);
    void settle_inside(double time);
    [[nodiscard]] bool is_contact(double time);
    [[nodiscard]] bool is_deep(const ApproximateMap& map);
    [[nodiscard]] bool is_deep_at(const std::array<double, 3>& p, const ApproximateMap& map);
    [[nodiscard]] double narrowed(double from, double to);
    void found(double from, double by);
    void finish();

    const Boundary& a_;
    const EnclosedMotion& motion_a_;
    const Boundary& b_;
    const EnclosedMotion& motion_b_;
    double width_;
    SweptViews views_;
    SweptWalk walk_;
    ObbWalk::Stack stack_;
    double floor_ = 0;
    double later_floor_ = 0;
    bool is_inside_known_ = false;  // since the boundaries were apart last
    std::optional<Crossing> crossing_;
    EnclosedContact result_;
    FirstContactCounters counters_;
};

}  // namespace trisect::detail
