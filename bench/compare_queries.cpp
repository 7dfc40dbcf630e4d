// SPDX-License-Identifier: Apache-2.0
//
// Queries beside CGAL (Side_of_triangle_mesh, AABB_tree) and Embree (single precision) on identical
// doubles, in one process and on one thread; times are what the thread had of a processor. Prints a
// line of JSON for every scene, kind of point and engine. Every answer is compared with CGAL's,
// which is exact for these predicates.
//
//     compare_queries [--runs 3] [--points 300000] [--scene NAME]... [--no-peers]
//
// Scenes: bunny, armadillo (100k triangles, folder large/ of TRISECT_MODELS), part (a tray with
// pockets, folder cad/), sphere (1.3 million triangles) and cubes (the union of 10 x 10 x 10 cubes
// with gaps, 12,000 triangles). Points: uniform in the box, near the surface (a facet's point moved
// by up to a thousandth of the box), and exactly on corners, edges and faces. Rays: from points
// around the box to points in it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <nlohmann/json.hpp>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/validate/defect.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/counters.h>

#include "query_peers.h"
#include "shapes.h"

namespace {

using nlohmann::json;
using query_peers::Peer;
using query_peers::Point;
using query_peers::Ray;
using query_peers::Side;
using query_peers::thread_seconds;
using trisect::BrepIndex;
using trisect::Location;
using trisect::PolygonMesh;
using trisect::Solid;

struct Options {
    int runs = 3;
    std::size_t points = 300000;
    std::vector<std::string> scenes;
    bool peers = true;
};

double median_seconds(int runs, const std::function<void()>& work) {
    std::vector<double> times;
    for (int i = 0; i < runs; ++i) {
        const double start = thread_seconds();
        work();
        times.push_back(thread_seconds() - start);
    }
    std::ranges::sort(times);
    return times[times.size() / 2];
}

/// The triangles of a mesh with its points on the lattice that import chooses.
PolygonMesh on_lattice(const PolygonMesh& mesh) {
    const auto imported = trisect::import_mesh(mesh);
    PolygonMesh out;
    for (const auto& p : imported.mesh.points)
        out.points.push_back(trisect::to_user(p, imported.mesh.lattice));
    for (const auto& [a, b, c] : imported.mesh.triangles) out.add_triangle(a, b, c);
    return out;
}

PolygonMesh cube_grid() {
    PolygonMesh mesh;
    for (int x = 0; x < 10; ++x)
        for (int y = 0; y < 10; ++y)
            for (int z = 0; z < 10; ++z) {
                const trisect::Point3d low{4.0 * x, 4.0 * y, 4.0 * z};
                shapes::append(mesh, shapes::block(low, {low[0] + 3, low[1] + 3, low[2] + 3}));
            }
    return mesh;
}

std::optional<PolygonMesh> make_scene(const std::string& name) {
    if (name == "sphere") return on_lattice(shapes::icosphere(8));
    if (name == "cubes") return on_lattice(cube_grid());
    const char* models = std::getenv("TRISECT_MODELS");
    std::filesystem::path path = models == nullptr ? "../shared/models" : models;
    if (name == "bunny") path /= "large/bunny100k.obj";
    if (name == "armadillo") path /= "large/armadillo.obj";
    if (name == "part") path /= "cad/1002_tray_bottom.STL";
    if (!std::filesystem::is_regular_file(path)) {
        std::fprintf(stderr, "compare_queries: no scene %s (%s), set TRISECT_MODELS\n",
                     name.c_str(), path.c_str());
        return std::nullopt;
    }
    return on_lattice(trisect::read_mesh(path));
}

class Maker {
public:
    explicit Maker(const PolygonMesh& mesh) : mesh_(mesh) {
        lo_.fill(HUGE_VAL);
        hi_.fill(-HUGE_VAL);
        for (const auto& p : mesh.points)
            for (std::size_t k = 0; k < 3; ++k) {
                lo_[k] = std::min(lo_[k], p[k]);
                hi_[k] = std::max(hi_[k], p[k]);
            }
    }

