// SPDX-License-Identifier: Apache-2.0
//
// A chain of maps applied in doubles rounds at every product, and nobody knows how much. Here the
// maps are multiplied as fractions and each coordinate is rounded once, so the report is exact and
// a map that doubles can express, such as a quarter turn or a translation on the file's own grid,
// changes nothing but what it should.
#include "exact_map.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "matrix_file.h"

namespace trisect::app {
namespace {

struct Turn {
    double cosine;
    double sine;
};

Turn turn_of(double degrees) {
    const double rest = std::fmod(degrees, 360.0);
    const double quarters = rest / 90.0;
    if (quarters == std::floor(quarters)) {
        static constexpr Turn turns[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
        return turns[(static_cast<int>(quarters) + 4) % 4];
    }
    const double radians = rest * (std::numbers::pi / 180.0);
    return {std::cos(radians), std::sin(radians)};
}

void turn_faces_over(PolygonMesh& mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto begin = mesh.corners.begin();
        // The first corner stays the first one.
        std::reverse(begin + mesh.face_begin[f] + (mesh.face(f).empty() ? 0 : 1),
                     begin + mesh.face_begin[f + 1]);
    }
}

/// Corners of faces in the order that turn_faces_over() gives them.
void turn_corners_over(const PolygonMesh& mesh, CornerProperties& properties) {
    const std::size_t width = properties.width;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::size_t first = mesh.face_begin[f] + 1;
        std::size_t last = mesh.face_begin[f + 1];
        for (; first + 1 < last; ++first) {
            --last;
            std::swap_ranges(properties.values.data() + first * width,
                             properties.values.data() + (first + 1) * width,
                             properties.values.data() + last * width);
        }
    }
}

using Rows3 = std::array<std::array<double, 3>, 3>;

/// What normals are multiplied by: the cofactors of the matrix, with the sign of its determinant.
/// Entries are brought to 1 at most before, so that no product leaves the range of doubles.
Rows3 map_of_normals(const std::array<double, 12>& rows, int orientation) {
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) most = std::max(most, std::abs(rows[4 * i + j]));
    const auto entry = [&](std::size_t i, std::size_t j) {
        return rows[4 * (i % 3) + j % 3] / most;
    };
    Rows3 out{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            out[i][j] = orientation * (entry(i + 1, j + 1) * entry(i + 2, j + 2) -
                                       entry(i + 1, j + 2) * entry(i + 2, j + 1));
    return out;
}

void map_normal(const Rows3& map, double* normal) {
    std::array<double, 3> image{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) image[i] += map[i][j] * normal[j];
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    const double now = std::hypot(image[0], image[1], image[2]);
    if (!(now > 0)) return;  // absent, or none
    for (std::size_t i = 0; i < 3; ++i) normal[i] = image[i] / now * length;
}

void map_normals(const Rows3& map, CornerProperties& properties) {
    std::size_t column = 0;
    for (const PropertyChannel& channel : properties.channels) {
        const bool is_normal = channel.meaning == PropertyMeaning::Normal && channel.width == 3;
        for (std::size_t i = column; is_normal && i < properties.values.size();
             i += properties.width)
            map_normal(map, properties.values.data() + i);
        column += channel.width;
    }
}

}  // namespace

ExactMap ExactMap::from_rows(const std::array<double, 12>& rows) {
    return detail::ExactAffine::from_rows(rows);
}

ExactMap ExactMap::from_file(const std::string& path) { return from_rows(read_matrix(path)); }

ExactMap ExactMap::translation(const std::array<double, 3>& vector) {
    return from_rows({1, 0, 0, vector[0], 0, 1, 0, vector[1], 0, 0, 1, vector[2]});
}

ExactMap ExactMap::scaling(double factor) {
    return from_rows({factor, 0, 0, 0, 0, factor, 0, 0, 0, 0, factor, 0});
}

ExactMap ExactMap::rotation(const std::array<double, 4>& axis_and_degrees) {
    const auto [x, y, z, degrees] = axis_and_degrees;
    const double most = std::max({std::abs(x), std::abs(y), std::abs(z)});
    if (most == 0) throw UsageError("--rotate: the axis has no length");
    const double length = std::hypot(x / most, y / most, z / most);
    const std::array<double, 3> k{x / most / length, y / most / length, z / most / length};
    const auto [c, s] = turn_of(degrees);
    // Rodrigues' formula: c I + (1 - c) k k^T + s [k]. Every term is exact for a quarter turn about
    // a coordinate axis.
    std::array<double, 12> rows{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) rows[4 * i + j] = (1 - c) * k[i] * k[j];
        rows[5 * i] += c;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t u = (i + 1) % 3;
        const std::size_t v = (i + 2) % 3;
        rows[4 * v + u] += s * k[i];
        rows[4 * u + v] -= s * k[i];
    }
    return from_rows(rows);
}

RoundingReport ExactMap::apply(PolygonMesh& mesh) const {
    if (is_identity()) return {};
    const int sign = orientation();
    if (sign == 0) throw UsageError("the transform makes space flat");
    RoundingReport report;
    for (Point3d& point : mesh.points) {
        const detail::ExactAffine::Image image = map_.apply(point);
        point = image.point;
        report.moved += image.move > 0 ? 1U : 0U;
        report.max_move = std::max(report.max_move, image.move);
    }
    if (sign < 0) turn_faces_over(mesh);
    return report;
}

RoundingReport ExactMap::apply(ModelPart& part) const {
    const RoundingReport report = apply(part.mesh);
    if (is_identity() || part.properties.width == 0) return report;
    if (orientation() < 0) turn_corners_over(part.mesh, part.properties);
    map_normals(map_of_normals(rows(), orientation()), part.properties);
    return report;
}

}  // namespace trisect::app
