// SPDX-License-Identifier: Apache-2.0
//
// Insertion of shared corners and edges where faces meet.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/polygon_mesh.h>

namespace trisect::detail {

/// Where a solid touches itself, an edge may lie in a face that does not contain it as an edge;
/// exactly so before rounding, about so after. Such corners and edges are inserted into the
/// triangles that they touch: a corner next to an edge divides the edge, in all triangles at it, a
/// corner next to the inside of a triangle divides the triangle, and edges next to each other
/// divide each other. What was closed stays closed. One point for each edge and triangle at a time,
/// so it takes a few passes.
class ContactInsertion {
public:
    using Rounding = std::function<Point3d(const Point3d&)>;

    /// \pre all faces are triangles. Nothing is inserted that is farther away than `reach`.
    ContactInsertion(const PolygonMesh& mesh, double reach, Rounding rounding)
        : mesh_(mesh), reach_(reach), rounding_(std::move(rounding)) {}

    /// Looks for contacts of two faces that are said to meet.
    void add(std::uint32_t f, std::uint32_t g);
    [[nodiscard]] bool is_empty() const { return edges_.empty() && faces_.empty(); }
    /// No point of the surface is moved farther than this; in the user's units, about.
    [[nodiscard]] double largest_move() const { return largest_move_; }
    /// `parents`, where given, gets the triangle of the mesh that each one is a part of. Inserted
    /// corners that the mesh has already keep their numbers.
    [[nodiscard]] PolygonMesh divided(std::vector<std::uint32_t>* parents = nullptr) const;

private:
    using Triangle = std::array<Point3d, 3>;
    using Edge = std::pair<Point3d, Point3d>;  // the smaller point first

    [[nodiscard]] Triangle triangle(std::uint32_t f) const;
    bool add_corners(const Triangle& of, std::uint32_t g);
    void add_crossings(const Triangle& f, const Triangle& g);
    void divide(const Point3d& a, const Point3d& b, const Point3d& at, double distance);
    [[nodiscard]] std::map<Point3d, std::uint32_t> known_points() const;

    const PolygonMesh& mesh_;
    double reach_;
    Rounding rounding_;
    std::map<Edge, Point3d> edges_;
    std::map<std::uint32_t, Point3d> faces_;
    double largest_move_ = 0;
};

}  // namespace trisect::detail
