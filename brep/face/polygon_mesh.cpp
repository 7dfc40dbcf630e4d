// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/polygon_mesh.h>

#include <limits>

#include <trisect/kernel/error.h>

namespace trisect {

void append(PolygonMesh& mesh, const PolygonMesh& other) {
    if (&mesh == &other) {
        append(mesh, PolygonMesh(other));
        return;
    }
    constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max();
    if (mesh.points.size() + other.points.size() > limit ||
        mesh.corners.size() + other.corners.size() > limit)
        throw LimitError("two meshes of more than 2^32 - 1 points or corners together");
    const auto first_point = static_cast<std::uint32_t>(mesh.points.size());
    const auto first_corner = static_cast<std::uint32_t>(mesh.corners.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (const std::uint32_t v : other.corners) mesh.corners.push_back(first_point + v);
    for (std::size_t f = 1; f < other.face_begin.size(); ++f)
        mesh.face_begin.push_back(first_corner + other.face_begin[f]);
}

}  // namespace trisect
