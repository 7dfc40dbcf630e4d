// SPDX-License-Identifier: Apache-2.0
//
// FacetTracing: outlines of crossed facets, without names of their vertices.
// Nothing is written but the object's own memory, so several threads trace different facets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/facet_marks.h>
#include <trisect/bsp/assembly/traced/facet_outline.h>
#include <trisect/bsp/assembly/traced/operand_table.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/shift/shifted_pairs.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A crossing segment on a facet.
struct TracedSegment {
    std::uint32_t pair = 0;  ///< of the crossings
    std::uint8_t side = 0;   ///< which of the pair's facets is the one that is traced
    bool open_below = false;
    std::uint32_t next = FacetOutline::none;  ///< the segment that begins where it ends
};

/// A facet whose outline is known.
struct TracedFacet {
    std::uint32_t number = 0;  ///< of the crossings
    bool is_special = false;
    std::span<const TracedSegment> segments;
    std::span<const TracedEdge> edges;  ///< none where nothing of the facet is left
    std::span<const OutlineMeetings::Point> meetings;
};

/// Copies of facets that were traced.
class TracedFacets {
public:
    void add(const TracedFacet& facet);
    template <class Visit>
    void for_each(const Visit& visit) const {
        std::size_t segment = 0;
        std::size_t edge = 0;
        std::size_t meeting = 0;
        for (const Entry& e : entries_) {
            visit(TracedFacet{e.number, e.is_special,
                              std::span(segments_).subspan(segment, e.segments),
                              std::span(edges_).subspan(edge, e.edges),
                              std::span(meetings_).subspan(meeting, e.meetings)});
            segment += e.segments;
            edge += e.edges;
            meeting += e.meetings;
        }
    }

private:
    struct Entry {
        std::uint32_t number = 0;
        bool is_special = false;
        std::uint32_t segments = 0;
        std::uint32_t edges = 0;
        std::uint32_t meetings = 0;
    };
    PoolVector<Entry> entries_;
    PoolVector<TracedSegment> segments_;
    PoolVector<TracedEdge> edges_;
    PoolVector<OutlineMeetings::Point> meetings_;
};

class FacetTracing final : ExactOutline {
public:
    /// `marks`: by operand, null where nothing is left of it. \pre worked facets are numbered
    FacetTracing(const Crossings& crossings, const OperandTable& operand_of,
                 std::span<FacetMarks* const> marks)
        : crossings_(crossings), operand_of_(operand_of), marks_(marks) {}

    /// How many segments there are on facets of smaller numbers. O(log n)
    [[nodiscard]] static std::size_t segments_before(const Crossings& crossings,
                                                     std::uint32_t number);

    /// Calls visit(TracedFacet) for those of the shown facets [begin, end) whose outlines doubles
    /// decide, in their order. Marks of other facets than these may change meanwhile.
    template <class Visit>
    void run(std::size_t begin, std::size_t end, const Visit& visit) {
        start_at(begin);
        for (std::size_t i = begin; i < end; ++i)
            if (traces(crossings_.shown[i]))
                visit(TracedFacet{crossings_.shown[i], special_ != none, listed_, outline_.edges(),
                                  outline_.meetings()});
    }

private:
    void start_at(std::size_t shown);
    void list_sides(std::uint32_t number);
    [[nodiscard]] bool traces(std::uint32_t number);
    [[nodiscard]] bool trace(const Source& source, std::uint32_t facet);
    [[nodiscard]] bool list_segments();
    [[nodiscard]] int order_on(std::size_t edge, std::uint32_t a, std::uint32_t b) const override;
    [[nodiscard]] Crossings::Corner first_corner() const override;
    [[nodiscard]] FacetCorners cutter_corners(std::uint32_t segment) const;

    static constexpr std::uint32_t none = ~std::uint32_t{0};
    const Crossings& crossings_;
    const OperandTable& operand_of_;
    std::span<FacetMarks* const> marks_;
    // What comes next: of pairs in the order of their first facets, of the second ones, and of
    // facets that are uncertain.
    std::size_t first_ = 0;
    std::size_t second_ = 0;
    std::size_t uncertain_ = 0;
    // Of one facet:
    std::uint32_t special_ = none;  // its number if it is in special position
    std::vector<TracedSegment> listed_;
    std::vector<OutlineSegment> segments_;
    FacetOutline outline_;
};

}  // namespace trisect::detail
