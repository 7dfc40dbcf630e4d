// SPDX-License-Identifier: Apache-2.0
//
// The facets of a convex hull of points.
//
// Quickhull (Barber, Dobkin and Huhdanpaa 1996), with exact sides. Each facet has a list of points
// above it. The farthest of one list replaces all facets that it is above by those between it and
// their outline, and the points of their lists go to these. A facet whose plane holds the point is
// not replaced; so no point is on the line of an edge of the outline, which lies in the plane of a
// facet that is, and no facet is degenerate.
//
// No point is lost: say that q is above a facet that is replaced and, outside the new hull, above
// one that stays. The facets that q is above are connected by edges, so two of them, one replaced
// and one not, share an edge of the outline. The normal of the new facet at it is a combination of
// theirs without negative factors, so q is above the new facet, too.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/plane.h>

namespace trisect::detail {

class HullFacets {
public:
    using Triangle = std::array<std::uint32_t, 3>;

    struct Facet {
        Triangle corners{};
        Triangle neighbours{};  ///< across the edges from corner i to the next one
        Plane plane;
    };

    /// Expected O(n log n) for points on a round hull; at worst O(n f) for f facets of the result.
    /// \throw UsageError when all points lie in one plane; CancelledError, LimitError of StopScope.
    explicit HullFacets(std::span<const LatticePoint> points);

    /// Triangles, counter-clockwise from outside; those of one plane are separate.
    [[nodiscard]] const std::vector<Facet>& facets() const { return facets_; }

private:
    static constexpr std::uint32_t none = 0xffffffff;

    struct State {
        std::uint32_t first_above = none;  // a list of points, linked by next_
        std::uint32_t farthest = none;     // of these, in doubles
        double distance = 0;               // of the farthest one, in units of the plane's normal
        std::uint32_t round = 0;           // when its side was found last
        bool is_seen = false;              // in that round
        bool is_alive = true;
    };
    struct OutlineEdge {
        std::uint32_t from, to;
        std::uint32_t outside;  // the facet beyond, which stays
    };

    [[nodiscard]] std::array<std::uint32_t, 4> first_four() const;
    void start();
    std::uint32_t add_facet(const Triangle& corners);
    void set_neighbour(std::uint32_t facet, std::uint32_t from, std::uint32_t neighbour);
    void give(std::uint32_t point, std::span<const std::uint32_t> facets);
    [[nodiscard]] bool sees(std::uint32_t point, std::uint32_t facet);
    void add_point(std::uint32_t point, std::uint32_t facet);
    void find_seen(std::uint32_t point, std::uint32_t facet);
    void add_cone(std::uint32_t point);
    void distribute(std::uint32_t point);
    void drop_dead();

    std::span<const LatticePoint> points_;
    std::vector<Facet> facets_;
    std::vector<State> states_;
    std::vector<std::uint32_t> next_;      // of a point, in the list of its facet
    std::vector<std::uint32_t> starting_;  // of a corner of the outline: the new facet that starts
    std::vector<std::uint32_t> pending_;   // facets whose lists may have points
    std::vector<std::uint32_t> free_;      // places of facets that were replaced
    std::uint32_t round_ = 0;
    // Of the present round.
    std::vector<std::uint32_t> seen_;
    std::vector<OutlineEdge> outline_;
    std::vector<std::uint32_t> cone_;
};

}  // namespace trisect::detail
