// SPDX-License-Identifier: Apache-2.0
//
// CoherentWalk: crossing or separation of two boundaries over similar poses.
// It serves a sequence of poses that change little.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/boxes/obb_pose.h>
#include <trisect/bsp/interference/boxes/obb_walk.h>
#include <trisect/bsp/interference/coherent/separating_planes.h>
#include <trisect/bsp/interference/relation/boundary.h>
#include <trisect/bsp/interference/relation/inside_balls.h>
#include <trisect/kernel/support/due_list.h>

namespace trisect::detail {

/// Keeps, between questions, a crossing pair of triangles and the front of the last walk that found
/// the boundaries apart. Every answer is as good as that of a fresh walk. For one thread;
/// boundaries must outlive it.
class CoherentWalk {
public:
    /// \pre both have triangles
    CoherentWalk(const Boundary& a, const Boundary& b) : a_(&a), b_(&b) {}

    enum class Answer : std::uint8_t {
        Crossing,  ///< certainly an edge passes through a clear face, or balls prove Overlapping
        Apart,     ///< certainly no common point
        Unknown    ///< doubles cannot decide
    };
    [[nodiscard]] Answer ask(const ApproximateMap& b_to_a);
    /// Of the last answer, Apart: whether the boundaries were apart before it, too, and all the way
    /// from there along straight lines. Then each shell is on the side on which it was.
    [[nodiscard]] bool is_unmoved() const { return unmoved_; }
    /// Of the last answer, Apart: whether even balls around the bodies are apart.
    [[nodiscard]] bool is_far() const { return far_; }
    /// The last answer stays what it is while no point of B moves by as much, in lattice units of
    /// A. Mostly 0 when it is not worth it.
    [[nodiscard]] double reserve() const { return reserve_; }
    /// A has other boxes from now on, the rest of them being what they were.
    void a_has_changed(const ChangedBoxes& changed);
    void b_has_changed(const ChangedBoxes& changed);
    void forget();

    [[nodiscard]] const WalkCounters& counters() const { return counters_; }
    /// How often a whole walk was made.
    [[nodiscard]] std::uint64_t fresh_walks() const { return fresh_; }
    /// How often a front was gone on from after a crossing had been lost.
    [[nodiscard]] std::uint64_t resumed_fronts() const { return resumed_; }

private:
    enum class Opens : std::uint8_t { A, B, Neither };
    // A pair of boxes that was opened: one test of a box against four lanes, or a pair of leaves.
    // `open` lanes have visits of their own below; the others were apart by so much that they stay
    // apart until the odometer is at `due`.
    struct Visit {
        double slack = 0;  // in this question: how far everything was apart before it
        ObbId a;
        ObbId b;
        std::uint32_t parent = none;
        float tried = 0;  // the gap with which the parent was last tested in vain
        std::uint8_t open = 0;
        Opens opens = Opens::Neither;
        bool in_use = true;
        bool has_plane = false;  // of a pair of triangles
        std::array<std::uint32_t, 4> below{};
    };
    static constexpr std::uint32_t none = 0xffffffffU;
    [[nodiscard]] Opens opens(ObbId a, ObbId b) const;
    void forget_changed(const ChangedBoxes& changed, ObbId Visit::*box);
    [[nodiscard]] PairVerdict compare(std::uint32_t i, std::uint32_t j, TriangleCorners& p,
                                      TriangleCorners& q);

    // Overlap in depth.
    bool balls_overlap();
    bool find_balls();
    Answer crossing_answer();

    // Crossing pairs.
    bool leaves_cross(ObbId a, ObbId b);
    void push_lanes(const ObbWalk::Pair& p, Opens side, ObbWalk::Pair searched);
    bool cross_below_stack();
    void find_way_to(ObbWalk::Pair leaves);
    Answer search_from_witness();

    [[nodiscard]] bool is_elsewhere() const;
    Answer place();

    // The front.
    std::uint32_t add_visit(ObbId a, ObbId b, std::uint32_t parent, double slack);
    void remove(std::uint32_t v);
    void keep(std::uint32_t v, double gap);
    void keep_apart(std::uint32_t v, double gap);
    bool visit(std::uint32_t v);
    void visit_lanes(std::uint32_t v);
    bool visit_leaves(std::uint32_t v);
    [[nodiscard]] double gap_along_plane(std::uint32_t v, const TriangleCorners& p,
                                         const TriangleCorners& q) const;
    void set_plane(std::uint32_t v, const TriangleCorners& p, const TriangleCorners& q);
    void move_corners(std::uint32_t i, std::uint32_t j, TriangleCorners& p,
                      TriangleCorners& q) const;
    void begin(std::uint32_t v);
    Answer visit_open();
    Answer make_front();
    void stand();
    Answer renew_front();
    Answer answer() const { return unknown_ == 0 ? Answer::Apart : Answer::Unknown; }

    const Boundary* a_;
    const Boundary* b_;
    ApproximateMap map_;
    std::optional<ObbPose> pose_;
    std::optional<ObbPose> last_pose_;  // of the question before
    double error_ = 0;
    std::uint64_t unknown_ = 0;  // pairs of triangles in this question

    double reserve_ = 0;
    bool far_ = false;

    std::optional<ObbWalk::Pair> witness_;  // of leaves
    // A ball inside each solid, near where the boundaries crossed, and the regions that they are
    // of.
    std::optional<std::pair<InsideBall, InsideBall>> balls_;
    std::size_t region_a_ = 0;
    std::size_t region_b_ = 0;
    ObbWalk::Stack stack_;
    // The way down to the pair of leaves, and the boxes above each of them; scratch memory.
    std::vector<ObbWalk::Pair> way_;
    std::vector<ObbId> up_in_a_;
    std::vector<ObbId> up_in_b_;

    std::vector<Visit> visits_;
    // Of visits: planes that separate the lanes that are not open, which stay where they are while
    // B moves. Of a pair of triangles the first direction alone, in doubles.
    std::vector<SeparatingPlanes> planes_;
    std::vector<std::uint32_t> unused_;
    DueList due_;                        // of visits
    std::vector<std::uint32_t> open_;    // visits to be made in this question
    std::optional<ObbPose> front_pose_;  // where the odometer stands
    double odometer_ = 0;  // bounds how far any point has moved since the front was made
    double step_ = 0;      // the last addition to it
    double turn_ = 0;      // bounds how far B has turned since the oldest plane was found
    PlanePose plane_pose_;
    bool unmoved_ = false;
    bool last_from_front_ = false;  // the last answer was the front's, and not Crossing

    std::uint64_t fresh_ = 0;
    std::uint64_t resumed_ = 0;
    WalkCounters counters_;
};

}  // namespace trisect::detail
