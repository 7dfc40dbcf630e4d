// SPDX-License-Identifier: Apache-2.0
//
// Bodies fly with constant velocity and turn; at the sides of their box they come back, as if they
// were mirrored there.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <trisect/kernel/error.h>

#include "rows.h"
#include "scenes.h"

namespace scenes {

using trisect::Point3d;
using trisect::PolygonMesh;

PolygonMesh cut_cube(const std::array<int, 3>& factors) {
    // Before they are scaled, the corners of a face are those farthest in one of 26 directions.
    std::vector<std::array<int, 3>> corners;
    std::array<int, 3> size{1, 2, 3};
    do {
        for (int signs = 0; signs < 8; ++signs)
            corners.push_back({(signs & 1) != 0 ? -size[0] : size[0],
                               (signs & 2) != 0 ? -size[1] : size[1],
                               (signs & 4) != 0 ? -size[2] : size[2]});
    } while (std::next_permutation(size.begin(), size.end()));

    PolygonMesh m;
    for (const auto& c : corners)
        m.points.push_back(
            {1.0 * c[0] * factors[0], 1.0 * c[1] * factors[1], 1.0 * c[2] * factors[2]});
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                if (x == 0 && y == 0 && z == 0) continue;
                const auto along = [&](const std::array<int, 3>& c) {
                    return x * c[0] + y * c[1] + z * c[2];
                };
                int most = 0;
                for (const auto& c : corners) most = std::max(most, along(c));
                std::vector<std::uint32_t> face;
                Point3d middle{};
                for (std::uint32_t i = 0; i < corners.size(); ++i)
                    if (along(corners[i]) == most) {
                        face.push_back(i);
                        for (std::size_t k = 0; k < 3; ++k) middle[k] += corners[i][k];
                    }
                for (double& c : middle) c /= static_cast<double>(face.size());
                // By their angle about the direction.
                const Point3d d{1.0 * x, 1.0 * y, 1.0 * z};
                const auto way = [&](std::uint32_t i) {
                    Point3d w{};
                    for (std::size_t k = 0; k < 3; ++k) w[k] = corners[i][k] - middle[k];
                    return w;
                };
                const Point3d u = way(face[0]);
                const Point3d v{d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2],
                                d[0] * u[1] - d[1] * u[0]};
                const double stretch = std::sqrt(dot(d, d));
                std::ranges::sort(face, {}, [&](std::uint32_t i) {
                    return std::atan2(dot(v, way(i)) / stretch, dot(u, way(i)));
                });
                m.add_face(face);
            }
    return m;
}

namespace {

double reflected(double x, double half) {
    const double period = 4 * half;
    double y = std::fmod(x + half, period);
    if (y < 0) y += period;
    return (y < 2 * half ? y : period - y) - half;
}

struct Body {
    Point3d from{};
    Point3d velocity{};
    Point3d axis{};
    double turn = 0;  // degrees a frame
};

Body random_body(shapes::Random& random, double half, double speed) {
    Body b;
    for (std::size_t k = 0; k < 3; ++k) b.from[k] = half * (2 * random.uniform() - 1);
    for (std::size_t k = 0; k < 3; ++k) b.velocity[k] = speed * (2 * random.uniform() - 1);
    b.axis = {random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() + 0.01};
    b.turn = 4 * random.uniform();
    return b;
}

Rows at(const Body& b, int frame, double half) {
    Point3d by{};
    for (std::size_t k = 0; k < 3; ++k) by[k] = reflected(b.from[k] + frame * b.velocity[k], half);
    return rows_of(shapes::rotation(b.axis, b.turn * frame), by);
}

SwarmScene convex(Size size) {
    SwarmScene s;
    for (const std::array<int, 3>& f :
         {std::array{4, 4, 4}, std::array{3, 4, 5}, std::array{5, 3, 3}, std::array{4, 5, 5}})
        s.shapes.push_back(cut_cube(f));
    const std::size_t n = size == Size::Full ? 1000 : 40;
    // About a twentieth of the box is filled.
    const double half = 0.5 * std::cbrt(20.0 * 12000.0 * static_cast<double>(n));
    shapes::Random random(12);
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < n; ++i) {
        s.shape_of.push_back(i % s.shapes.size());
        bodies.push_back(random_body(random, half, 2));
    }
    const int frames = size == Size::Full ? 60 : 4;
    for (int f = 0; f < frames; ++f) {
        auto& poses = s.frames.emplace_back();
        for (const Body& b : bodies) poses.push_back(at(b, f, half));
    }
    return s;
}

