// SPDX-License-Identifier: Apache-2.0
//
// ConvexPolygon: a convex polygon given by planes alone.
// It is the piece of surface that partitions cut.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/side.h>

namespace trisect {

/// A bounded convex polygon with interior: the part of its support plane that is Below all of its
/// edge planes. Empty when default-constructed.
///
/// Invariants of a polygon that is not empty, n = size() >= 3:
///  - edges run counter-clockwise seen from above the support; edge i leads from vertex i to
///    vertex i+1, and vertex i is the common point of support, edge i-1 and edge i (mod n);
///  - it is strictly convex: vertex i is Below every edge plane except edges i-1 and i.
///
/// No plane is ever made by cutting: the pieces of a cut are bounded by the given plane and by
/// planes that were there before, so coefficients do not grow along a cascade of cuts. A vertex may
/// keep an older name (three other planes through it); the point is the same.
///
/// Regular value type of two vectors, n planes (112 bytes) and n points (72 bytes, shared names).
/// Safe to read from many threads.
///
/// Source: Bernstein, Fussell, Fast, exact, linear Booleans (SGP 2009), sec. 3.
class ConvexPolygon {
public:
    /// How the vertices lie with respect to a plane. All zero for the empty polygon.
    struct Classification {
        std::size_t below = 0;
        std::size_t on = 0;
        std::size_t above = 0;

        /// The plane contains the polygon.
        [[nodiscard]] bool is_coplanar() const { return on > 0 && below == 0 && above == 0; }
        /// Both sides of the plane hold a part with area. Touching in a vertex or edge is no cut.
        [[nodiscard]] bool is_cut() const { return below > 0 && above > 0; }
        /// The side that holds the interior. \pre !is_cut(); On for coplanar and empty polygons.
        [[nodiscard]] Side side() const {
            return below > 0 ? Side::Below : (above > 0 ? Side::Above : Side::On);
        }
        friend bool operator==(const Classification&, const Classification&) = default;
    };

    ConvexPolygon() = default;

    /// \pre the planes satisfy the invariants above (see is_consistent). O(n) intersections.
    /// \throw Error (Internal) when there are less than three edges or when a vertex is no point.
    ConvexPolygon(const Plane& support, std::vector<Plane> edges);

    /// The triangle a, b, c, counter-clockwise seen from above. Its edge planes are parallel to the
    /// dominant axis of the support: coefficients of one degree instead of two.
    /// \throw Error (Internal) when the corners are collinear.
    [[nodiscard]] static ConvexPolygon from_triangle(const LatticePoint& a, const LatticePoint& b,
                                                     const LatticePoint& c);
    /// The same for a strictly convex polygon whose corners lie on the given plane,
    /// counter-clockwise seen from above it. \pre as said; checked in audit builds.
    [[nodiscard]] static ConvexPolygon from_corners(const Plane& support,
                                                    std::span<const LatticePoint> corners);

    [[nodiscard]] bool is_empty() const { return edges_.empty(); }
    /// Number of vertices, which is the number of edges.
    [[nodiscard]] std::size_t size() const { return edges_.size(); }
    [[nodiscard]] const Plane& support() const { return support_; }
    [[nodiscard]] std::span<const Plane> edges() const { return edges_; }
    [[nodiscard]] const Plane& edge(std::size_t i) const { return edges_[i]; }
    [[nodiscard]] std::span<const Point> vertices() const { return vertices_; }
    [[nodiscard]] const Point& vertex(std::size_t i) const { return vertices_[i]; }

    /// Exact side of vertex i. A plane that names the vertex needs no arithmetic.
    [[nodiscard]] Side side_of_vertex(std::size_t i, const Plane& plane) const;

    /// O(n) predicates.
    [[nodiscard]] Classification classify(const Plane& plane) const;

    /// Cuts the polygon into its parts Below and Above a plane. Where the returned classification
    /// is a cut, both parts have area and meet in the new edge; otherwise nothing is written to
    /// them and the classification locates the whole polygon. `below` and `above` may be this
    /// polygon. O(n) predicates, at most two new points.
    Classification split(const Plane& plane, ConvexPolygon& below, ConvexPolygon& above) const;

    /// The part on the closed lower or upper side of a plane: the whole polygon when it touches
    /// the plane from there or lies on it, empty when what remains would have no area.
    [[nodiscard]] ConvexPolygon clip_below(const Plane& plane) const;
    [[nodiscard]] ConvexPolygon clip_above(const Plane& plane) const;

    /// Same point set, seen from the other side. Vertex 0 stays vertex 0.
    [[nodiscard]] ConvexPolygon flipped() const;

    /// Whether the invariants hold. O(n²) predicates; for tests and audit builds.
    [[nodiscard]] bool is_consistent() const;

private:
    ConvexPolygon(const Plane& support, std::vector<Plane> edges, std::vector<Point> vertices);

    struct Crossing;
    [[nodiscard]] Classification sides_of_vertices(const Plane& plane,
                                                   std::vector<Side>& sides) const;
    [[nodiscard]] Crossing crossing(const Plane& plane, const std::vector<Side>& sides,
                                    Side from) const;
    [[nodiscard]] ConvexPolygon part(const Crossing& enter, const Crossing& leave,
                                     const Plane& closing) const;

    Plane support_;
    std::vector<Plane> edges_;
    std::vector<Point> vertices_;
};

}  // namespace trisect
