// SPDX-License-Identifier: Apache-2.0
//
// BrepBuilder: construction of a Brep from points and oriented polygons.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/planar_loops.h>

namespace trisect {

/// Collects vertices and faces, then connects them.
///
/// Mutable, for one thread, used once. Vertices are numbered by the builder; two different numbers
/// promise two different points. Neither the order nor the number of vertices changes the result
/// beyond the numbering: faces keep their order, vertices are numbered by their first use in it.
class BrepBuilder {
public:
    explicit BrepBuilder(Lattice lattice) : lattice_(lattice) {}

    void reserve(std::size_t vertices, std::size_t faces, std::size_t corners);

    std::uint32_t add_vertex(const Point& p);
    /// loops[0] is the outer loop, counter-clockwise seen from outside; the others are holes,
    /// clockwise. A loop has at least three corners, or two where it is a slit; loops may touch
    /// themselves and each other in vertices, and run along a segment in both directions. Then they
    /// are linked anew into the form that Brep states (invariant 6), and a face that falls apart
    /// becomes several with the same source. \pre all corners lie on the plane, whose normal points
    /// outward. \throw Error Internal when a loop is too short or names an unknown vertex.
    void add_face(const Plane& plane, const std::vector<std::vector<std::uint32_t>>& loops,
                  FaceSource source);
    /// A face without holes.
    void add_polygon(const Plane& plane, std::span<const std::uint32_t> loop, FaceSource source);

    [[nodiscard]] std::size_t vertex_count() const { return points_.size(); }
    [[nodiscard]] std::size_t face_count() const { return faces_.size(); }

    /// Pairs the halfedges, takes non-manifold edges and vertices apart (see Brep), finds the
    /// shells. Unused vertices are dropped. O(n) plus the sorting of the edges at each vertex.
    /// \throw Error InvalidSolid, with the edge's coordinates, when the faces on an edge do not
    /// use it equally often in both directions; LimitError beyond 2^32 - 2 halfedges.
    [[nodiscard]] Brep build() &&;

private:
    friend class BrepConnector;

    struct Face {
        std::uint32_t first_loop = 0;
        FaceSource source;
    };

    void check_loop(const Plane& plane, std::span<const std::uint32_t> loop) const;
    bool repeats_a_vertex(std::span<const std::uint32_t> loop);
    void append_regions(const Plane& plane, std::span<const IndexLoop> loops, FaceSource source);
    void append_loop(std::span<const std::uint32_t> loop);
    void append_face(const Plane& plane, FaceSource source);

    Lattice lattice_;
    std::vector<Point> points_;
    std::vector<std::uint32_t> corners_;
    std::vector<std::uint32_t> loop_begin_;
    std::vector<Face> faces_;
    std::vector<Plane> planes_;
    std::vector<std::uint32_t> seen_;  // by vertex: the last call of add_face that used it
    std::uint32_t call_ = 0;
};

}  // namespace trisect
