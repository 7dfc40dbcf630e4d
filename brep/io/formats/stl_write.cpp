// SPDX-License-Identifier: Apache-2.0
//
// Writing STL. ASCII holds doubles in full. Binary holds floats: rounding a vertex may move it and
// may even make two vertices one, so both are counted and reported instead of happening in silence.
//
// The normal is the direction of the cross product in double, as a courtesy to viewers; a triangle
// without area, or one whose products overflow, gets 0 0 0, which the format allows.
#include <trisect/brep/io/formats/binary.h>
#include <trisect/brep/io/formats/float_points.h>
#include <trisect/brep/io/formats/formats.h>
#include <trisect/brep/io/formats/number_text.h>
#include <trisect/kernel/number/vector3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace trisect::detail {
namespace {

/// `v` largest_made_1 so that its largest component has magnitude 1; zero when that is impossible.
Point3d largest_made_1(const Point3d& v) noexcept {
    const double m = largest_component(v);
    if (!std::isfinite(m) || m == 0) return {0, 0, 0};
    return {v[0] / m, v[1] / m, v[2] / m};
}

std::array<float, 3> unit_normal(const Point3d& a, const Point3d& b, const Point3d& c) noexcept {
    const Point3d u = largest_made_1(minus(b, a));
    const Point3d v = largest_made_1(minus(c, a));
    const Point3d n = largest_made_1(
        {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]});
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(length > 0)) return {0, 0, 0};
    return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
            static_cast<float>(n[2] / length)};
}

std::array<float, 3> stl_normal(const PolygonMesh& mesh, std::size_t f) noexcept {
    const auto loop = mesh.face(f);
    return unit_normal(mesh.points[loop[0]], mesh.points[loop[1]], mesh.points[loop[2]]);
}

}  // namespace

void write_stl_ascii(std::string& out, const PolygonMesh& mesh) {
    out.reserve(420 * mesh.face_count() + 64);  // what is not used is never touched
    TextWriter text(out);
    text << "solid trisect\n";
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        text << "facet normal";
        for (const float c : stl_normal(mesh, f)) text << ' ' << c;
        text << "\n  outer loop\n";
        for (const std::uint32_t corner : mesh.face(f))
            text << "    vertex " << mesh.points[corner] << '\n';
        text << "  endloop\nendfacet\n";
    }
    text << "endsolid trisect\n";
    text.finish();
}

WriteReport write_stl_binary(std::string& out, const PolygonMesh& mesh, const std::string& name) {
    if (mesh.face_count() > std::numeric_limits<std::uint32_t>::max()) {
        throw LimitError(name + ": cannot write: more faces than binary STL can count");
    }
    WriteReport report;
    const std::vector<FloatPoint> points = float_points(mesh, name, "binary STL", report);
    out.reserve(stl_header_size + mesh.face_count() * stl_record_size);
    out += "binary STL by Trisect";  // must not begin with "solid"
    out.resize(80, '\0');
    store(out, static_cast<std::uint32_t>(mesh.face_count()), false);
    out.resize(stl_header_size + mesh.face_count() * stl_record_size);
    char* to = out.data() + stl_header_size;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        for (const float c : stl_normal(mesh, f)) put<false>(to, c);
        for (const std::uint32_t corner : mesh.face(f))
            for (const float c : points[corner]) put<false>(to, c);
        put<false>(to, std::uint16_t{0});
    }
    return report;
}

}  // namespace trisect::detail
