// SPDX-License-Identifier: Apache-2.0

#include "mesh_input.h"

#include <array>
#include <cstring>
#include <limits>
#include <string>

#include "call.h"

namespace trisect::c {

namespace {

constexpr std::size_t corner_limit = std::numeric_limits<std::uint32_t>::max();

void set_points(const double* vertices, std::size_t count, PolygonMesh& mesh) {
    if (count > corner_limit) throw LimitError("vertex_count: more than 2^32 - 1 vertices");
    (void)array_of(vertices, count, "vertices");
    mesh.points.resize(count);
    if (count != 0) std::memcpy(mesh.points.data(), vertices, count * sizeof(Point3d));
}

}  // namespace

TriangleView view_of(const double* vertices, std::size_t vertex_count, const std::uint32_t* faces,
                     std::size_t face_count) {
    if (face_count > corner_limit / 3)
        throw LimitError("face_count: more than 2^32 - 1 corners of faces");
    if (vertex_count > corner_limit) throw LimitError("vertex_count: more than 2^32 - 1 vertices");
    (void)array_of(vertices, vertex_count, "vertices");
    (void)array_of(faces, face_count, "faces");
    using Triangle = std::array<std::uint32_t, 3>;
    return {{reinterpret_cast<const Point3d*>(vertices), vertex_count},
            {reinterpret_cast<const Triangle*>(faces), face_count}};
}

PolygonMesh triangles_of(const double* vertices, std::size_t vertex_count,
                         const std::uint32_t* faces, std::size_t face_count) {
    const TriangleView view = view_of(vertices, vertex_count, faces, face_count);
    PolygonMesh mesh;
    mesh.points.assign(view.points.begin(), view.points.end());
    mesh.corners.reserve(3 * face_count);
    mesh.face_begin.reserve(face_count + 1);
    for (const auto& t : view.triangles) mesh.add_triangle(t[0], t[1], t[2]);
    return mesh;
}

PolygonMesh polygons_of(const double* vertices, std::size_t vertex_count,
                        const std::uint32_t* corners, const std::uint32_t* face_begin,
                        std::size_t face_count) {
    if (face_count > corner_limit) throw LimitError("face_count: more than 2^32 - 1 faces");
    PolygonMesh mesh;
    set_points(vertices, vertex_count, mesh);
    const auto begin = array_of(face_begin, face_count + 1, "face_begin");
    if (begin[0] != 0) throw UsageError("face_begin: the first entry must be 0");
    for (std::size_t f = 0; f < face_count; ++f)
        if (begin[f + 1] < begin[f])
            throw UsageError("face_begin: entry " + std::to_string(f + 1) +
                             " is less than the one before it");
    mesh.face_begin.assign(begin.begin(), begin.end());
    const auto all = array_of(corners, begin.back(), "corners");
    mesh.corners.assign(all.begin(), all.end());
    return mesh;
}

SolidOptions options_of(const trisect_solid_options* options) {
    SolidOptions own;
    own.import.threads = limits_of_thread().threads;
    if (options == nullptr) return own;
    if (options->size != sizeof(trisect_solid_options))
        throw UsageError("options: size must be sizeof(trisect_solid_options)");
    switch (static_cast<int>(options->embedding)) {
        case TRISECT_EMBEDDING_ASSUME:
            own.embedding = Embedding::Assume;
            break;
        case TRISECT_EMBEDDING_RESOLVE:
            own.embedding = Embedding::Resolve;
            break;
        case TRISECT_EMBEDDING_CHECK:
            own.embedding = Embedding::Check;
            break;
        default:
            throw UsageError("options: embedding is none of trisect_embedding");
    }
    own.inside_out = options->accept_inside_out != 0 ? InsideOut::Accept : InsideOut::Refuse;
    return own;
}

}  // namespace trisect::c
