// SPDX-License-Identifier: Apache-2.0
//
// level_sets [ROUNDS]
// Level sets of some functions at several resolutions: triangles, time, whether validate() finds
// anything, and the error of the exact volume; beside Manifold's, where there is one
// (TRISECT_BESIDE_MANIFOLD), of which each mesh is validated, too. Rows of a table. One thread.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/level_set/level_set_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/validate/validate.h>

#ifdef TRISECT_BESIDE_MANIFOLD
#include <manifold/manifold.h>
#endif

namespace {

using trisect::Bounds;
using trisect::Point3d;
using trisect::PolygonMesh;

constexpr double pi = std::numbers::pi;

struct Shape {
    std::string name;
    std::function<double(const Point3d&)> function;
    Bounds box;
    double volume = 0;  // 0: not known
};

double blobs(const Point3d& p) {
    double sum = -1;
    for (int i = 0; i < 8; ++i) {
        const double x = p[0] - 0.7 * std::cos(1.7 * i);
        const double y = p[1] - 0.7 * std::sin(2.3 * i);
        const double z = p[2] - 0.7 * std::cos(3.1 * i + 1);
        sum += 0.12 / (x * x + y * y + z * z + 0.01);
    }
    return sum;
}

std::vector<Shape> shapes() {
    const Bounds box{{-1.25, -1.25, -1.25}, {1.25, 1.25, 1.25}};
    return {
        {"ball", [](const Point3d& p) { return 1 - std::hypot(p[0], p[1], p[2]); }, box,
         4 * pi / 3},
        {"torus",
         [](const Point3d& p) { return 0.3 - std::hypot(std::hypot(p[0], p[1]) - 0.8, p[2]); }, box,
         2 * pi * 0.8 * pi * 0.09},
        {"gyroid",
         [](const Point3d& p) {
             return std::sin(p[0]) * std::cos(p[1]) + std::sin(p[1]) * std::cos(p[2]) +
                    std::sin(p[2]) * std::cos(p[0]);
         },
         {{0, 0, 0}, {2 * pi, 2 * pi, 2 * pi}},
         4 * pi * pi * pi},
        {"blobs", blobs, box, 0},
    };
}

double seconds_of(int rounds, const std::function<void()>& work) {
    double least = 1e9;
    for (int i = 0; i < rounds; ++i) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        least = std::min(least, took.count());
    }
    return least;
}

void print_columns(const PolygonMesh& mesh, double seconds, double volume) {
    const auto report = trisect::validate(mesh);
    const double made = trisect::exact_volume(trisect::import_mesh(mesh).mesh).to_double();
    std::string error = "-";
    if (volume > 0) {
        char text[32];
        std::snprintf(text, sizeof text, "%.1e", made / volume - 1);
        error = text;
    }
    std::printf(" %zu | %.4f | %s | %s |", mesh.face_count(), seconds, error.c_str(),
                report.empty() ? "none" : std::to_string(report.defects().size()).c_str());
}

#ifdef TRISECT_BESIDE_MANIFOLD
double print_theirs(const Shape& shape, double edge, int rounds) {
    manifold::MeshGL64 mesh;
    const auto function = [&](manifold::vec3 p) { return shape.function({p.x, p.y, p.z}); };
    const auto& [lo, hi] = shape.box;
    const double seconds = seconds_of(rounds, [&] {
        mesh = manifold::Manifold::LevelSet(
                   function, {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}, edge, 0, -1, false)
                   .GetMeshGL64();
    });
    PolygonMesh polygons;
    for (std::size_t i = 0; i < mesh.vertProperties.size(); i += mesh.numProp)
        polygons.points.push_back(
            {mesh.vertProperties[i], mesh.vertProperties[i + 1], mesh.vertProperties[i + 2]});
    for (std::size_t i = 0; i < mesh.triVerts.size(); i += 3)
        polygons.add_triangle(static_cast<std::uint32_t>(mesh.triVerts[i]),
                              static_cast<std::uint32_t>(mesh.triVerts[i + 1]),
                              static_cast<std::uint32_t>(mesh.triVerts[i + 2]));
    print_columns(polygons, seconds, shape.volume);
    return seconds;
}
#endif

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 3;
    for (const Shape& shape : shapes())
        for (const int cells : {16, 32, 64, 128}) {
            const double edge = (shape.box.hi[0] - shape.box.lo[0]) / cells;
            PolygonMesh mesh;
            const double ours = seconds_of(
                rounds, [&] { mesh = trisect::make_level_set(shape.function, shape.box, edge); });
            std::printf("| %s | %d |", shape.name.c_str(), cells);
            print_columns(mesh, ours, shape.volume);
#ifdef TRISECT_BESIDE_MANIFOLD
            std::printf(" %.2f |", print_theirs(shape, edge, rounds) / ours);
#endif
            std::printf("\n");
            std::fflush(stdout);
        }
    return 0;
}