SwarmScene giants(Size size) {
    SwarmScene s;
    s.shapes = {shapes::block({-600, -600, -20}, {600, 600, 20}, 4),
                shapes::block({-10, -10, -600}, {10, 10, 600}, 2), cut_cube({1, 1, 1})};
    const std::size_t dwarfs = size == Size::Full ? 600 : 30;
    const double half = size == Size::Full ? 500 : 120;
    s.shape_of = {0, 1, 1};
    shapes::Random random(13);
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < dwarfs; ++i) {
        s.shape_of.push_back(2);
        bodies.push_back(random_body(random, half, 2));
    }
    const int frames = size == Size::Full ? 60 : 4;
    for (int f = 0; f < frames; ++f) {
        auto& poses = s.frames.emplace_back();
        poses.push_back(rows_of(shapes::rotation({1, 0, 0}, 0.5 * f), {}));
        poses.push_back(rows_of(shapes::rotation({0, 1, 0}, 1.0 * f), {0, 300, 0}));
        poses.push_back(rows_of(shapes::rotation({1, 1, 0}, 1.0 * f), {0, -300, 0}));
        for (const Body& b : bodies) poses.push_back(at(b, f, half));
    }
    return s;
}

// A chain on the floor that coils into a helix: each link is bent against the one before.
SwarmScene chain(Size size) {
    SwarmScene s;
    s.shapes = {cut_cube({3, 1, 1})};
    const std::size_t links = size == Size::Full ? 400 : 30;
    s.shape_of.assign(links, 0);
    const int frames = size == Size::Full ? 60 : 4;
    const double most_bend = 0.1;
    for (int f = 0; f < frames; ++f) {
        auto& poses = s.frames.emplace_back();
        const double bend = most_bend * f / frames;
        Point3d p{};
        for (std::size_t i = 0; i < links; ++i) {
            const double angle = bend * static_cast<double>(i);
            poses.push_back(
                rows_of(shapes::rotation({0, 0, 1}, angle * 180 / std::numbers::pi), p));
            // Half a length from middle to joint in both directions: links overlap a little.
            const double next = angle + bend;
            p = {p[0] + 8 * (std::cos(angle) + std::cos(next)),
                 p[1] + 8 * (std::sin(angle) + std::sin(next)), p[2] + 0.12};
        }
    }
    return s;
}

struct SwarmEntry {
    const char* name;
    const char* about;
    SwarmScene (*make)(Size);
};

constexpr std::array swarm_entries{
    SwarmEntry{"convex", "1,000 convex bodies of similar size", convex},
    SwarmEntry{"giants", "giants among 600 dwarfs", giants},
    SwarmEntry{"chain", "a chain of 400 links that coils", chain},
};

}  // namespace

std::vector<std::string> swarm_scene_names() {
    std::vector<std::string> r;
    for (const SwarmEntry& e : swarm_entries) r.emplace_back(e.name);
    return r;
}

SwarmScene make_swarm_scene(const std::string& name, Size size) {
    const auto found = std::ranges::find_if(
        swarm_entries, [&name](const SwarmEntry& e) { return name == e.name; });
    if (found == swarm_entries.end())
        throw trisect::UsageError("no scene has the name '" + name + "'");
    SwarmScene s = found->make(size);
    s.name = found->name;
    s.about = found->about;
    return s;
}

}  // namespace scenes
