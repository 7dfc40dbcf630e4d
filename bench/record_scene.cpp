// SPDX-License-Identifier: Apache-2.0

#include "record_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "shapes.h"

namespace bench {

namespace {

using shapes::Matrix;
using trisect::Point3d;
using trisect::PolygonMesh;

// In how many spheres a point lies on average.
constexpr double sphere_depth = 0.5;
// From one statue to the next one; each is as long as 1 along its longest axis.
constexpr double statue_pitch = 0.75;

struct Extent {
    Point3d low;
    Point3d high;
};

Extent extent_of(const std::vector<PolygonMesh>& meshes) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Extent out{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const PolygonMesh& mesh : meshes)
        for (const Point3d& p : mesh.points)
            for (std::size_t k = 0; k < 3; ++k) {
                out.low[k] = std::min(out.low[k], p[k]);
                out.high[k] = std::max(out.high[k], p[k]);
            }
    return out;
}

/// The model, of length 1 about the origin, turned and moved.
PolygonMesh statue(const PolygonMesh& model, double degrees, const Point3d& at) {
    const Extent box = extent_of({model});
    double length = 0;
    Point3d to_origin{};
    for (std::size_t k = 0; k < 3; ++k) {
        length = std::max(length, box.high[k] - box.low[k]);
        to_origin[k] = -0.5 * (box.low[k] + box.high[k]);
    }
    Matrix m = shapes::rotation({0.1, 1, 0.2}, degrees);
    for (Point3d& row : m)
        for (double& c : row) c /= length;
    return shapes::moved(shapes::moved(model, to_origin), m, at);
}

}  // namespace

std::vector<PolygonMesh> statues_and_spheres(const std::vector<PolygonMesh>& models,
                                             std::size_t n) {
    std::vector<PolygonMesh> out;
    out.reserve(statues_of_record + n);
    for (std::size_t i = 0; i < statues_of_record; ++i) {
        const auto column = static_cast<double>(i % 3);
        const auto row = static_cast<double>(i / 3);
        out.push_back(statue(models[i % 3], 20 + 67.0 * static_cast<double>(i),
                             {statue_pitch * column, 0.013 * column, statue_pitch * row}));
    }
    const Extent box = extent_of(out);
    double volume = 1;
    for (std::size_t k = 0; k < 3; ++k) volume *= box.high[k] - box.low[k];
    const double radius =
        std::cbrt(sphere_depth * volume / static_cast<double>(n) * 0.75 / std::numbers::pi);
    const PolygonMesh ball = shapes::globe(13, 9);
    shapes::Random random(1706);
    for (std::size_t i = 0; i < n; ++i) {
        Matrix m = random.rotation();
        for (Point3d& line : m)
            for (double& c : line) c *= radius;
        Point3d centre = random.in_unit_box();
        for (std::size_t k = 0; k < 3; ++k)
            centre[k] = box.low[k] + centre[k] * (box.high[k] - box.low[k]);
        out.push_back(shapes::moved(ball, m, centre));
    }
    return out;
}

}  // namespace bench
