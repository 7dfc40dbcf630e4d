// SPDX-License-Identifier: Apache-2.0
//
// Tori are made with the trigonometry of the C library and rounded to a lattice at once, so that
// its last bits do not show.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/kernel/error.h>

#include "extent.h"
#include "rows.h"
#include "scenes.h"
#include "tubes.h"

namespace scenes {

namespace {

using shapes::Matrix;
using trisect::Point3d;
using trisect::PolygonMesh;

constexpr double pi = std::numbers::pi;

void on_one_lattice(PairScene& s) {
    std::vector<PolygonMesh> both{std::move(s.a), std::move(s.b)};
    shapes::put_on_one_lattice(both);
    s.a = std::move(both[0]);
    s.b = std::move(both[1]);
}

struct Detail {
    Size size = Size::Full;
    std::uint32_t wanted_frames = 0;

    [[nodiscard]] std::uint32_t fineness(std::uint32_t full, std::uint32_t small) const {
        return size == Size::Full ? full : small;
    }
    [[nodiscard]] std::uint32_t frames(std::uint32_t full, std::uint32_t small) const {
        return wanted_frames != 0 ? wanted_frames : fineness(full, small);
    }
};

PairScene linked(const Detail& detail) {
    PairScene s;
    s.a = s.b = torus(0.2, detail.fineness(50, 14), detail.fineness(50, 8));
    const std::uint32_t n = detail.frames(100, 5);
    const Matrix up = shapes::rotation({1, 0, 0}, 90);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double t = 1.0 * i / n;
        s.frames.push_back(rows_of(product(shapes::rotation({1, 0, 0}, 20 * std::sin(2 * pi * t)),
                                           product(up, shapes::rotation({0, 0, 1}, 360 * t))),
                                   {1 + 0.2 * std::cos(6 * pi * t), 0.2 * std::sin(6 * pi * t),
                                    0.1 * std::sin(4 * pi * t)}));
    }
    return s;
}

PairScene near_tori(const Detail& detail) {
    PairScene s;
    s.a = s.b = torus(0.2, detail.fineness(50, 14), detail.fineness(50, 8));
    const Matrix up = shapes::rotation({1, 0, 0}, 90);
    const std::uint32_t n = detail.frames(100, 6);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double gap = std::pow(10, -1 - 5.0 * i / (n - 1));
        s.frames.push_back(rows_of(up, {1.6 - gap, 0, 0}));
    }
    return s;
}

PairScene crossing(const Detail& detail) {
    PairScene s;
    s.a = s.b = torus(0.2, detail.fineness(50, 14), detail.fineness(50, 8));
    const std::uint32_t n = detail.frames(100, 4);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double t = 1.0 * i / n;
        s.frames.push_back(rows_of(shapes::rotation({1, 2, 3}, 360 * t), {1 - t, 0.3 * t, 0.1}));
    }
    return s;
}

PairScene shells(const Detail& detail) {
    PairScene s;
    s.a = torus(0.25, detail.fineness(60, 10), detail.fineness(40, 8));
    s.b = torus(0.2, detail.fineness(60, 10), detail.fineness(40, 8));
    const std::uint32_t n = detail.frames(20, 3);
    for (std::uint32_t i = 0; i < n; ++i) {
        // Of the way to where the tubes touch; turned by whole segments, so that they stay
        // parallel.
        const double part = 0.9 * i / (n - 1);
        const double turn = 360.0 / detail.fineness(60, 10) * i;
        s.frames.push_back(rows_of(shapes::rotation({0, 0, 1}, turn), {0, 0, 0.045 * part}));
    }
    return s;
}

