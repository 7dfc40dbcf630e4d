// SPDX-License-Identifier: Apache-2.0
//
// Cut and fill: a terrain from a grid of heights, a building pad with slopes, footings in the
// ground. How much earth is dug off, how much is filled in, how much concrete is below the ground?
// All sums come out exactly, which is how one finds out that a solid was forgotten.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <vector>

#include <trisect/trisect.h>

namespace {

using namespace trisect;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

constexpr std::uint32_t n = 40;  // 40 x 40 cells of 2 m
constexpr double cell = 2;
constexpr double bottom = -20;

// Heights in millimetres, as from a survey.
double height(double x, double y) {
    return std::round(1000 * (3 * std::sin(x / 7) + 2 * std::cos(y / 5) + 0.1 * x)) / 1000;
}

// Closed by walls and a floor. `by_hand` becomes the volume: over each triangle a prism.
PolygonMesh make_terrain(ExactRational& by_hand) {
    PolygonMesh mesh;
    const auto add_points = [&](bool is_top) {
        for (std::uint32_t i = 0; i <= n; ++i)
            for (std::uint32_t j = 0; j <= n; ++j)
                mesh.points.push_back({cell * i, cell * j, is_top ? height(i, j) : bottom});
    };
    add_points(true);
    add_points(false);
    constexpr std::uint32_t floor = (n + 1) * (n + 1);
    const auto at = [](std::uint32_t i, std::uint32_t j) { return i * (n + 1) + j; };
    ExactRational heights;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.add_triangle(a, b, c);
        mesh.add_triangle(floor + c, floor + b, floor + a);
        for (const std::uint32_t v : {a, b, c})
            heights +=
                ExactRational::from_double(mesh.points[v][2]) - ExactRational::from_double(bottom);
    };
    const auto add_wall = [&](std::uint32_t a, std::uint32_t b) {
        mesh.add_triangle(b, a, floor + a);
        mesh.add_triangle(b, floor + a, floor + b);
    };
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
        add_wall(at(i, 0), at(i + 1, 0));
        add_wall(at(n, i), at(n, i + 1));
        add_wall(at(n - i, n), at(n - i - 1, n));
        add_wall(at(0, n - i), at(0, n - i - 1));
    }
    by_hand = heights / 3 * (ExactRational::from_double(cell * cell) / 2);
    return mesh;
}

Solid box(const Point3d& low, const Point3d& high) { return Solid::from_mesh(make_box(low, high)); }

// The pad at one end, a square that is larger by `spread` on each side at the other.
Solid frustum(double z, double other, double spread) {
    std::vector<Point3d> corners;
    for (const double x : {28.0, 56.0}) {
        for (const double y : {24.0, 60.0}) {
            corners.push_back({x, y, z});
            corners.push_back(
                {x < 42 ? x - spread : x + spread, y < 42 ? y - spread : y + spread, other});
        }
    }
    return Solid::from_mesh(make_hull(corners));
}

}  // namespace

int main() {
    ExactRational by_hand;
    const Solid ground = Solid::from_mesh(make_terrain(by_hand));
    expect(exact_volume(ground) == by_hand, "the terrain's volume");

    // The pad lies at level 2. Above it everything is dug off, with slopes of one in one; below it
    // the hollow is filled up, with slopes as well: frustums upside down and upright.
    constexpr double level = 2;
    constexpr double deep = 16;
    const Solid dug = evaluate(frustum(level, level + deep, deep) & ground);
    const Solid filled = evaluate(frustum(level, level - deep, deep) - ground);
    const Solid levelled = evaluate((ground - dug) | filled);
    expect(
        exact_volume(levelled) == exact_volume(ground) - exact_volume(dug) + exact_volume(filled),
        "cut and fill");
    expect(evaluate((levelled ^ ground) ^ (dug | filled)).is_empty(), "nothing else changed");

    // Footings: piers on a grid, 1.25 m thick, that reach 3 m below the pad, with a ring beam.
    std::vector<Solid> parts;
    for (const double x : {30.0, 41.5, 52.75})
        for (const double y : {26.0, 41.5, 56.75})
            parts.push_back(box({x, y, level - 3}, {x + 1.25, y + 1.25, level + 0.5}));
    parts.push_back(evaluate(box({30, 26, level - 1}, {54, 58, level}) -
                             box({31, 27, level - 2}, {53, 57, level + 1})));
    const Solid concrete = evaluate(Expression::any_of(parts));
    const Solid buried = evaluate(concrete & levelled);
    const Solid above = evaluate(concrete - levelled);
    const Solid finished = evaluate(levelled | concrete);
    expect(exact_volume(buried) + exact_volume(above) == exact_volume(concrete), "concrete");
    expect(exact_volume(finished) + exact_volume(buried) ==
               exact_volume(levelled) + exact_volume(concrete),
           "inclusion and exclusion");
    // Nine stumps.
    expect(exact_volume(above) == ExactRational::from_double(9 * 1.25 * 1.25 * 0.5), "stumps");

    write_mesh("foundations.stl", finished.to_mesh());
    std::cout << "ground " << volume(ground) << " m^3: " << volume(dug) << " dug off, "
              << volume(filled) << " filled in\nconcrete " << volume(concrete) << " m^3, "
              << volume(buried) << " of it below the ground; " << counts(finished).triangles
              << " triangles\n";
    return 0;
}
