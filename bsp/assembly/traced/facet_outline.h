// SPDX-License-Identifier: Apache-2.0
//
// FacetOutline: the visible part of a facet, from its crossing segments.
// Other operands leave this part open; the segments are where their facets cross it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/traced/outline_meetings.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A vertex of the open part.
struct OutlinePoint {
    enum class Kind : std::uint8_t {
        Corner,   ///< of the facet: `which`
        End,      ///< of the segment `place`: `which`
        Meeting,  ///< where two segments of different cutters cross: number `place`
    };
    Kind kind = Kind::Corner;
    std::int8_t which = 0;
    std::uint32_t place = 0;
};

/// An edge of the open part, which is on its left seen from above the facet.
struct TracedEdge {
    OutlinePoint from;
    OutlinePoint to;
    std::int8_t edge = -1;      ///< of the facet; -1: it lies in a segment
    std::uint32_t segment = 0;  ///< which one
};

/// What is known besides of a facet in special position, where points may coincide without the
/// shift of one mesh (Crossings::special).
class ExactOutline {
public:
    ExactOutline() = default;
    ExactOutline(const ExactOutline&) = delete;
    ExactOutline& operator=(const ExactOutline&) = delete;
    virtual ~ExactOutline() = default;
    /// -1, 1: the order of the ends of two segments on an edge of the facet, along the edge; 0 when
    /// it is not known.
    [[nodiscard]] virtual int order_on(std::size_t edge, std::uint32_t a,
                                       std::uint32_t b) const = 0;
    /// Of the only cutter, whether it leaves the first corner open.
    [[nodiscard]] virtual Crossings::Corner first_corner() const = 0;
};

/// Traces facets that others cross in general position; keeps its memory.
class FacetOutline {
public:
    static constexpr std::size_t max_cutters = 64;

    /// False when doubles cannot decide, nor `exact` where there is one, more than max_cutters
    /// operands cross the facet, or the segments are not what closed boundaries leave. O(n^2) for n
    /// segments.
    [[nodiscard]] bool trace(const std::array<const LatticePoint*, 3>& corners,
                             std::span<const OutlineSegment> segments,
                             const ExactOutline* exact = nullptr);
    /// The same for a whole plane that one operand crosses and contains far out: all paths are
    /// closed. O(n log n).
    [[nodiscard]] bool trace_section(const Plane& plane, std::span<const OutlineSegment> segments);
    /// Edges of the open part, in no order; none where it is empty.
    [[nodiscard]] std::span<const TracedEdge> edges() const { return edges_; }
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    /// The segment that begins where one ends inside the facet, else none.
    [[nodiscard]] std::uint32_t next(std::uint32_t segment) const { return next_[segment]; }
    [[nodiscard]] std::span<const OutlineMeetings::Point> meetings() const {
        return meetings_.points();
    }

private:
    /// A bit for each cutter that contains a point.
    using Containments = std::uint64_t;
    /// Where a segment ends in the facet's outline.
    struct Stop {
        double along = 0;
        double error = 0;
        std::uint32_t segment = 0;
        std::int8_t end = 0;  // of the segment; at its last one the cutter leaves open what follows
    };
    /// A start inside the facet.
    struct Start {
        std::uint64_t through = 0;
        std::uint32_t cutter = 0;
        std::uint32_t segment = 0;
        bool taken = false;
        [[nodiscard]] bool is_before(std::uint64_t other, std::uint32_t of) const {
            return through != other ? through < other : cutter < of;
        }
    };

    [[nodiscard]] Start* start_at(std::uint64_t through, std::uint32_t cutter);
    [[nodiscard]] bool link_segments();
    [[nodiscard]] bool sort_stops();
    [[nodiscard]] bool sort_stops_on(std::size_t edge);
    [[nodiscard]] bool find_containments_at_corner();
    [[nodiscard]] bool has_open_outside(std::uint32_t cutter, bool& open);
    [[nodiscard]] bool walk_outline();
    [[nodiscard]] bool walk_paths();
    [[nodiscard]] bool walk_closed_paths();
    [[nodiscard]] bool walk_path(std::uint32_t start, Containments containments);
    [[nodiscard]] bool start_from_meeting(std::uint32_t segment, Containments& containments);
    [[nodiscard]] bool start_from_corner(std::uint32_t segment, Containments& containments);

    [[nodiscard]] bool set_projection();
    [[nodiscard]] int turn(const Approximation& a, const Approximation& b,
                           const Approximation& c) const;
    [[nodiscard]] Containments bit(std::uint32_t segment) const {
        return Containments{1} << segments_[segment].cutter;
    }
    std::array<const LatticePoint*, 3> corners_{};
    std::span<const OutlineSegment> segments_;
    const ExactOutline* exact_ = nullptr;
    std::size_t cutters_ = 0;
    std::vector<TracedEdge> edges_;
    std::vector<Start> starts_;
    bool sorted_starts_ = false;
    PoolVector<std::uint32_t> next_;  // of segments: the one that goes on
    OutlinePlane plane_;
    OutlineMeetings meetings_;
    std::array<std::vector<Stop>, 3> stops_;  // of edges, in the order of a walk
    std::vector<Containments>
        at_stop_;  // of segments that end in the outline, without their cutter
    std::vector<std::uint8_t> walked_;
    std::vector<std::uint32_t> meeting_;  // segments of closed paths that meet others
    Containments at_corner_ = 0;          // the first one
    // The plane in which turns are seen, turned so that the facet is counter-clockwise.
    std::size_t axis_u_ = 0;
    std::size_t axis_v_ = 0;
    bool has_projection_ = false;
};

}  // namespace trisect::detail
