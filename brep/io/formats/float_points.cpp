// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/formats/float_points.h>

#include <trisect/brep/io/formats/vertex_welder.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trisect::detail {
namespace {

/// Number of distinct points; `point(i)` is the i-th of n.
template <class PointAt>
std::size_t distinct(std::size_t n, const PointAt& point) {
    std::vector<Point3d> seen;
    seen.reserve(n);
    VertexWelder welder(seen, n);
    std::array<Point3d, VertexWelder::block> points;
    std::array<std::uint32_t, VertexWelder::block> numbers;
    for (std::size_t begin = 0; begin < n; begin += points.size()) {
        const std::size_t count = std::min(points.size(), n - begin);
        for (std::size_t i = 0; i < count; ++i) points[i] = point(begin + i);
        welder.vertices({points.data(), count}, numbers.data());
    }
    return seen.size();
}

Point3d as_doubles(const FloatPoint& p) noexcept {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace

std::vector<FloatPoint> float_points(const PolygonMesh& mesh, const std::string& name,
                                     const char* format, WriteReport& report) {
    std::vector<FloatPoint> points(mesh.points.size());
    std::size_t moved = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
        double move = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double c = mesh.points[v][k];
            // A double that rounds beyond the largest float must not be converted at all.
            if (std::fabs(c) > static_cast<double>(std::numeric_limits<float>::max())) {
                throw LimitError(name + ": cannot write: vertex " + std::to_string(v) +
                                 " has a coordinate beyond the range of " + format + " (floats)");
            }
            points[v][k] = static_cast<float>(c);
            move = std::max(move, std::fabs(static_cast<double>(points[v][k]) - c));
        }
        if (move > 0) ++moved;
        report.largest_move = std::max(report.largest_move, move);
    }
    report.rounded_vertices += moved;
    if (moved != 0) {
        report.lossless = false;
        const std::size_t n = points.size();
        report.merged_vertices += distinct(n, [&](std::size_t v) { return mesh.points[v]; }) -
                                  distinct(n, [&](std::size_t v) { return as_doubles(points[v]); });
    }
    return points;
}

}  // namespace trisect::detail