PairScene falling(const Detail& detail) {
    PairScene s;
    s.a = tube(detail.fineness(80, 16), detail.fineness(40, 8), [](double u, double v) {
        const double minor = 0.3 * (1 + 0.15 * std::cos(8 * u) * std::cos(3 * v));
        const double r = 1 + minor * std::cos(v);
        return Point3d{r * std::cos(u), r * std::sin(u), minor * std::sin(v)};
    });
    s.b = tube(detail.fineness(60, 14), detail.fineness(20, 6), [](double u, double v) {
        const double r = 0.42 + 0.1 * std::cos(v);
        return Point3d{r * std::cos(u), r * std::sin(u), 0.1 * std::sin(v) + 0.2 * std::cos(2 * u)};
    });
    const std::uint32_t n = detail.frames(400, 9);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double t = 1.0 * i / (n - 1);
        s.frames.push_back(
            rows_of(product(shapes::rotation({1, 0.3, 0}, 55 * std::sin(5 * t)),
                            shapes::rotation({0, 0, 1}, 300 * t)),
                    {0.18 * std::sin(7 * t), 0.15 * std::cos(5 * t), 1.6 - 3.2 * t}));
    }
    return s;
}

std::optional<PolygonMesh> model(const std::string& file) {
    const char* models = std::getenv("TRISECT_MODELS");
    if (models == nullptr) return std::nullopt;
    const std::filesystem::path path = std::filesystem::path(models) / file;
    if (!std::filesystem::exists(path)) return std::nullopt;
    return trisect::read_mesh(path);
}

std::optional<PairScene> screw(const Detail& detail) {
    auto a = model("mechanisms/screw-big.obj");
    auto b = model("mechanisms/nut-big.obj");
    if (!a || !b) return std::nullopt;
    PairScene s;
    s.a = std::move(*a);
    s.b = std::move(*b);
    shapes::Random random(8);
    const std::uint32_t n = detail.frames(200, 3);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double t = 1.0 * i / n;
        const double x = 0.1 * (random.uniform() - 0.5);
        const double z = 0.1 * (random.uniform() - 0.5);
        s.frames.push_back(rows_of(shapes::rotation({0, 1, 0}, 3600 * t), {x, -5 + 20 * t, z}));
    }
    return s;
}

// The corner that is farthest in a direction, after a rotation.
Point3d farthest(const PolygonMesh& mesh, const Matrix& m, const Point3d& d) {
    Point3d best = times(m, mesh.points.front());
    for (const Point3d& p : mesh.points) {
        const Point3d q = times(m, p);
        if (dot(q, d) > dot(best, d)) best = q;
    }
    return best;
}

// About the axes by quarters: doubles stay exact, so that corner meets corner.
Matrix quarter_turns(shapes::Random& random) {
    Matrix m = identity;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto turns = static_cast<std::size_t>(4 * random.uniform());
        const double c = std::array<double, 4>{1, 0, -1, 0}[turns];
        const double v = std::array<double, 4>{0, 1, 0, -1}[turns];
        Matrix q{};
        q[k][k] = 1;
        q[(k + 1) % 3][(k + 1) % 3] = q[(k + 2) % 3][(k + 2) % 3] = c;
        q[(k + 1) % 3][(k + 2) % 3] = -v;
        q[(k + 2) % 3][(k + 1) % 3] = v;
        m = product(q, m);
    }
    return m;
}

std::optional<PairScene> parts(const Detail& detail) {
    auto a = model("cad/box.STL");
    auto b = model("cad/ADIS16480.STL");
    if (!a || !b) return std::nullopt;
    for (Point3d& p : b->points)
        for (double& c : p) c *= 64;
    PairScene s;
    s.a = std::move(*a);
    s.b = std::move(*b);
    on_one_lattice(s);
    const double d = extent(s.a).diagonal();
    const std::array<double, 10> gaps{0,       0x1p-40 * d, 0x1p-20 * d, 1e-4 * d,  1e-2 * d,
                                      0.1 * d, d,           -1e-4 * d,   -1e-2 * d, -0.1 * d};
    shapes::Random random(9);
    const std::uint32_t n = detail.frames(100, 10);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double gap = gaps[i % gaps.size()];
        Matrix m = random.rotation();
        const Point3d way = random_direction(random);
        if (gap == 0) m = quarter_turns(random);
        const Point3d on_a = farthest(s.a, identity, way);
        const Point3d on_b = farthest(s.b, m, {-way[0], -way[1], -way[2]});
        Point3d by{};
        for (std::size_t k = 0; k < 3; ++k) by[k] = on_a[k] - on_b[k] + gap * way[k];
        s.frames.push_back(rows_of(m, by));
    }
    return s;
}

