// SPDX-License-Identifier: Apache-2.0
//
// FacetOutline: the part of a facet that other operands leave open, from the segments in which
// their facets cross it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

/// A segment in which a facet of another operand, a cutter, crosses the facet. It is directed so
/// that what the cutter leaves open is on its left.
struct OutlineSegment {
    std::uint32_t cutter = 0;                      ///< a small number for each operand
    bool open_below = false;                       ///< the open side of the cutter's facet
    std::array<const LatticePoint*, 3> corners{};  ///< of the cutter's facet
    std::array<Approximation, 2> at;               ///< its ends
    std::array<std::int8_t, 2> edge{};  ///< of the facet, where an end lies in its outline; else -1
    /// Where an end lies inside: a name for the edge of the cutter that pierces the facet there.
    std::array<std::uint64_t, 2> through{};
};

/// A vertex of the open part.
struct OutlinePoint {
    enum class Kind : std::uint8_t {
        Corner,   ///< of the facet: `which`
        End,      ///< of a segment: `which`
        Meeting,  ///< where two segments of different cutters cross
    };
    Kind kind = Kind::Corner;
    std::int8_t which = 0;
    std::uint32_t segment = 0;
    std::uint32_t other = 0;
    Approximation at;  ///< of a meeting
};

/// An edge of the open part, which is on its left seen from above the facet.
struct TracedEdge {
    OutlinePoint from;
    OutlinePoint to;
    std::int8_t edge = -1;      ///< of the facet; -1: it lies in a segment
    std::uint32_t segment = 0;  ///< which one
};

/// Traces facets that others cross in general position; keeps its memory.
class FacetOutline {
public:
    static constexpr std::size_t max_cutters = 64;

    /// False when doubles cannot tell, more than max_cutters operands cross the facet, or the
    /// segments are not what closed boundaries leave. O(n^2) for n segments.
    [[nodiscard]] bool trace(const std::array<const LatticePoint*, 3>& corners,
                             std::span<const OutlineSegment> segments);
    /// Edges of the open part, in no order; none where it is empty.
    [[nodiscard]] std::span<const TracedEdge> edges() const { return edges_; }

private:
    /// A bit for each cutter that covers a point.
    using Covers = std::uint64_t;
    using Vector3 = std::array<double, 3>;
    /// Where a segment of another cutter crosses: from there on that cutter leaves open, or covers.
    struct Meeting {
        std::uint32_t segment = 0;
        std::uint32_t other = 0;
        bool opens = false;
        double along = 0;  // the way from the segment's start, along one axis
        double error = 0;
        Approximation at;
        Covers before = 0;
    };
    /// Where a segment ends in the facet's outline.
    struct Stop {
        std::int8_t edge = 0;
        std::int8_t end = 0;  // of the segment; at its last one the cutter leaves open what follows
        std::uint32_t segment = 0;
        double along = 0;
        double error = 0;
    };
    struct Normal {
        Vector3 origin{};
        Vector3 n{};
        Vector3 minor{};  // of its magnitudes
        bool made = false;
    };
    struct Link {
        std::uint32_t cutter = 0;
        std::uint64_t through = 0;
        std::uint32_t segment = 0;
        bool starts = false;
        friend auto operator<=>(const Link&, const Link&) = default;
    };

    [[nodiscard]] bool link_segments();
    [[nodiscard]] bool find_meetings();
    [[nodiscard]] bool meet(std::uint32_t a, std::uint32_t b);
    [[nodiscard]] bool add_meeting(std::uint32_t segment, std::uint32_t other,
                                   const std::array<double, 2>& values, double error);
    [[nodiscard]] bool sort_meetings();
    [[nodiscard]] bool sort_stops();
    [[nodiscard]] bool find_covers_at_corner();
    [[nodiscard]] bool has_open_outside(std::uint32_t cutter, bool& open);
    [[nodiscard]] bool walk_outline();
    [[nodiscard]] bool walk_paths();
    [[nodiscard]] bool walk_path(std::uint32_t start, Covers covers);
    [[nodiscard]] bool start_from_meeting(std::uint32_t segment, Covers& covers) const;
    [[nodiscard]] bool start_from_corner(std::uint32_t segment, Covers& covers);

    [[nodiscard]] const Normal& normal_of(std::uint32_t segment);
    [[nodiscard]] static Normal normal_of(const std::array<const LatticePoint*, 3>& corners);
    [[nodiscard]] static double value(const Normal& plane, const Approximation& p, double& error);
    [[nodiscard]] bool set_projection();
    [[nodiscard]] int turn(const Approximation& a, const Approximation& b,
                           const Approximation& c) const;
    [[nodiscard]] Covers bit(std::uint32_t segment) const {
        return Covers{1} << segments_[segment].cutter;
    }
    [[nodiscard]] std::span<Meeting> meetings_of(std::uint32_t segment) {
        return std::span(meetings_).subspan(first_meeting_[segment],
                                            first_meeting_[segment + 1] - first_meeting_[segment]);
    }
    void add_edge(const OutlinePoint& from, const OutlinePoint& to, std::int8_t edge,
                  std::uint32_t segment) {
        edges_.push_back({from, to, edge, segment});
    }

    static constexpr std::uint32_t none = ~std::uint32_t{0};
    std::array<const LatticePoint*, 3> corners_{};
    std::span<const OutlineSegment> segments_;
    std::size_t cutters_ = 0;
    std::vector<TracedEdge> edges_;
    std::vector<Link> links_;
    std::vector<std::uint32_t> next_;  // of segments: the one that goes on
    std::vector<Normal> normals_;      // of segments
    std::vector<Meeting> meetings_;
    std::vector<std::size_t> first_meeting_;  // of segments
    std::vector<Stop> stops_;
    std::vector<Covers> at_stop_;  // of segments that end in the outline, without their cutter
    std::vector<std::uint8_t> walked_;
    Covers at_corner_ = 0;  // the first one
    // The plane in which turns are seen, turned so that the facet is counter-clockwise.
    std::size_t axis_u_ = 0;
    std::size_t axis_v_ = 0;
    bool has_projection_ = false;
};

}  // namespace trisect::detail
