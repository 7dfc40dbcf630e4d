// SPDX-License-Identifier: Apache-2.0
//
// Meshes with defects that were put into them, and what they were before.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/mend/mend.h>
#include <trisect/brep/validate/validate.h>

#include "support/mesh_builders.h"

namespace trisect::test {

inline void turn(PolygonMesh& mesh, std::size_t face) {
    std::reverse(mesh.corners.begin() + mesh.face_begin[face],
                 mesh.corners.begin() + mesh.face_begin[face + 1]);
}

/// The signed volume below the faces; the boundary may be open.
inline ExactRational volume_below(const PolygonMesh& mesh) {
    ImportOptions options;
    options.require_closed = false;
    return exact_volume(import_mesh(mesh, options).mesh);
}

/// Faces with more than three corners as fans.
inline PolygonMesh in_triangles(const PolygonMesh& mesh) {
    PolygonMesh out;
    out.points = mesh.points;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::size_t i = 2; i < mesh.face(f).size(); ++i)
            out.add_triangle(mesh.face(f)[0], mesh.face(f)[i - 1], mesh.face(f)[i]);
    return out;
}

/// Faces whose first corner is below z = 0 and others get vertices of their own, each moved by up
/// to `jitter` along each axis.
inline PolygonMesh cut_apart(const PolygonMesh& mesh, double jitter, unsigned seed) {
    PolygonMesh out;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> move(-jitter, jitter);
    std::map<std::pair<bool, std::uint32_t>, std::uint32_t> copies;
    std::vector<std::array<bool, 2>> sides(mesh.points.size());
    const auto is_below = [&](std::size_t f) { return mesh.points[mesh.face(f)[0]][2] < 0; };
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (const std::uint32_t c : mesh.face(f)) sides[c][is_below(f) ? 0 : 1] = true;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::vector<std::uint32_t> loop;
        for (const std::uint32_t c : mesh.face(f)) {
            const bool on_seam = sides[c][0] && sides[c][1];
            const auto [it, is_new] = copies.try_emplace(
                {on_seam && is_below(f), c}, static_cast<std::uint32_t>(out.points.size()));
            if (is_new) {
                Point3d p = mesh.points[c];
                if (on_seam)
                    for (double& x : p) x += move(random);
                out.points.push_back(p);
            }
            loop.push_back(it->second);
        }
        out.add_face(loop);
    }
    return out;
}

inline std::string findings(const PolygonMesh& mesh) { return validate(mesh).to_string(); }

}  // namespace trisect::test