    [[nodiscard]] Point uniform() {
        Point p{};
        for (std::size_t k = 0; k < 3; ++k) p[k] = lo_[k] + (hi_[k] - lo_[k]) * random_.uniform();
        return p;
    }
    [[nodiscard]] Point near_surface() {
        Point p = combined(random_.uniform(), random_.uniform());
        for (std::size_t k = 0; k < 3; ++k)
            p[k] += (hi_[k] - lo_[k]) * 1e-3 * (2 * random_.uniform() - 1);
        return p;
    }
    /// Corners, points of edges and points of faces: with the lattice's spare bits, exactly.
    [[nodiscard]] Point exactly_on(std::size_t i) {
        if (i % 3 == 0) return combined(0, 0);
        if (i % 3 == 1) return combined(0, 0.25);
        return combined(0.25, 0.5);
    }
    [[nodiscard]] Ray ray() {
        const Point target = uniform();
        Point d{};
        double length = 0;
        do {
            for (double& x : d) x = 2 * random_.uniform() - 1;
            length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        } while (length > 1 || length < 0.1);
        const double size = std::max({hi_[0] - lo_[0], hi_[1] - lo_[1], hi_[2] - lo_[2]});
        Ray r;
        for (std::size_t k = 0; k < 3; ++k) {
            r.direction[k] = -d[k] / length;
            r.origin[k] = target[k] + d[k] / length * 2 * size;
        }
        return r;
    }

private:
    [[nodiscard]] Point combined(double u, double v) {
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        const auto f = mesh_.face(
            static_cast<std::size_t>(random_.uniform() * static_cast<double>(mesh_.face_count())));
        Point p{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double a = mesh_.points[f[0]][k];
            p[k] = a + u * (mesh_.points[f[1]][k] - a) + v * (mesh_.points[f[2]][k] - a);
        }
        return p;
    }

    const PolygonMesh& mesh_;
    shapes::Random random_{11};
    Point lo_{};
    Point hi_{};
};

void print(json row) {
    std::printf("%s\n", row.dump().c_str());
    std::fflush(stdout);
}

json row_of(const std::string& scene, const std::string& what, const std::string& engine,
            std::size_t count, double seconds) {
    return {{"scene", scene},
            {"what", what},
            {"engine", engine},
            {"count", count},
            {"ns", seconds * 1e9 / static_cast<double>(count)}};
}

json counted(const trisect::PredicateCounters& c, std::size_t count) {
    const auto each = [&](std::uint64_t n) {
        return static_cast<double>(n) / static_cast<double>(count);
    };
    return {{"symbolic", each(c.symbolic)},
            {"filtered", each(c.filtered)},
            {"exact_narrow", each(c.exact_narrow)},
            {"exact_wide", each(c.exact_wide)}};
}

Side to_side(Location l) {
    if (l == Location::Inside) return 1;
    return l == Location::Outside ? 0 : 2;
}

/// Of what CGAL says. An engine that cannot say "on" is not asked about such points.
std::size_t different(const std::vector<Side>& truth, const std::vector<Side>& sides,
                      bool without_on) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
        if (truth[i] != sides[i] && !(without_on && truth[i] == 2)) ++n;
    return n;
}

void compare_points(const std::string& scene, const std::string& what,
                    const std::vector<Point>& points, const BrepIndex& index,
                    const std::vector<std::unique_ptr<Peer>>& peers, const Options& options) {
    std::vector<Side> truth(points.size());
    std::vector<Side> sides(points.size());
    for (std::size_t i = 0; i < peers.size(); ++i) {
        auto& out = i == 0 ? truth : sides;
        const double t = median_seconds(options.runs, [&] { peers[i]->locate(points, out); });
        json row = row_of(scene, what, peers[i]->name(), points.size(), t);
        if (i != 0) row["different"] = different(truth, sides, true);
        print(row);
    }
    std::vector<Location> locations(points.size());
    std::vector<trisect::Place> places;
    const auto finish = [&](const char* name, double t) {
        for (std::size_t i = 0; i < points.size(); ++i) sides[i] = to_side(locations[i]);
        json row = row_of(scene, what, name, points.size(), t);
        if (!peers.empty()) row["different"] = different(truth, sides, false);
        return row;
    };
    const double batch = median_seconds(options.runs, [&] { index.classify(points, locations); });
    print(finish("Trisect batch", batch));
    trisect::predicate_counters() = {};
    const double single = median_seconds(options.runs, [&] {
        for (std::size_t i = 0; i < points.size(); ++i)
            locations[i] = index.locate(points[i]).location;
    });
    json row = finish("Trisect locate", single);
    row["signs"] = counted(trisect::predicate_counters(),
                           points.size() * static_cast<std::size_t>(options.runs));
    print(row);
}

