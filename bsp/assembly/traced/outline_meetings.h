// SPDX-License-Identifier: Apache-2.0
//
// OutlineMeetings: intersections of the crossing segments on one facet.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/support/float4.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A segment in which a facet of another operand, a cutter, crosses the facet. It is directed so
/// that what the cutter leaves open is on its left.
struct OutlineSegment {
    std::uint32_t cutter = 0;                  ///< a small number for each operand
    bool open_below = false;                   ///< the open side of the cutter's facet
    std::array<const Approximation*, 2> at{};  ///< its ends
    std::array<std::int8_t, 2> edge{};  ///< of the facet, where an end lies in its outline; else -1
    /// Where an end lies inside: a name for the edge of the cutter that pierces the facet there.
    std::array<std::uint64_t, 2> through{};
};

/// The plane of a facet in doubles. For the bounds see filtered_facets.cpp.
struct OutlinePlane {
    std::array<double, 3> origin{};
    std::array<double, 3> normal{};
    std::array<double, 3> minor{};  ///< of the normal's magnitudes

    OutlinePlane() = default;
    explicit OutlinePlane(const std::array<const LatticePoint*, 3>& corners);
    /// Of a plane that has no corners, from some point near it.
    OutlinePlane(const Plane& plane, const std::array<double, 3>& near);
    /// The axis along which the normal is longest, as far as doubles decide.
    [[nodiscard]] std::size_t dominant_axis() const;
};

/// Keeps its memory from facet to facet.
class OutlineMeetings {
public:
    /// On a segment, where one of another cutter crosses it.
    struct Meeting {
        std::uint32_t other = 0;   ///< that segment
        std::uint32_t point = 0;   ///< the number of the common point
        bool opens = false;        ///< from there on the other cutter leaves open, or contains
        std::uint64_t before = 0;  ///< for the caller
        double along = 0;          ///< of several, the way along one axis
    };
    struct Point {
        std::array<std::uint32_t, 2> segments{};
        std::array<bool, 2> opens{};  ///< for each of them: whether the other one's cutter does
        Approximation at;
    };

    /// False when doubles cannot decide which segments of different cutters cross, or in what
    /// order. O(n^2), four pairs at a time.
    [[nodiscard]] bool find(const OutlinePlane& facet, std::span<const OutlineSegment> segments,
                            std::size_t cutters);
    /// In their order along the segment.
    [[nodiscard]] std::span<Meeting> of(std::uint32_t segment) {
        return std::span(meetings_).subspan(first_[segment], first_[segment + 1] - first_[segment]);
    }
    [[nodiscard]] std::span<const Point> points() const { return points_; }
    /// How many pairs single precision has left to doubles.
    [[nodiscard]] std::size_t compared() const { return compared_; }

private:
    // What four segments reach to along two axes, rounded.
    struct BoxRow {
        std::array<Float4, 2> low;
        std::array<Float4, 2> high;
    };
    struct Values {
        std::array<double, 2> at{};
        double error = 0;
        bool known = false;
    };
    [[nodiscard]] bool set_axes(const OutlinePlane& facet);
    void make_boxes(const OutlinePlane& facet);
    [[nodiscard]] bool compare_with_all(std::uint32_t a);
    [[nodiscard]] bool compare(std::uint32_t a, std::uint32_t b);
    [[nodiscard]] bool add_point(const std::array<std::uint32_t, 2>& segments,
                                 const std::array<Values, 2>& values);
    [[nodiscard]] bool sort_meetings();
    [[nodiscard]] bool sort_along(const OutlineSegment& segment, std::span<Meeting> run) const;
    [[nodiscard]] Values values_of(const OutlineSegment& line, const OutlineSegment& s) const;

    std::span<const OutlineSegment> segments_;
    // Of the projection, turned so that the facet is seen from above.
    std::array<std::size_t, 2> axes_{};
    std::vector<BoxRow> boxes_;
    std::vector<Point> points_;
    std::vector<Meeting> meetings_;
    PoolVector<std::uint32_t> first_;  // of segments
    PoolVector<std::uint32_t> next_;
    std::size_t compared_ = 0;
};

}  // namespace trisect::detail
