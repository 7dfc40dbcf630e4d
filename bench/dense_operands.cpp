// SPDX-License-Identifier: Apache-2.0

#include "dense_operands.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "shapes.h"

namespace bench {

namespace {

using shapes::Matrix;
using trisect::Point3d;
using trisect::PolygonMesh;

/// A sphere of 800 triangles. `bumps`: the largest change of its radius, which is 1.
PolygonMesh globe(double bumps) { return shapes::globe(20, 20, bumps); }

PolygonMesh placed(const PolygonMesh& mesh, Matrix turn, double radius, const Point3d& centre) {
    for (Point3d& row : turn)
        for (double& c : row) c *= radius;
    return shapes::moved(mesh, turn, centre);
}

/// Of radius 1, from -2 to 2, with caps of triangles from the middle.
PolygonMesh cylinder() {
    constexpr std::uint32_t sides = 200;
    PolygonMesh out;
    for (const double z : {-2.0, 2.0})
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            out.points.push_back({std::cos(angle), std::sin(angle), z});
        }
    out.points.push_back({0, 0, -2});
    out.points.push_back({0, 0, 2});
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t j = (i + 1) % sides;
        out.add_triangle(2 * sides, j, i);
        out.add_triangle(2 * sides + 1, sides + i, sides + j);
        out.add_triangle(i, j, sides + j);
        out.add_triangle(i, sides + j, sides + i);
    }
    return out;
}

/// Of radius 1/10, from height -1 up.
PolygonMesh capsule(const Point3d& end) {
    PolygonMesh out = globe(0);
    for (Point3d& p : out.points) {
        if (p[2] > 0) p[2] += 10;
        for (double& c : p) c *= 0.1;
    }
    return shapes::moved(out, end);
}

}  // namespace

std::vector<PolygonMesh> nearly_equal_solids(std::size_t n) {
    const PolygonMesh mesh = globe(0.02);
    shapes::Random random(23);
    std::vector<PolygonMesh> out;
    for (std::size_t i = 0; i < n; ++i) {
        const Matrix turn = random.rotation();
        out.push_back(placed(mesh, turn, 1 + 0.01 * random.uniform(), {}));
    }
    return out;
}

std::vector<PolygonMesh> nested_solids(std::size_t n) {
    const PolygonMesh mesh = globe(0);
    shapes::Random random(23);
    std::vector<PolygonMesh> out;
    for (std::size_t i = 0; i < n; ++i) {
        const Matrix turn = random.rotation();
        const double part = static_cast<double>(i) / static_cast<double>(n);
        out.push_back(placed(mesh, turn, 1 - 0.5 * part, {}));
    }
    return out;
}

std::vector<PolygonMesh> solids_in_one_place(std::size_t n) {
    const PolygonMesh mesh = globe(0.1);
    shapes::Random random(23);
    std::vector<PolygonMesh> out;
    while (out.size() < n) {
        const Matrix turn = random.rotation();
        Point3d centre = random.in_unit_box();
        double square = 0;
        for (double& c : centre) {
            c = (2 * c - 1) / 3;
            square += c * c;
        }
        if (square <= 1.0 / 9) out.push_back(placed(mesh, turn, 1, centre));
    }
    return out;
}

std::vector<PolygonMesh> turned_cylinders(std::size_t n) {
    const PolygonMesh mesh = cylinder();
    shapes::Random random(23);
    std::vector<PolygonMesh> out;
    for (std::size_t i = 0; i < n; ++i) {
        const Matrix turn = random.rotation();
        out.push_back(placed(mesh, turn, 1, {}));
    }
    return out;
}

std::vector<PolygonMesh> plate_and_path(std::size_t n) {
    std::vector<PolygonMesh> out{shapes::block({-2, -2, -0.5}, {2, 2, 0.5}, 10)};
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 0.0137 * static_cast<double>(i);
        const double radius = 1.5 - 0.001 * static_cast<double>(i);
        out.push_back(capsule({radius * std::cos(angle), radius * std::sin(angle), 0}));
    }
    return out;
}

namespace {

/// About an axis along z; coordinates are multiples of 2^-24, so that copies are exact.
PolygonMesh prism(std::uint32_t sides, double radius, const Point3d& foot, double height) {
    PolygonMesh out;
    for (const double z : {foot[2], foot[2] + height})
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            const auto rounded = [](double v) { return std::round(v * 0x1p24) * 0x1p-24; };
            out.points.push_back({foot[0] + rounded(radius * std::cos(angle)),
                                  foot[1] + rounded(radius * std::sin(angle)), z});
        }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t j = (i + 1) % sides;
        if (i + 2 < sides) {
            out.add_triangle(0, i + 2, i + 1);
            out.add_triangle(sides, sides + i + 1, sides + i + 2);
        }
        out.add_triangle(i, j, sides + j);
        out.add_triangle(i, sides + j, sides + i);
    }
    return out;
}

}  // namespace

std::vector<PolygonMesh> copies_along_axis(std::size_t n) {
    PolygonMesh mesh = globe(0.02);
    for (Point3d& p : mesh.points)
        for (double& c : p) c = std::round(c * 0x1p24) * 0x1p-24;
    std::vector<PolygonMesh> out;
    for (std::size_t i = 0; i < n; ++i) {
        out.push_back(mesh);
        for (Point3d& p : mesh.points) p[0] += 0x1p-5;
    }
    return out;
}

std::vector<PolygonMesh> prisms_on_floor(std::size_t n) {
    std::vector<PolygonMesh> out;
    for (std::size_t i = 0; i < n; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(n);
        out.push_back(prism(200, 2 - part, {0, 0, 0}, 1 + part));
    }
    return out;
}

std::vector<PolygonMesh> stacked_prisms(std::size_t n) {
    std::vector<PolygonMesh> out;
    for (std::size_t i = 0; i < n; ++i)
        out.push_back(prism(200, 1, {0, 0, 0.25 * static_cast<double>(i)}, 0.25));
    return out;
}

std::vector<PolygonMesh> plate_and_drills(std::size_t n, bool through) {
    const auto rows = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
    const double reach = 0.5 * static_cast<double>(rows) + 1;
    std::vector<PolygonMesh> out{shapes::block({-1, -1, -0.5}, {reach, reach, 0.5}, 10)};
    for (std::size_t i = 0; i < n; ++i)
        out.push_back(prism(100, 0.1875,
                            {0.5 * static_cast<double>(i % rows) + 0.0625,
                             0.5 * static_cast<double>(i / rows) + 0.0625, through ? -0.5 : 0.0},
                            through ? 1.0 : 0.5));
    return out;
}

std::vector<PolygonMesh> plate_and_slot(std::size_t n) {
    const double reach = 0.0625 * static_cast<double>(n) + 1;
    std::vector<PolygonMesh> out{shapes::block({-1, -1, -0.5}, {reach, 1, 0.5}, 10)};
    for (std::size_t i = 0; i < n; ++i)
        out.push_back(prism(100, 0.5, {0.0625 * static_cast<double>(i), 0.03125, 0}, 0.5));
    return out;
}

}  // namespace bench
