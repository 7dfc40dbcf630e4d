// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/import/prepared_mesh.h>

#include <algorithm>
#include <string>
#include <utility>

#include <trisect/brep/face/loop_triangulator.h>
#include <trisect/brep/import/edge_table.h>
#include <trisect/brep/import/weld_points.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

// Copies a loop without equal neighbours, first and last included.
void copy_distinct(std::span<const std::uint32_t> loop, std::vector<std::uint32_t>& out) {
    out.clear();
    for (const std::uint32_t c : loop)
        if (out.empty() || out.back() != c) out.push_back(c);
    while (out.size() > 1 && out.front() == out.back()) out.pop_back();
}

}  // namespace

void check_indices(const PolygonMesh& mesh) {
    if (mesh.face_begin.empty() || mesh.face_begin.front() != 0 ||
        mesh.face_begin.back() != mesh.corners.size())
        throw UsageError("polygon mesh: face_begin does not span the corners");
    if (mesh.face_count() >= (std::size_t{1} << 31))
        throw LimitError("polygon mesh: more than 2^31 faces");
    const std::size_t n = mesh.points.size();
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face_begin[f] > mesh.face_begin[f + 1] ||
            mesh.face_begin[f + 1] > mesh.corners.size())
            throw UsageError("polygon mesh: face " + std::to_string(f) + " has a negative size");
        for (const std::uint32_t c : mesh.face(f))
            if (c >= n)
                throw UsageError("polygon mesh: face " + std::to_string(f) + " names point " +
                                 std::to_string(c) + " of " + std::to_string(n));
    }
}

PreparedMesh weld_mesh(const PolygonMesh& mesh, std::span<const LatticePoint> lattice_points) {
    WeldedPoints welded = weld_points(lattice_points);
    PreparedMesh out;
    out.welded_points = lattice_points.size() - welded.points.size();
    out.points = std::move(welded.points);
    out.source_point = std::move(welded.first);
    out.loop_begin = mesh.face_begin;
    out.corners.resize(mesh.corners.size());
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
        out.corners[i] = welded.id[mesh.corners[i]];
    return out;
}

void triangulate_faces(PreparedMesh& mesh) {
    LoopTriangulator triangulator(mesh.points);
    std::vector<std::uint32_t> loop;
    mesh.triangles.reserve(mesh.corners.size() -
                           std::min(mesh.corners.size(), 2 * mesh.face_count()));
    mesh.face_of_triangle.reserve(mesh.triangles.capacity());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        check_stop();
        const auto whole = mesh.loop(f);
        if (whole.size() == 3) {
            if (are_collinear(mesh.points[whole[0]], mesh.points[whole[1]],
                              mesh.points[whole[2]])) {
                mesh.degenerate_faces.push_back(f);
            } else {
                mesh.triangles.push_back({whole[0], whole[1], whole[2]});
                mesh.face_of_triangle.push_back(f);
            }
            continue;
        }
        copy_distinct(whole, loop);
        LoopShape shape;
        shape.degenerate = loop.size() < 3;
        if (!shape.degenerate) shape = triangulator.triangulate(loop, mesh.triangles);
        mesh.face_of_triangle.resize(mesh.triangles.size(), f);
        if (shape.degenerate) mesh.degenerate_faces.push_back(f);
        if (!shape.planar) mesh.nonplanar_faces.push_back(f);
        if (!shape.simple) mesh.nonsimple_faces.push_back(f);
    }
}

std::vector<NetEdge> find_net_edges(std::size_t point_count,
                                    std::span<const std::uint32_t> loop_begin,
                                    std::span<const std::uint32_t> corners) {
    std::vector<NetEdge> out;
    const EdgeTable table(point_count, loop_begin, corners);
    table.for_each_edge([&](std::uint32_t low, std::uint32_t high, std::span<const EdgeUse> uses) {
        std::int64_t net = 0;
        for (const EdgeUse& u : uses) net += u.is_forward() ? 1 : -1;
        if (net > 0) out.push_back({low, high, net});
        if (net < 0) out.push_back({high, low, -net});
    });
    return out;
}

std::size_t count_net_edges(std::size_t point_count,
                            std::span<const std::array<std::uint32_t, 3>> triangles) {
    if (triangles.empty()) return 0;
    std::vector<std::uint32_t> begin(triangles.size() + 1);
    for (std::size_t i = 0; i < begin.size(); ++i) begin[i] = static_cast<std::uint32_t>(3 * i);
    return find_net_edges(point_count, begin, {triangles.front().data(), 3 * triangles.size()})
        .size();
}

}  // namespace trisect::detail
