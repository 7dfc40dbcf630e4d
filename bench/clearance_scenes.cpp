// SPDX-License-Identifier: Apache-2.0

#include "clearance_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/bsp/solid.h>

#include "scenes/rows.h"
#include "scenes/tubes.h"
#include "shapes.h"

namespace interference_scenes {

namespace {

using shapes::Matrix;
using trisect::Point3d;
using trisect::PolygonMesh;

constexpr double whole_turn = 2 * std::numbers::pi;

PolygonMesh scaled(PolygonMesh m, double by) {
    for (Point3d& p : m.points)
        for (double& c : p) c *= by;
    return m;
}

PolygonMesh cube(double half) { return shapes::block({-half, -half, -half}, {half, half, half}); }

PolygonMesh lifted(PolygonMesh m, double by) {
    for (Point3d& p : m.points) p[2] += by;
    return m;
}

// Concentric, turned about z, off the middle by up to `play`, tilted by a little.
void place(Scene& s, std::size_t n, double play, const Point3d& at) {
    shapes::Random random(11);
    for (std::size_t i = 0; i < n; ++i) {
        const double turn = i % 4 == 0 ? 0 : 360 * random.uniform();
        const double off = i % 4 >= 2 ? play * random.uniform() : 0;
        const double way = whole_turn * random.uniform();
        Matrix m = shapes::rotation({0, 0, 1}, turn);
        if (i % 4 == 3) m = scenes::product(shapes::rotation({1, 2, 0}, 0.05), m);
        s.placements.push_back(
            scenes::rows_of(m, {at[0] + off * std::cos(way), at[1] + off * std::sin(way), at[2]}));
    }
}

Scene peg(std::size_t n) {
    Scene s;
    s.blank = shapes::block({-30, -30, 0}, {30, 30, 20});
    s.tools.push_back(lifted(trisect::make_cylinder(10, 30, 128), -5));
    s.b = lifted(trisect::make_cylinder(9.9, 40, 128), -10);
    place(s, n, 0.08, {0, 0, 0});
    return s;
}

Scene plates(std::size_t n) {
    Scene s;
    s.a = shapes::block({-10, -10, -1}, {10, 10, 0}, 32);
    s.b = s.a;
    place(s, n, 3, {0, 0, 1.1});
    return s;
}

PolygonMesh ball(double radius, double bump) {
    PolygonMesh m = shapes::icosphere(5);
    for (Point3d& p : m.points) {
        const double r = radius * (1 + bump * std::sin(9 * p[0]) * std::sin(7 * p[1] + 4 * p[2]));
        for (double& c : p) c *= r;
    }
    return m;
}

Scene mould(std::size_t n, double larger, double bump) {
    Scene s;
    s.blank = cube(2);
    s.tools.push_back(ball(1 + larger, bump));
    s.b = ball(1, bump);
    place(s, n, larger / 2, {0, 0, 0});
    return s;
}

Scene tubes(std::size_t n) {
    Scene s;
    const auto torus = [](double minor) { return scenes::torus(minor, 64, 64); };
    s.blank = cube(2);
    s.tools.push_back(torus(0.26));
    s.b = torus(0.25);
    place(s, n, 0.004, {0, 0, 0});
    return s;
}

trisect::Outline gear_outline(int teeth) {
    trisect::Outline points;
    for (int tooth = 0; tooth < teeth; ++tooth)
        for (int k = 0; k < 16; ++k) {
            const double angle = whole_turn * (tooth + k / 16.0) / teeth;
            const double r = 1 + 0.07 * std::tanh(2.5 * std::cos(whole_turn * k / 16.0));
            points.push_back({r * std::cos(angle), r * std::sin(angle)});
        }
    return points;
}

Scene gears(std::size_t n) {
    Scene s;
    s.a = trisect::make_extrusion(gear_outline(24), {}, 0, 0.3);
    s.b = s.a;
    shapes::Random random(12);
    for (std::size_t i = 0; i < n; ++i)
        s.placements.push_back(scenes::rows_of(
            shapes::rotation({0, 0, 1}, 7.5 + 15.0 * static_cast<double>(i % 24) +
                                            (i % 4 == 0 ? 0 : 0.2 * random.uniform())),
            {2.03 + (i % 4 >= 2 ? 0.01 * random.uniform() : 0), 0, 0}));
    return s;
}

}  // namespace

std::vector<std::string> clearance_names() {
    return {"clear:peg",   "clear:plates", "clear:tubes",
            "clear:gears", "clear:offset", "clear:spheres"};
}

std::optional<Scene> make_clearance(const std::string& name, std::size_t most) {
    const std::size_t n = std::min<std::size_t>(most, 400);
    Scene s;
    if (name == "clear:peg")
        s = peg(n);
    else if (name == "clear:plates")
        s = plates(n);
    else if (name == "clear:tubes")
        s = tubes(n);
    else if (name == "clear:gears")
        s = gears(n);
    else if (name == "clear:offset")
        s = mould(n, 0.01, 0.05);
    else if (name == "clear:spheres")
        s = mould(n, 0.02, 0);
    else
        return {};
    s.name = name;
    // Peers take triangles.
    if (s.a.face_count() > 0) s.a = trisect::Solid::from_mesh(s.a).to_mesh();
    s.b = trisect::Solid::from_mesh(s.b).to_mesh();
    return s;
}

}  // namespace interference_scenes
