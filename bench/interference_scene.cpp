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

#include "shapes.h"

namespace interference_scenes {

namespace {

using interference_peers::Placement;
using shapes::Matrix;
using trisect::Point3d;
using trisect::PolygonMesh;

constexpr double pi = std::numbers::pi;

// The triangles of a mesh with its points on the lattice that import chooses.
PolygonMesh on_lattice(const PolygonMesh& mesh) {
    const auto imported = trisect::import_mesh(mesh);
    PolygonMesh out;
    for (const auto& p : imported.mesh.points)
        out.points.push_back({imported.report.lattice.lattice.to_double(double(p.x)),
                              imported.report.lattice.lattice.to_double(double(p.y)),
                              imported.report.lattice.lattice.to_double(double(p.z))});
    for (const auto& [a, b, c] : imported.mesh.triangles) out.add_triangle(a, b, c);
    return out;
}

PolygonMesh from_models(const std::string& file) {
    const char* models = std::getenv("TRISECT_MODELS");
    const std::filesystem::path folder = models == nullptr ? "../shared/models" : models;
    return trisect::read_mesh(std::filesystem::exists(file) ? std::filesystem::path(file)
                                                            : folder / file);
}

PolygonMesh torus(double major, double minor, std::uint32_t nu, std::uint32_t nv) {
    PolygonMesh m;
    for (std::uint32_t i = 0; i < nu; ++i)
        for (std::uint32_t j = 0; j < nv; ++j) {
            const double u = 2 * pi * i / nu;
            const double v = 2 * pi * j / nv;
            const double r = major + minor * std::cos(v);
            m.points.push_back({r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
        }
    const auto id = [nu, nv](std::uint32_t i, std::uint32_t j) { return i % nu * nv + j % nv; };
    for (std::uint32_t i = 0; i < nu; ++i)
        for (std::uint32_t j = 0; j < nv; ++j) {
            m.add_triangle(id(i, j), id(i + 1, j), id(i + 1, j + 1));
            m.add_triangle(id(i, j), id(i + 1, j + 1), id(i, j + 1));
        }
    return m;
}

Placement placement(const Matrix& m, const Point3d& by) {
    Placement p{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) p[4 * i + j] = m[i][j];
        p[4 * i + 3] = by[i];
    }
    return p;
}

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix r{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) r[i][j] += a[i][k] * b[k][j];
    return r;
}

Point3d times(const Matrix& m, const Point3d& p) {
    Point3d r{};
    for (std::size_t i = 0; i < 3; ++i) r[i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2];
    return r;
}

double dot(const Point3d& a, const Point3d& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Extent {
    Point3d lo{};
    Point3d hi{};
    [[nodiscard]] double diagonal() const {
        return std::hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
    }
};
Extent extent(const PolygonMesh& m) {
    Extent e{m.points.front(), m.points.front()};
    for (const auto& p : m.points)
        for (std::size_t k = 0; k < 3; ++k) {
            e.lo[k] = std::min(e.lo[k], p[k]);
            e.hi[k] = std::max(e.hi[k], p[k]);
        }
    return e;
}
PolygonMesh centred(PolygonMesh m) {
    const Extent e = extent(m);
    for (auto& p : m.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] -= 0.5 * (e.lo[k] + e.hi[k]);
    return m;
}

Point3d random_direction(shapes::Random& random) {
    const double z = 2 * random.uniform() - 1;
    const double f = 2 * pi * random.uniform();
    const double s = std::sqrt(1 - z * z);
    return {s * std::cos(f), s * std::sin(f), z};
}

Scene tori(const std::string& name, std::size_t n) {
    const std::uint32_t q = name == "tori200k" ? 317 : 100;
    Scene s{name, on_lattice(torus(1, 0.25, q, q)), {}, {}};
    s.b = s.a;
    const Matrix up = shapes::rotation({1, 0, 0}, 90);
    for (std::size_t i = 0; i < n; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(n);
        const double rho = 0.48 + 0.03 * std::sin(2 * pi * 17 * t);
        const double phi = 2 * pi * 3 * t;
        const Matrix m = product(up, shapes::rotation({0, 0, 1}, 360 * 5 * t));
        s.placements.push_back(placement(m, {1 + rho * std::cos(phi), rho * std::sin(phi), 0}));
    }
    for (int i = 0; i < 1000; ++i)
        s.path.push_back(placement(shapes::rotation({0, 1, 0}, 90 + 10 * std::sin(0.01 * i)),
                                   {1 + 0.3 * std::cos(0.013 * i), 0, 0.3 * std::sin(0.019 * i)}));
    return s;
}

Scene against_itself(const std::string& name, const std::string& file, std::size_t n) {
    Scene s{name, on_lattice(centred(from_models(file))), {}, {}};
    s.b = s.a;
    const double diagonal = extent(s.a).diagonal();
    shapes::Random random(7);
    for (std::size_t i = 0; i < n; ++i) {
        const Matrix m = random.rotation();
        Point3d by = random_direction(random);
        const double d = (0.35 + 0.5 * random.uniform()) * diagonal;
        for (double& c : by) c *= d;
        s.placements.push_back(placement(m, by));
    }
    // Tumbling around each other, now closer, now farther.
    for (int i = 0; i < 1000; ++i) {
        const double d = (0.55 + 0.2 * std::sin(0.02 * i)) * diagonal;
        s.path.push_back(placement(shapes::rotation({1, 2, 3}, 0.3 * i),
                                   {d * std::cos(0.004 * i), d * std::sin(0.004 * i), 0}));
    }
    return s;
}

Scene screw(std::size_t n) {
    Scene s{"screw",
            on_lattice(from_models("mechanisms/screw-big.obj")),
            on_lattice(from_models("mechanisms/nut-big.obj")),
            {}};
    shapes::Random random(8);
    for (std::size_t i = 0; i < n; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(n);
        const double shake = 0.1;
        s.placements.push_back(placement(
            shapes::rotation({0, 1, 0}, 3600 * t),
            {shake * (random.uniform() - 0.5), -5 + 20 * t, shake * (random.uniform() - 0.5)}));
    }
    return s;
}

// The corner of a mesh, after a rotation, that is farthest in a direction.
Point3d farthest(const PolygonMesh& mesh, const Matrix& m, const Point3d& d) {
    Point3d best = times(m, mesh.points.front());
    for (const auto& p : mesh.points) {
        const Point3d q = times(m, p);
        if (dot(q, d) > dot(best, d)) best = q;
    }
    return best;
}

Scene parts(std::size_t n) {
    PolygonMesh small = from_models("cad/ADIS16480.STL");
    for (auto& p : small.points)
        for (double& c : p) c *= 64;
    Scene s{"parts", on_lattice(from_models("cad/box.STL")), on_lattice(small), {}};
    const double size = extent(s.a).diagonal();
    const std::array<double, 10> gaps{
        0,          0x1p-40 * size, 0x1p-20 * size, 1e-4 * size,  1e-2 * size,
        0.1 * size, size,           -1e-4 * size,   -1e-2 * size, -0.1 * size};
    const Matrix identity{Point3d{1, 0, 0}, Point3d{0, 1, 0}, Point3d{0, 0, 1}};
    shapes::Random random(9);
    for (std::size_t i = 0; i < n; ++i) {
        const double gap = gaps[i % gaps.size()];
        Matrix m = random.rotation();
        Point3d d = random_direction(random);
        if (gap == 0) {
            // Quarter turns keep doubles exact, so corner meets corner exactly.
            m = identity;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto turns = static_cast<int>(4 * random.uniform());
                Matrix q{};
                const double c =
                    std::array<double, 4>{1, 0, -1, 0}[static_cast<std::size_t>(turns)];
                const double v =
                    std::array<double, 4>{0, 1, 0, -1}[static_cast<std::size_t>(turns)];
                q[k][k] = 1;
                q[(k + 1) % 3][(k + 1) % 3] = q[(k + 2) % 3][(k + 2) % 3] = c;
                q[(k + 1) % 3][(k + 2) % 3] = -v;
                q[(k + 2) % 3][(k + 1) % 3] = v;
                m = product(q, m);
            }
        }
        const Point3d on_a = farthest(s.a, identity, d);
        const Point3d on_b = farthest(s.b, m, {-d[0], -d[1], -d[2]});
        Point3d by{};
        for (std::size_t k = 0; k < 3; ++k) by[k] = on_a[k] - on_b[k] + gap * d[k];
        s.placements.push_back(placement(m, by));
    }
    return s;
}

}  // namespace

std::vector<std::string> names() {
    return {"tori", "tori200k", "bear28k", "bunny100k", "screw", "parts"};
}

Scene make(const std::string& name, std::size_t most) {
    if (name == "tori") return tori(name, std::min<std::size_t>(most, 2000));
    if (name == "tori200k") return tori(name, std::min<std::size_t>(most, 500));
    if (name == "screw") return screw(std::min<std::size_t>(most, 2000));
    if (name == "parts") return parts(std::min<std::size_t>(most, 2000));
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
