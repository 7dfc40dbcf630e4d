// SPDX-License-Identifier: Apache-2.0
//
// Slices of solids: sections with many parallel planes, found in one walk over the boundary.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/slice_frame.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// What belongs to the slice at a height where the boundary has a face. Everywhere else all three
/// are the same set. In none of them does it count what touches the plane with edges and points.
enum class SliceRule : std::uint8_t {
    Closed,  ///< the face, on whichever side the solid is: as section()
    Below,   ///< what is right below the plane: a box has its top, and not its bottom
    Above    ///< what is right above it: a box has its bottom, and not its top
};

struct SliceOptions {
    SliceFrame frame = {};  ///< the planes; across z by default
    SliceRule rule = SliceRule::Closed;
    /// Threads that may trace slices, and what counts as inside of a mesh that meets itself.
    EvaluateOptions evaluate = {};
};

/// The points of a solid in a plane, in coordinates of the frame.
struct Slice {
    double height = 0;
    std::vector<Point2d> points;
    /// Outlines counter-clockwise, holes clockwise; the inside is on the left of every loop. None
    /// has a corner where it goes straight on, but where something touches it. Loops touch each
    /// other and themselves in corners at most.
    std::vector<std::vector<std::uint32_t>> loops;
    /// Connected pieces, by numbers of loops: the outline first, then its holes. Pieces may lie in
    /// holes of others; they and their holes are in the order of their smallest corners.
    std::vector<std::vector<std::uint32_t>> regions;
    /// Whether all corners of the section are doubles; else some were rounded, each once. (Twice
    /// where rounding made sides cross, or coordinates of one slice span more than 126 bits.)
    bool is_exact = true;

    friend bool operator==(const Slice&, const Slice&) = default;
};

/// How slices were found (kernel/diagnostics.h), each height once.
struct SliceCounters {
    std::uint64_t walked = 0;     ///< by a walk from triangle to triangle: loops as they come
    std::uint64_t arranged = 0;   ///< by the arrangement of regions, which resolves what meets:
    std::uint64_t faces = 0;      ///< of them, where a face lies in the plane, under Closed
    std::uint64_t touching = 0;   ///< of them, where a corner has several sides that come and go
    std::uint64_t collapsed = 0;  ///< of them, where rounding made corners equal
    /// Of them, all others whose rounded loops were not proved to be simple and apart.
    std::uint64_t crossing = 0;

    SliceCounters& operator+=(const SliceCounters& o);
    SliceCounters& operator-=(const SliceCounters& o);
    friend bool operator==(const SliceCounters&, const SliceCounters&) = default;
};

/// A slice for each height, in the order of the heights, which may be any, and may repeat. A slice
/// across z under SliceRule::Closed has the points and loops of section() at its height.
///
/// The boundary is assembled once, and its facets are given to the planes that they meet in one
/// walk: O(n log m + k log k) for n facets, m heights and the k sides of all slices, but for the
/// assembly, and for layers that are arranged (SliceCounters). Slices are traced on several
/// threads, and do not depend on how many there are; on one where a StopScope limits work or
/// memory. Heights outside the solid, and the empty set, have empty slices. \throw UnsupportedError
/// for an unbounded set, UsageError for a height that is not finite, LimitError beyond 2^31 sides,
/// what evaluate() throws
[[nodiscard]] std::vector<Slice> slices(const Solid& solid, std::span<const double> heights,
                                        const SliceOptions& options = {});
[[nodiscard]] std::vector<Slice> slices(const Solid& solid, std::span<const double> heights,
                                        const EvaluateOptions& options);

/// The same of the boundary of a bounded solid, which Solid::to_exact_mesh() made before.
[[nodiscard]] std::vector<Slice> slices(const ExactMesh& boundary, std::span<const double> heights,
                                        const SliceOptions& options = {});

/// The same of a closed mesh of triangles, which may meet itself: what it goes around.
[[nodiscard]] std::vector<Slice> slices_of_mesh(const PolygonMesh& mesh,
                                                std::span<const double> heights,
                                                const SliceOptions& options = {});

/// The area of a slice, and of one of its regions, without holes. Of the corners as they are: sums
/// in pairs of doubles, whose errors do not show but next to cancellation of 40 digits.
[[nodiscard]] double area(const Slice& slice, const SliceFrame& frame = {});
[[nodiscard]] double area_of_region(const Slice& slice, std::size_t region,
                                    const SliceFrame& frame = {});
/// The length of all loops, holes too. In doubles.
[[nodiscard]] double perimeter(const Slice& slice, const SliceFrame& frame = {});

}  // namespace trisect