// Faces as fans: engines that know triangles alone get the whole surface. \pre faces are convex
PolygonMesh in_triangles(const PolygonMesh& m) {
    PolygonMesh r;
    r.points = m.points;
    for (std::size_t f = 0; f < m.face_count(); ++f) {
        const auto c = m.face(f);
        for (std::size_t i = 2; i < c.size(); ++i) r.add_triangle(c[0], c[i - 1], c[i]);
    }
    return r;
}

PairScene field_of_obstacles(int n, const PolygonMesh& body, std::uint32_t frames) {
    PairScene s;
    s.b = body;
    shapes::Random random(5);
    // Of each cube of side 8 a cut cube takes at most the middle 6: they do not meet.
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y)
            for (int z = 0; z < n; ++z) {
                const double half = 0.5 + 0.3 * random.uniform();
                PolygonMesh one = in_triangles(cut_cube({1, 1, 1}));
                const Point3d jitter = random.in_unit_box();
                for (Point3d& p : one.points)
                    for (std::size_t k = 0; k < 3; ++k)
                        p[k] = half * p[k] + 0.5 * jitter[k] + 8 * std::array<int, 3>{x, y, z}[k];
                shapes::append(s.a, one);
            }
    for (std::uint32_t i = 0; i < frames; ++i) {
        const double t = 1.0 * i / frames;
        const double way = 4.0 * n - 4;
        Point3d by{};
        const std::array<double, 3> turns{3, 4, 5};
        for (std::size_t k = 0; k < 3; ++k)
            by[k] =
                way + 1.1 * way * std::sin(2 * pi * (turns[k] * t + 0.1 * static_cast<double>(k)));
        s.frames.push_back(rows_of(shapes::rotation({1, 2, 3}, 3000 * t), by));
    }
    return s;
}

PairScene fly_through(const Detail& detail) {
    return field_of_obstacles(detail.size == Size::Full ? 10 : 3,
                              torus(0.3, detail.fineness(16, 8), detail.fineness(10, 5)),
                              detail.frames(500, 8));
}

struct PairEntry {
    const char* name;
    const char* about;
    std::optional<PairScene> (*make)(const Detail&);
};

template <PairScene (*Make)(const Detail&)>
std::optional<PairScene> always(const Detail& detail) {
    return Make(detail);
}

constexpr std::array pair_entries{
    PairEntry{"tori-linked", "RAPID's sample: two linked tori, turning", always<linked>},
    PairEntry{"tori-near", "linked tori, tubes 1e-1 to 1e-6 apart", always<near_tori>},
    PairEntry{"tori-crossing", "two tori pushed through each other", always<crossing>},
    PairEntry{"shells", "a torus in a thicker one, surfaces parallel", always<shells>},
    PairEntry{"falling", "a bent torus falls through a knobby one", always<falling>},
    PairEntry{"screw", "a nut on its screw, shaken", screw},
    PairEntry{"parts", "two machined parts at ten distances", parts},
    PairEntry{"fly-through", "a small torus flies through a field of obstacles",
              always<fly_through>},
};

}  // namespace

std::vector<std::string> pair_scene_names() {
    std::vector<std::string> r;
    for (const PairEntry& e : pair_entries) r.emplace_back(e.name);
    return r;
}

PairScene make_fly_through(int side, std::uint32_t frames) {
    PairScene s = field_of_obstacles(side, torus(0.3, 16, 10), frames);
    s.name = "fly-through";
    s.about = "a small torus among " + std::to_string(side * side * side) + " obstacles";
    on_one_lattice(s);
    return s;
}

std::optional<PairScene> make_pair_scene(const std::string& name, Size size, std::uint32_t frames) {
    const auto found =
        std::ranges::find_if(pair_entries, [&name](const PairEntry& e) { return name == e.name; });
    if (found == pair_entries.end())
        throw trisect::UsageError("no scene has the name '" + name + "'");
    auto s = found->make({size, frames});
    if (!s) return s;
    s->name = found->name;
    s->about = found->about;
    on_one_lattice(*s);
    return s;
}

}  // namespace scenes