void compare_rays(const std::string& scene, const std::vector<Ray>& rays, const BrepIndex& index,
                  const std::vector<std::unique_ptr<Peer>>& peers, const Options& options) {
    std::vector<std::int64_t> truth(rays.size());
    std::vector<std::int64_t> hits(rays.size());
    const auto differ = [&] {
        std::size_t n = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            if ((truth[i] < 0) != (hits[i] < 0)) ++n;
        return n;
    };
    for (std::size_t i = 0; i < peers.size(); ++i) {
        auto& out = i == 0 ? truth : hits;
        const double t = median_seconds(options.runs, [&] { peers[i]->first_hits(rays, out); });
        json row = row_of(scene, "first hit", peers[i]->name(), rays.size(), t);
        if (i != 0) row["different"] = differ();
        print(row);
    }
    trisect::predicate_counters() = {};
    const double t = median_seconds(options.runs, [&] {
        for (std::size_t i = 0; i < rays.size(); ++i)
            hits[i] = index.first_hit(trisect::Ray{rays[i].origin, rays[i].direction}) ? 0 : -1;
    });
    json row = row_of(scene, "first hit", "Trisect", rays.size(), t);
    if (!peers.empty()) row["different"] = differ();
    row["signs"] = counted(trisect::predicate_counters(),
                           rays.size() * static_cast<std::size_t>(options.runs));
    print(row);
}

void compare_distances(const std::string& scene, const std::vector<Point>& points,
                       const BrepIndex& index, const std::vector<std::unique_ptr<Peer>>& peers,
                       const Options& options) {
    std::vector<double> out(points.size());
    for (const auto& peer : peers) {
        if (peer->name() != "CGAL") continue;
        const double t =
            median_seconds(options.runs, [&] { peer->squared_distances(points, out); });
        print(row_of(scene, "distance", peer->name(), points.size(), t));
    }
    const double t = median_seconds(options.runs, [&] {
        for (std::size_t i = 0; i < points.size(); ++i)
            out[i] = index.nearest(points[i])->squared_rounded;
    });
    print(row_of(scene, "distance", "Trisect", points.size(), t));
}

void run(const std::string& name, const Options& options) {
    const auto mesh = make_scene(name);
    if (!mesh) return;
    const Solid solid = Solid::from_mesh(*mesh);
    std::vector<std::unique_ptr<Peer>> peers;
    if (options.peers) {
        peers.push_back(query_peers::make_cgal(*mesh));
#if defined(TRISECT_WITH_EMBREE)
        peers.push_back(query_peers::make_embree(*mesh, false));
        peers.push_back(query_peers::make_embree(*mesh, true));
#endif
        for (const auto& p : peers)
            print({{"scene", name},
                   {"what", "build"},
                   {"engine", p->name()},
                   {"triangles", mesh->face_count()},
                   {"ms", p->build_seconds() * 1e3}});
    }
    std::optional<BrepIndex> index;
    const double build = median_seconds(options.runs, [&] { index.emplace(solid); });
    const trisect::IndexStats s = index->stats();
    print({{"scene", name},
           {"what", "build"},
           {"engine", "Trisect"},
           {"triangles", s.polygons},
           {"ms", build * 1e3},
           {"nodes", s.nodes},
           {"mixed", s.mixed_leaves},
           {"empty", s.empty_leaves},
           {"listed", s.listed},
           {"depth", s.depth},
           {"bytes_per_triangle", s.bytes_per_polygon}});
    Maker make(*mesh);
    std::vector<Point> points(options.points);
    for (Point& p : points) p = make.uniform();
    compare_points(name, "uniform", points, *index, peers, options);
    for (Point& p : points) p = make.near_surface();
    compare_points(name, "near", points, *index, peers, options);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = make.exactly_on(i);
    compare_points(name, "on", points, *index, peers, options);
    std::vector<Ray> rays(options.points / 3);
    for (Ray& r : rays) r = make.ray();
    compare_rays(name, rays, *index, peers, options);
    points.resize(options.points / 100);
    for (Point& p : points) p = make.uniform();
    compare_distances(name, points, *index, peers, options);
}

Options parse(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string arg = argv[i];
        if (arg == "--no-peers") {
            options.peers = false;
            continue;
        }
        if (i + 1 == argc) throw std::runtime_error("value missing after " + arg);
        const std::string value = argv[++i];
        if (arg == "--runs") {
            options.runs = std::stoi(value);
        } else if (arg == "--points") {
            options.points = std::stoul(value);
        } else if (arg == "--scene") {
            options.scenes.push_back(value);
        } else {
            throw std::runtime_error("unknown option " + arg);
        }
    }
    if (options.scenes.empty()) options.scenes = {"bunny", "armadillo", "part", "sphere", "cubes"};
    return options;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Options options = parse(argc, argv);
        const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism,
                                              1);
        for (const std::string& scene : options.scenes) run(scene, options);
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "compare_queries: %s\n", e.what());
        return 2;
    }
}
