// SPDX-License-Identifier: Apache-2.0
//
// Small meshes written by hand for the tests of import and validation.
#pragma once

#include <initializer_list>
#include <utility>
#include <vector>

#include <trisect/brep/polygon_mesh.h>

namespace trisect::test {

inline PolygonMesh make_mesh(std::vector<Point3d> points,
                             std::initializer_list<std::vector<std::uint32_t>> faces) {
    PolygonMesh m;
    m.points = std::move(points);
    for (const auto& f : faces) m.add_face(f);
    return m;
}

/// Six quadrilaterals, outward; corner i has x = bit 0, y = bit 1, z = bit 2 of i.
inline PolygonMesh cuboid(Point3d low = {0, 0, 0}, Point3d high = {1, 1, 1}) {
    PolygonMesh m;
    for (unsigned i = 0; i < 8; ++i)
        m.points.push_back({(i & 1U) != 0 ? high[0] : low[0], (i & 2U) != 0 ? high[1] : low[1],
                            (i & 4U) != 0 ? high[2] : low[2]});
    for (const auto& f : std::vector<std::vector<std::uint32_t>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
        m.add_face(f);
    return m;
}

inline PolygonMesh flipped(const PolygonMesh& in) {
    PolygonMesh m;
    m.points = in.points;
    for (std::size_t f = 0; f < in.face_count(); ++f) {
        const auto loop = in.face(f);
        m.add_face(std::vector<std::uint32_t>(loop.rbegin(), loop.rend()));
    }
    return m;
}

/// Both meshes side by side, without welding.
inline PolygonMesh together(PolygonMesh a, const PolygonMesh& b) {
    const auto offset = static_cast<std::uint32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        std::vector<std::uint32_t> loop;
        for (const std::uint32_t c : b.face(f)) loop.push_back(c + offset);
        a.add_face(loop);
    }
    return a;
}

/// Without face f.
inline PolygonMesh without_face(const PolygonMesh& in, std::size_t f) {
    PolygonMesh m;
    m.points = in.points;
    for (std::size_t i = 0; i < in.face_count(); ++i)
        if (i != f) m.add_face(in.face(i));
    return m;
}

}  // namespace trisect::test
