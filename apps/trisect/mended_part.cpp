// SPDX-License-Identifier: Apache-2.0
//
// Corners are found by their places. Vertices that were joined or rounded are moved to their new
// ones before, in a copy of the mesh that was given.
#include "mended_part.h"

#include <trisect/bsp/property_mesh.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace trisect::app {
namespace {

PolygonMesh with_moved_points(const PolygonMesh& given, const MendedMesh& mended) {
    std::map<Point3d, Point3d> moved;
    for (std::size_t p = 0; p < mended.mesh.points.size(); ++p)
        moved.emplace(given.points[mended.source_of_point[p]], mended.mesh.points[p]);
    // One that others were joined to may have been joined itself.
    for (bool is_new = true; is_new;) {
        is_new = false;
        for (const JoinedVertex& joined : mended.report.joined) {
            const auto end = moved.find(given.points[joined.into]);
            if (end != moved.end())
                is_new |= moved.emplace(given.points[joined.vertex], end->second).second;
        }
    }
    PolygonMesh out = given;
    for (Point3d& point : out.points)
        if (const auto found = moved.find(point); found != moved.end()) point = found->second;
    return out;
}

std::vector<std::size_t> normal_columns(const CornerProperties& properties) {
    std::vector<std::size_t> out;
    std::size_t column = 0;
    for (const PropertyChannel& channel : properties.channels) {
        if (channel.meaning == PropertyMeaning::Normal && channel.width == 3) out.push_back(column);
        column += channel.width;
    }
    return out;
}

/// Newell's sum, which is across a polygon.
Point3d normal_of(const PolygonMesh& mesh, std::size_t face) {
    Point3d out{};
    const auto corners = mesh.face(face);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point3d& a = mesh.points[corners[i]];
        const Point3d& b = mesh.points[corners[(i + 1) % corners.size()]];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t u = (k + 1) % 3;
            const std::size_t v = (k + 2) % 3;
            out[k] += (a[u] - b[u]) * (a[v] + b[v]);
        }
    }
    return out;
}

/// Outward, of faces that were turned over.
void turn_normals_outward(PropertyMesh& made) {
    const std::vector<std::size_t> columns = normal_columns(made.properties);
    for (std::size_t f = 0; f < made.mesh.face_count() && !columns.empty(); ++f) {
        if (!made.is_turned_over[f]) continue;
        const Point3d outward = normal_of(made.mesh, f);
        for (std::size_t c = made.mesh.face_begin[f]; c < made.mesh.face_begin[f + 1]; ++c)
            for (const std::size_t column : columns) {
                double* const n =
                    made.properties.values.data() + c * made.properties.width + column;
                if (n[0] * outward[0] + n[1] * outward[1] + n[2] * outward[2] >= 0) continue;
                for (std::size_t k = 0; k < 3; ++k) n[k] = -n[k];
            }
    }
}

}  // namespace

ModelPart mended_part(const ModelPart& given, MendedMesh&& mended) {
    ModelPart out;
    out.name = given.name;
    if (!given.materials.empty())
        for (const std::uint32_t face : mended.source_of_face)
            out.materials.push_back(face == no_face ? no_material : given.materials[face]);
    if (given.properties.width == 0) {
        out.mesh = std::move(mended.mesh);
        return out;
    }
    const PolygonMesh moved = with_moved_points(given.mesh, mended);
    std::vector<FaceSource> sources;
    sources.reserve(mended.source_of_face.size());
    for (const std::uint32_t face : mended.source_of_face) sources.push_back({0, face});
    PropertyMesh made = with_properties(std::move(mended.mesh), std::move(sources),
                                        std::array{PropertyOperand{0, &moved, &given.properties}});
    turn_normals_outward(made);
    out.mesh = std::move(made.mesh);
    out.properties = std::move(made.properties);
    return out;
}

}  // namespace trisect::app
