// SPDX-License-Identifier: Apache-2.0

#include "cliff_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <utility>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/primitives/cone.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/brep/primitives/prism.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/kernel/error.h>

#include "shapes.h"

namespace bench {

namespace {

using shapes::Matrix;
using trisect::Point3d;
using trisect::PolygonMesh;

constexpr double pi = std::numbers::pi;

[[noreturn]] void unknown_cliff(const std::vector<std::string>& words) {
    std::string name;
    for (const std::string& w : words) name += (name.empty() ? "" : ":") + w;
    throw trisect::UsageError("no such scene: " + name);
}

// Also where faces are not convex.
PolygonMesh in_triangles(const PolygonMesh& mesh) {
    const trisect::ImportedMesh imported = trisect::import_mesh(mesh);
    PolygonMesh out;
    const double unit = std::ldexp(1.0, imported.mesh.lattice.exponent);
    for (const trisect::LatticePoint& p : imported.mesh.points) {
        const Point3d c = p.doubles();
        out.points.push_back({c[0] * unit, c[1] * unit, c[2] * unit});
    }
    for (const auto& t : imported.mesh.triangles) out.add_triangle(t[0], t[1], t[2]);
    return out;
}

PolygonMesh scaled(PolygonMesh mesh, const Point3d& by) {
    for (Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] *= by[k];
    return mesh;
}

struct Box {
    Point3d lo{};
    Point3d hi{};
};

Box box_of(const PolygonMesh& mesh) {
    Box b{mesh.points.front(), mesh.points.front()};
    for (const Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) {
            b.lo[k] = std::min(b.lo[k], p[k]);
            b.hi[k] = std::max(b.hi[k], p[k]);
        }
    return b;
}

// Rounded to multiples of 2^-20, so that sums of a few are exact.
double rounded(double v) { return std::ldexp(std::round(std::ldexp(v, 20)), -20); }

PolygonMesh rounded(PolygonMesh mesh) {
    for (Point3d& p : mesh.points)
        for (double& c : p) c = rounded(c);
    return mesh;
}

PolygonMesh spikes(int level) {
    PolygonMesh m = shapes::icosphere(level);
    for (std::size_t i = 0; i < m.points.size(); ++i)
        if (i % 7 == 0)
            for (double& c : m.points[i]) c *= 1.5;
    return m;
}

PolygonMesh rough(int n) {
    PolygonMesh m = shapes::block({-1, -1, -1}, {1, 1, 1}, n);
    for (Point3d& p : m.points) {
        const double r = 0.05 * std::sin(17 * p[0] + 5 * p[2]) * std::cos(13 * p[1]);
        for (double& c : p) c *= 1 + r;
    }
    return m;
}

// A block whose upper side is a field of heights.
PolygonMesh terrain(int n) {
    PolygonMesh m = shapes::block({-1, -1, -1}, {1, 1, 0}, n);
    for (Point3d& p : m.points)
        if (p[2] == 0) p[2] = 0.3 + 0.2 * std::sin(5 * p[0]) * std::cos(7 * p[1]);
    return m;
}

trisect::Outline star_outline(int corners) {
    trisect::Outline out;
    for (int i = 0; i < corners; ++i) {
        const double r = i % 2 == 0 ? 1 : 0.8;
        out.push_back({r * std::cos(2 * pi * i / corners), r * std::sin(2 * pi * i / corners)});
    }
    return out;
}

// Teeth along one side: long triangles in the back.
trisect::Outline comb_outline(int corners) {
    trisect::Outline out{{-1, -1}, {1, -1}};
    const int teeth = std::max(1, corners / 4);
    for (int i = teeth; i > 0; --i) {
        const double x = -1 + 2.0 * i / teeth;
        const double w = 1.0 / teeth;
        out.push_back({x, 1});
        out.push_back({x - w, 1});
        if (i > 1) {
            out.push_back({x - w, 0});
            out.push_back({x - 2 * w, 0});
        }
    }
    out.push_back({-1, 1});
    return out;
}

int level_of(int triangles) {
    return std::max(0, static_cast<int>(std::lround(std::log2(triangles / 20.0) / 2)));
}

PolygonMesh model_of(const std::string& path) {
    const char* models = std::getenv("TRISECT_MODELS");
    PolygonMesh m = in_triangles(trisect::read_mesh(
        std::filesystem::path(models == nullptr ? "../shared/models" : models) / path));
    const Box b = box_of(m);
    const double extent = std::max({b.hi[0] - b.lo[0], b.hi[1] - b.lo[1], b.hi[2] - b.lo[2]});
    for (Point3d& p : m.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] = (p[k] - 0.5 * (b.lo[k] + b.hi[k])) * 2 / extent;
    return m;
}

// Within about [-1, 1]^3.
PolygonMesh shape_of(const std::string& name, int triangles,
                     const std::vector<std::string>& words) {
    const int square = std::max(1, static_cast<int>(std::lround(std::sqrt(triangles / 12.0))));
    const auto count = static_cast<std::uint32_t>(std::max(3, triangles / 4));
    if (name == "sphere") return shapes::icosphere(level_of(triangles));
    if (name == "spikes") return spikes(level_of(triangles));
    if (name == "globe") {
        const auto n = static_cast<std::uint32_t>(std::max(4.0, std::sqrt(triangles)));
        return trisect::make_uv_sphere(1, n, n / 2);
    }
    if (name == "torus") {
        const auto n = static_cast<std::uint32_t>(std::max(3.0, std::sqrt(triangles / 4.0)));
        return trisect::make_torus(0.7, 0.3, 2 * n, n);
    }
    if (name == "cylinder") return trisect::make_cylinder(1, 2, count);
    if (name == "needle") return scaled(trisect::make_cylinder(1, 2, count), {0.02, 0.02, 1});
    if (name == "cone") return trisect::make_cone(1, 0, 2, 2 * count);
    if (name == "prism") return trisect::make_regular_prism(count, 1, 2);
    if (name == "star")
        return trisect::make_prism(star_outline(2 * static_cast<int>(count / 2) + 2), 2);
    if (name == "comb") return trisect::make_prism(comb_outline(static_cast<int>(count)), 2);
    if (name == "block") return shapes::block({-1, -1, -1}, {1, 1, 1}, square);
    if (name == "rough") return rough(square);
    if (name == "disc") return scaled(shapes::icosphere(level_of(triangles)), {1, 1, 0.01});
    if (name == "rod") return scaled(shapes::icosphere(level_of(triangles)), {0.02, 0.02, 1});
    if (name == "plate") return scaled(rough(square), {1, 1, 0.02});
    if (name == "terrain") return terrain(square);
    if (name.find('/') != std::string::npos) return model_of(name);
    unknown_cliff(words);
}

// Rounded before it is cut into triangles: afterwards thin ones could turn over.
PolygonMesh operand_of(const std::string& name, int triangles,
                       const std::vector<std::string>& words) {
    PolygonMesh mesh = in_triangles(rounded(shape_of(name, triangles, words)));
    if (!trisect::is_embedded(trisect::import_mesh(mesh).mesh))
        throw trisect::UsageError("it meets itself: " + name);
    return mesh;
}

// Exact: axes go to axes.
PolygonMesh quarter_turned(PolygonMesh mesh, int quarters) {
    for (Point3d& p : mesh.points)
        for (int i = 0; i < quarters; ++i) p = {-p[1], p[0], p[2]};
    return mesh;
}

PolygonMesh mirrored(PolygonMesh mesh) {
    for (Point3d& p : mesh.points) p[0] = -p[0];
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const std::size_t first = 3 * f;
        std::swap(mesh.corners[first + 1], mesh.corners[first + 2]);
    }
    return mesh;
}

PolygonMesh placed(const PolygonMesh& mesh, const std::string& placement,
                   const std::vector<std::string>& words) {
    const Box b = box_of(mesh);
    const Point3d size{b.hi[0] - b.lo[0], b.hi[1] - b.lo[1], b.hi[2] - b.lo[2]};
    const auto by = [&](double x, double y, double z) {
        return shapes::moved(mesh,
                             {rounded(x * size[0]), rounded(y * size[1]), rounded(z * size[2])});
    };
    const auto to_surface = [&](double scale) {
        // Its middle on a point of the surface.
        PolygonMesh m = scaled(shapes::moved(mesh, shapes::rotation({1, 2, 3}, 37), {0, 0, 0}),
                               {scale, scale, scale});
        return shapes::moved(std::move(m), mesh.points[mesh.points.size() / 3]);
    };
    if (placement == "general") return by(0.07, 0.13, 0.21);
    if (placement == "axis") return by(0.25, 0, 0);
    if (placement == "self") return mesh;
    if (placement == "ulp") {
        PolygonMesh m = mesh;
        for (Point3d& p : m.points) p[2] = std::nextafter(p[2], 1e9);
        return m;
    }
    if (placement == "mirror") return mirrored(mesh);
    if (placement == "turn90") return quarter_turned(mesh, 1);
    if (placement == "turn180") return quarter_turned(mesh, 2);
    if (placement == "turned") return shapes::turned(mesh);
    if (placement == "turnedself")
        return shapes::moved(mesh, shapes::rotation({1, 2, 3}, 1.5), {0, 0, 0});
    if (placement == "small") return to_surface(0.1);
    if (placement == "tiny") return to_surface(0.001);
    if (placement == "flush") return by(0, 0, 1);
    if (placement == "edge") return by(0, 1, 1);
    if (placement == "corner") return by(1, 1, 1);
    if (placement == "inside") return scaled(mesh, {0.5, 0.5, 0.5});
    if (placement == "apart") return by(1.5, 0.2, 0.3);
    unknown_cliff(words);
}

Scene pair_scene(const std::vector<std::string>& words) {
    Scene s;
    const PolygonMesh a = operand_of(words[1], std::atoi(words[2].c_str()), words);
    s.operands = {a, placed(a, words[3], words)};
    s.operations = {Operation::Union, Operation::Intersection, Operation::Difference,
                    Operation::ExclusiveOr};
    return s;
}

PolygonMesh member(const std::string& group, const PolygonMesh& shape, int i, int n,
                   shapes::Random& random, const std::vector<std::string>& words) {
    const double x = static_cast<double>(i);
    const int side = static_cast<int>(std::ceil(std::cbrt(n)));
    const Point3d at_grid{static_cast<double>(i % side), static_cast<double>(i / side % side),
                          static_cast<double>(i / side / side)};
    const auto turned_at = [&](const Point3d& at) {
        return shapes::moved(shape, random.rotation(), at);
    };
    if (group == "swarm") {
        const Point3d p = random.in_unit_box();
        return turned_at({0.1 * p[0], 0.1 * p[1], 0.1 * p[2]});
    }
    if (group == "onion") {
        const double scale = 1 - 0.9 * x / n;
        return scaled(shape, {scale, scale, scale});
    }
    if (group == "row") return turned_at({1.3 * x, 0.1 * random.uniform(), 0});
    if (group == "ring")
        return shapes::moved(shape, shapes::rotation({1, 1, 1}, 90 * x / n), {0, 0, 0});
    if (group == "grid")
        return shapes::moved(shape, {3 * at_grid[0], 3 * at_grid[1], 3 * at_grid[2]});
    if (group == "tiles") {
        const Box b = box_of(shape);
        return shapes::moved(shape, {rounded(b.hi[0] - b.lo[0]) * at_grid[0],
                                     rounded(b.hi[1] - b.lo[1]) * at_grid[1],
                                     rounded(b.hi[2] - b.lo[2]) * at_grid[2]});
    }
    if (group == "cloud" || group == "tools") {
        const double room = 2 * std::cbrt(n);
        const Point3d p = random.in_unit_box();
        return turned_at({room * p[0], room * p[1], room * p[2]});
    }
    unknown_cliff(words);
}

Scene group_scene(const std::vector<std::string>& words) {
    const int n = std::atoi(words[3].c_str());
    if (n < 1) unknown_cliff(words);
    const PolygonMesh shape = operand_of(words[2], std::atoi(words[4].c_str()), words);
    Scene s;
    shapes::Random random(7);
    if (words[1] == "tools") {
        const double room = 2 * std::cbrt(n);
        s.operands.push_back(shapes::block({0, 0, 0}, {room, room, room}));
    }
    for (int i = 0; i < n; ++i) s.operands.push_back(member(words[1], shape, i, n, random, words));
    s.operations = {Operation::Union, Operation::Difference, Operation::Intersection,
                    Operation::ExclusiveOr};
    s.is_one_exclusive_or = true;
    return s;
}

}  // namespace

Scene cliff_scene(const std::vector<std::string>& words) {
    if (words.size() == 4) return pair_scene(words);
    if (words.size() == 5) return group_scene(words);
    unknown_cliff(words);
}

}  // namespace bench
