// SPDX-License-Identifier: Apache-2.0
//
// MillTool: convex parts of a tool in each of its orientations.
#pragma once

#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/solid.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mill_grid.h"

namespace trisect::app {

/// What the tool meets on one move.
struct SweptTool {
    Solid solid;
    std::vector<std::uint32_t> sources;  ///< FaceSource::operand of its faces
};

/// Each shell of the tool's mesh must be convex. What is used instead is the hull of its corners
/// after these were turned and rounded to the grid: rounding alone would leave faces that are a
/// little bent.
class MillTool {
public:
    /// \throw UnsupportedError when a shell is not convex: its hull has more than a hundred
    /// thousandth of volume that it has not, or it is a cavity
    MillTool(const PolygonMesh& mesh, const std::string& name, MillGrid& grid,
             const std::vector<std::array<double, 9>>& orientations);

    /// From one place to another, in lattice units, exactly. Where nothing is left to meet at the
    /// first place (`is_clear`), only the part of the tool that leads is swept: it meets the rest,
    /// has half the triangles, and its bottom overlaps the floor that the last step cut by half.
    [[nodiscard]] SweptTool swept(std::uint32_t orientation, const Point3d& from, const Point3d& to,
                                  bool is_clear);
    /// The same, each shell for itself.
    [[nodiscard]] std::vector<Solid> swept_shells(std::uint32_t orientation, const Point3d& from,
                                                  const Point3d& to, bool is_clear);
    /// The hulls in the first orientation.
    [[nodiscard]] std::vector<LatticeMesh> hulls() const;
    /// Largest part of a hull's volume that its shell has not.
    [[nodiscard]] double added_volume() const { return added_volume_; }

private:
    struct Part {
        LatticeMesh mesh;
        std::map<std::vector<bool>, LatticeMesh> leading;  // by leading_triangles()
    };
    [[nodiscard]] static const LatticeMesh& leading(Part& part, const std::array<double, 3>& by);

    std::vector<std::vector<Part>> parts_;  // by orientation
    double added_volume_ = 0;
};

/// The parts of a mesh that are connected by edges, with corners of equal value joined. Shells that
/// touch are apart.
[[nodiscard]] std::vector<PolygonMesh> shells_of(const PolygonMesh& mesh);

}  // namespace trisect::app
