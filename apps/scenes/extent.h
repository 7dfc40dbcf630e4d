// SPDX-License-Identifier: Apache-2.0
//
// The box around a mesh.
#pragma once

#include <algorithm>
#include <cmath>

#include <trisect/brep/polygon_mesh.h>

namespace scenes {

struct Extent {
    trisect::Point3d lo{};
    trisect::Point3d hi{};
    [[nodiscard]] double diagonal() const {
        return std::hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
    }
};

/// \pre the mesh has points.
[[nodiscard]] inline Extent extent(const trisect::PolygonMesh& mesh) {
    Extent e{mesh.points.front(), mesh.points.front()};
    for (const trisect::Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) {
            e.lo[k] = std::min(e.lo[k], p[k]);
            e.hi[k] = std::max(e.hi[k], p[k]);
        }
    return e;
}

}  // namespace scenes
