// SPDX-License-Identifier: Apache-2.0
//
// ConvexPolytope: a convex lattice polytope with vertices, edges and maximal faces.
// It is exact.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/plane.h>

namespace trisect::hierarchies {

/// A vertex, edge or face of one polytope. Ordered by kind, then number.
struct PolytopeFeature {
    enum class Kind : std::uint8_t { Vertex, Edge, Face };
    Kind kind = Kind::Vertex;
    std::uint32_t index = 0;

    [[nodiscard]] static constexpr PolytopeFeature vertex(std::size_t i) {
        return {Kind::Vertex, static_cast<std::uint32_t>(i)};
    }
    [[nodiscard]] static constexpr PolytopeFeature edge(std::size_t i) {
        return {Kind::Edge, static_cast<std::uint32_t>(i)};
    }
    [[nodiscard]] static constexpr PolytopeFeature face(std::size_t i) {
        return {Kind::Face, static_cast<std::uint32_t>(i)};
    }
    friend constexpr auto operator<=>(const PolytopeFeature&, const PolytopeFeature&) = default;
};

/// The convex hull of finitely many lattice points, of any dimension:
///   -1  empty
///    0  a point: one vertex
///    1  a segment: two vertices and an edge without faces
///    2  a polygon: two faces with opposite planes and the same corners, each edge between them
///    3  a body: V - E + F = 2
///
/// Vertices are the extreme points in lexicographic order; no three corners of a face are
/// collinear, no two neighbouring faces coplanar unless the dimension is 2. The order of edges and
/// faces follows from that of vertices, so equal sets are equal polytopes.
///
/// Immutable value type; made by convex_hull. Safe to read from many threads.
class ConvexPolytope {
public:
    static constexpr std::uint32_t none = 0xffffffffU;

    struct Edge {
        /// The smaller vertex first.
        std::array<std::uint32_t, 2> vertex{none, none};
        /// To the left of the way from vertex[0] to vertex[1], seen from outside, and to its right.
        std::array<std::uint32_t, 2> face{none, none};
        /// A corner of each face off the edge.
        std::array<std::uint32_t, 2> across{none, none};
    };
    /// An edge at a vertex, and the vertex at its other end.
    struct Spoke {
        std::uint32_t edge = none;
        std::uint32_t vertex = none;
    };

    ConvexPolytope() = default;
    /// From the extreme points and the loops of the maximal faces, counter-clockwise seen from
    /// outside. \pre they are those of a convex polytope of dimension 2 or 3. Numbers anew.
    ConvexPolytope(Lattice lattice, int dimension, std::span<const LatticePoint> vertices,
                   std::span<const std::vector<std::uint32_t>> loops);
    /// One point, or the ends of a segment.
    ConvexPolytope(Lattice lattice, std::span<const LatticePoint> ends);

    [[nodiscard]] bool is_empty() const { return dimension_ < 0; }
    [[nodiscard]] int dimension() const { return dimension_; }
    [[nodiscard]] Lattice lattice() const { return lattice_; }

    [[nodiscard]] std::span<const LatticePoint> vertices() const { return vertices_; }
    [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
    [[nodiscard]] std::size_t face_count() const { return planes_.size(); }
    /// Its normal points outwards.
    [[nodiscard]] const Plane& plane(std::size_t face) const { return planes_[face]; }
    /// Counter-clockwise seen from outside; the smallest vertex first.
    [[nodiscard]] std::span<const std::uint32_t> corners(std::size_t face) const {
        return std::span(corners_).subspan(first_corner_[face],
                                           first_corner_[face + 1] - first_corner_[face]);
    }
    /// Edge i leads from corner i to corner i + 1.
    [[nodiscard]] std::span<const std::uint32_t> sides(std::size_t face) const {
        return std::span(sides_).subspan(first_corner_[face],
                                         first_corner_[face + 1] - first_corner_[face]);
    }
    /// Three corners of a face, counter-clockwise and not collinear, far apart.
    [[nodiscard]] const std::array<std::uint32_t, 3>& span_of(std::size_t face) const {
        return spans_[face];
    }
    [[nodiscard]] std::span<const Spoke> spokes(std::size_t vertex) const {
        return std::span(spokes_).subspan(first_spoke_[vertex],
                                          first_spoke_[vertex + 1] - first_spoke_[vertex]);
    }
    /// The largest magnitude of a coordinate.
    [[nodiscard]] double largest() const { return largest_; }
    /// Whether all coordinates are whole.
    [[nodiscard]] bool is_whole() const { return whole_; }
    [[nodiscard]] std::size_t bytes() const;

    /// Whether a point is in the closed set, for dimensions 2 and 3; exact. O(faces).
    [[nodiscard]] bool contains(const LatticePoint& p) const;

private:
    void make_edges();
    void make_spokes();
    void note_sizes();

    Lattice lattice_;
    int dimension_ = -1;
    double largest_ = 0;
    bool whole_ = true;
    std::vector<LatticePoint> vertices_;
    std::vector<Edge> edges_;
    std::vector<Plane> planes_;
    std::vector<std::array<std::uint32_t, 3>> spans_;
    std::vector<std::uint32_t> corners_;
    std::vector<std::uint32_t> sides_;
    std::vector<std::uint32_t> first_corner_{0};
    std::vector<Spoke> spokes_;
    std::vector<std::uint32_t> first_spoke_{0};
};

}  // namespace trisect::hierarchies
