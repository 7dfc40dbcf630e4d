// SPDX-License-Identifier: Apache-2.0

#include "interference_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/kernel/error.h>

#include "clearance_scenes.h"
#include "scenes/extent.h"
#include "scenes/rows.h"
#include "scenes/scenes.h"
#include "scenes/tubes.h"
#include "shapes.h"

namespace interference_scenes {

namespace {

using shapes::Matrix;
using trisect::Point3d;
using trisect::PolygonMesh;

constexpr double pi = std::numbers::pi;

// The triangles of a mesh with its points on the lattice that import chooses.
PolygonMesh on_lattice(const PolygonMesh& mesh) {
    const auto imported = trisect::import_mesh(mesh);
    PolygonMesh out;
    for (const auto& p : imported.mesh.points)
        out.points.push_back({imported.report.lattice.lattice.to_double(p.x.to_double()),
                              imported.report.lattice.lattice.to_double(p.y.to_double()),
                              imported.report.lattice.lattice.to_double(p.z.to_double())});
    for (const auto& [a, b, c] : imported.mesh.triangles) out.add_triangle(a, b, c);
    return out;
}

PolygonMesh from_models(const std::string& file) {
    const char* models = std::getenv("TRISECT_MODELS");
    const std::filesystem::path folder = models == nullptr ? "../shared/models" : models;
    return trisect::read_mesh(std::filesystem::exists(file) ? std::filesystem::path(file)
                                                            : folder / file);
}

PolygonMesh centred(PolygonMesh m) {
    const scenes::Extent e = scenes::extent(m);
    for (auto& p : m.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] -= 0.5 * (e.lo[k] + e.hi[k]);
    return m;
}

Scene tori(const std::string& name, std::size_t n) {
    const std::uint32_t q = name == "tori200k" ? 317 : 100;
    Scene s{name, on_lattice(scenes::torus(0.25, q, q)), {}, {}};
    s.b = s.a;
    const Matrix up = shapes::rotation({1, 0, 0}, 90);
    for (std::size_t i = 0; i < n; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(n);
        const double rho = 0.48 + 0.03 * std::sin(2 * pi * 17 * t);
        const double phi = 2 * pi * 3 * t;
        const Matrix m = scenes::product(up, shapes::rotation({0, 0, 1}, 360 * 5 * t));
        s.placements.push_back(
            scenes::rows_of(m, {1 + rho * std::cos(phi), rho * std::sin(phi), 0}));
    }
    for (int i = 0; i < 1000; ++i)
        s.path.push_back(
            scenes::rows_of(shapes::rotation({0, 1, 0}, 90 + 10 * std::sin(0.01 * i)),
                            {1 + 0.3 * std::cos(0.013 * i), 0, 0.3 * std::sin(0.019 * i)}));
    return s;
}

Scene against_itself(const std::string& name, const std::string& file, std::size_t n) {
    Scene s{name, on_lattice(centred(from_models(file))), {}, {}};
    s.b = s.a;
    const double diagonal = scenes::extent(s.a).diagonal();
    shapes::Random random(7);
    for (std::size_t i = 0; i < n; ++i) {
        const Matrix m = random.rotation();
        Point3d by = scenes::random_direction(random);
        const double d = (0.35 + 0.5 * random.uniform()) * diagonal;
        for (double& c : by) c *= d;
        s.placements.push_back(scenes::rows_of(m, by));
    }
    // Tumbling around each other, now closer, now farther.
    for (int i = 0; i < 1000; ++i) {
        const double d = (0.55 + 0.2 * std::sin(0.02 * i)) * diagonal;
        s.path.push_back(scenes::rows_of(shapes::rotation({1, 2, 3}, 0.3 * i),
                                         {d * std::cos(0.004 * i), d * std::sin(0.004 * i), 0}));
    }
    return s;
}

// One of the scenes on which structures are compared, with more frames.
Scene compared_pair(const std::string& name, std::size_t n) {
    auto pair = scenes::make_pair_scene(name, scenes::Size::Full, static_cast<std::uint32_t>(n));
    if (!pair) throw trisect::UsageError("the models of " + name + " are not in TRISECT_MODELS");
    return {name, std::move(pair->a), std::move(pair->b), std::move(pair->frames), {}};
}

}  // namespace

std::vector<std::string> names() {
    return {"tori", "tori200k", "bear28k", "bunny100k", "screw", "parts"};
}

Scene make(const std::string& name, std::size_t most) {
    if (auto clear = make_clearance(name, most)) return std::move(*clear);
    if (name == "tori") return tori(name, std::min<std::size_t>(most, 2000));
    if (name == "tori200k") return tori(name, std::min<std::size_t>(most, 500));
    if (name == "screw" || name == "parts")
        return compared_pair(name, std::min<std::size_t>(most, 2000));
    const std::size_t n = std::min<std::size_t>(most, 2000);
    if (name == "bear28k") {
        const char* file = std::getenv("TRISECT_BEAR");
        return against_itself(name, file == nullptr ? "bear.off" : file, n);
    }
    if (name == "bunny100k")
        return against_itself(name, "large/bunny100k.obj", std::min<std::size_t>(n, 500));
    return against_itself(name, name, n);
}

}  // namespace interference_scenes
