// SPDX-License-Identifier: Apache-2.0
//
// MeshSection: sections of a mesh with horizontal planes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>

namespace trisect::detail {

/// Directed sides of a region that is on their left, seen from above. At each corner as many come
/// as go.
struct SectionSides {
    std::vector<Point2d> corners;
    std::vector<std::array<std::uint32_t, 2>> sides;
};

/// The winding number of the sides is that of the mesh, whether it meets itself or not. Where a
/// plane goes through corners or faces, the section is that of a plane right below or above it.
class MeshSection {
public:
    using Triangle = std::array<std::uint32_t, 3>;

    /// Refers to the mesh.
    MeshSection(const ExactMesh& mesh, double height);
    /// Of triangles. Refers to the mesh.
    MeshSection(const PolygonMesh& mesh, double height);

    /// Whether some triangle lies in the plane: if none does, both sections are one region.
    [[nodiscard]] bool has_face_in_plane() const;

    /// Corners are rounded to doubles, once; where the boundary goes straight on there is none.
    /// O(n)
    enum class Place : std::uint8_t { Below, Above };
    [[nodiscard]] SectionSides right(Place place) const;

private:
    friend class SectionCorners;

    double height_;
    std::vector<Triangle> triangles_;
    std::vector<std::int8_t> side_;        // by point: -1 below, 0 on, 1 above the plane
    std::vector<Point3d> near_;            // by point: rounded where it is no double
    std::vector<std::uint8_t> is_double_;  // by point
    const ExactMesh* exact_ = nullptr;     // of points that are no doubles
};

}  // namespace trisect::detail
