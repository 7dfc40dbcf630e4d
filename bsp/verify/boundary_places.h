// SPDX-License-Identifier: Apache-2.0
//
// BoundaryPlaces: the places on an exact boundary that corners stand for.
// Vertices, and points within edges and faces, for corner_match.h.
//
// All lengths are in lattice units and in the maximum norm.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_point.h>
#include <trisect/brep/measure/grid_distance.h>

namespace trisect::detail {

/// The triangles of a boundary's faces.
struct BoundaryTriangles {
    GridTriangles triangles;
    std::vector<FaceId> faces;  ///< of each triangle
};
[[nodiscard]] BoundaryTriangles boundary_triangles(const Brep& brep);

/// Numbers of places: first the vertices, of copies of one only the first, then others as they are
/// found. Invariant: a place within an edge lies in its faces, strictly between its ends; one
/// within a face lies on its plane.
class BoundaryPlaces {
public:
    using Place = std::uint32_t;
    static constexpr Place none = UINT32_MAX;

    /// Both stay where they are.
    BoundaryPlaces(const Brep& brep, const BoundaryTriangles& surface, double reach);

    /// A vertex that is at most `reach` away in each coordinate, else a point of an edge that is,
    /// else one of a face, else the corner itself, in no face. O(log n).
    [[nodiscard]] Place place_at(const GridPoint& corner);
    [[nodiscard]] Place place_of(VertexId v) const;
    /// The largest distance of a corner from its place so far.
    [[nodiscard]] Int128 largest_move() const { return largest_move_; }

    [[nodiscard]] std::size_t count() const { return at_.size(); }
    [[nodiscard]] const GridPoint& at(Place p) const { return at_[p]; }
    /// Faces that the place lies in, ascending.
    [[nodiscard]] const std::vector<std::uint32_t>& faces_at(Place p) const { return faces_[p]; }
    /// Of three places in a face's plane: 1 counter-clockwise seen from above it, 0 on one line.
    [[nodiscard]] int orientation(FaceId face, const std::array<Place, 3>& t) const;
    /// Places within the edge of a halfedge, from its origin on.
    [[nodiscard]] std::vector<Place> within(HalfedgeId h) const;

private:
    struct Cell {
        std::int64_t x = 0, y = 0, z = 0;
    };
    /// A place that is no vertex.
    struct Extra {
        ExactPoint point;  ///< in lattice units
        Approximation approximation;
    };
    /// An edge that all copies of it share, from its lesser place to its greater one.
    struct Segment {
        EdgeId edge;
        Place from = none, to = none;
    };

    void list_vertices();
    [[nodiscard]] Place nearest_vertex(const GridPoint& corner) const;
    [[nodiscard]] bool look(const Cell& cell, const GridPoint& corner, std::size_t& seen,
                            Place& best, Int128& least) const;
    [[nodiscard]] Cell cell_of(const GridPoint& p) const;
    void list_segments();
    [[nodiscard]] Place place_within_edge(const GridPoint& corner);
    [[nodiscard]] Place place_within_face(const GridPoint& corner);
    Place add(ExactPoint point, std::vector<std::uint32_t> faces);
    [[nodiscard]] ExactPoint exact(Place p) const;
    [[nodiscard]] const Approximation& approximation(Place p) const;

    const Brep& brep_;
    const BoundaryTriangles& surface_;
    const double reach_;
    const Int128 grid_reach_;
    std::vector<GridPoint> at_;  ///< of each place
    std::vector<std::vector<std::uint32_t>> faces_;
    std::vector<Extra> extra_;
    std::unordered_multimap<std::uint64_t, Place>
        cells_;                         ///< vertices, in cubes of twice the reach
    std::map<GridPoint, Place> known_;  ///< corners
    std::vector<Segment> segments_;
    std::optional<GridTriangles> segment_search_;  ///< made for the first corner near no vertex
    /// Within each edge, by the first of its copies: the places along it, as parameters.
    std::map<EdgeId, std::map<double, Place>> within_;
    Int128 largest_move_ = 0;
};

}  // namespace trisect::detail
