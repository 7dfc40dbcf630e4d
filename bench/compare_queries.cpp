// SPDX-License-Identifier: Apache-2.0
//
// Queries beside CGAL (Side_of_triangle_mesh, AABB_tree) and Embree (single precision) on identical
// doubles, in one process and on one thread but for one row; times are what the thread had of a
// processor. No point is asked twice of a row. Prints a
// line of JSON for every scene, kind of point and engine. Every answer is compared with CGAL's,
// which is exact for these predicates.
//
//     compare_queries [--runs 3] [--points 300000] [--scene NAME]... [--what KIND]... [--no-peers]
//
// Scenes: bunny, armadillo (100k triangles, folder large/ of TRISECT_MODELS), part (a tray with
// pockets, folder cad/), sphere (1.3 million triangles) and cubes (the union of 10 x 10 x 10 cubes
// with gaps, 12,000 triangles). Points: uniform in the box, near the surface (a facet's point moved
// by up to a thousandth of the box), and exactly on corners, edges and faces. Rays: from points
// around the box to points in it. Kinds: uniform, near, on, rays, distances.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <nlohmann/json.hpp>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/validate/defect.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/query/index/index_counters.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/diagnostics.h>

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
    std::vector<std::string> what;  // all when empty
    bool peers = true;

    [[nodiscard]] bool wants(const std::string& kind) const {
        return what.empty() || std::ranges::find(what, kind) != what.end();
    }
};

double median(std::vector<double> times) {
    std::ranges::sort(times);
    return times[times.size() / 2];
}

double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// work(run) several times.
double median_seconds(int runs, const std::function<void(int)>& work,
                      double (*clock)() = thread_seconds) {
    std::vector<double> times;
    for (int i = 0; i < runs; ++i) {
        const double start = clock();
        work(i);
        times.push_back(clock() - start);
    }
    return median(times);
}

/// What is asked in one run after the other: never the same twice, since the index learns.
template <class T>
std::span<const T> part_of(const std::vector<T>& all, int run, int runs) {
    const std::size_t n = all.size() / static_cast<std::size_t>(runs);
    return std::span(all).subspan(static_cast<std::size_t>(run) * n, n);
}
template <class T>
std::span<T> part_of(std::vector<T>& all, int run, int runs) {
    const std::size_t n = all.size() / static_cast<std::size_t>(runs);
    return std::span(all).subspan(static_cast<std::size_t>(run) * n, n);
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

/// What part of the points was located how.
json ways(const trisect::detail::IndexCounters& c, std::size_t count) {
    const auto part = [&](std::uint64_t n) {
        return static_cast<double>(n) / static_cast<double>(count);
    };
    return {{"empty", part(c.empty)},   {"side", part(c.side)},     {"region", part(c.region)},
            {"corner", part(c.corner)}, {"traced", part(c.traced)}, {"exact", part(c.exact)},
            {"on", part(c.on)}};
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
                    const std::vector<Point>& points, const Solid& solid,
                    const std::vector<std::unique_ptr<Peer>>& peers, const Options& options) {
    const int runs = options.runs;
    const std::size_t each = points.size() / static_cast<std::size_t>(runs);
    std::vector<Side> truth(points.size());
    std::vector<Side> sides(points.size());
    for (std::size_t i = 0; i < peers.size(); ++i) {
        auto& out = i == 0 ? truth : sides;
        const double t = median_seconds(runs, [&](int run) {
            peers[i]->locate(part_of(points, run, runs), part_of(out, run, runs));
        });
        json row = row_of(scene, what, peers[i]->name(), each, t);
        if (i != 0) row["different"] = different(truth, sides, true);
        print(row);
    }
    std::vector<Location> locations(points.size());
    const auto finish = [&](const char* name, double t) {
        for (std::size_t i = 0; i < points.size(); ++i) sides[i] = to_side(locations[i]);
        json row = row_of(scene, what, name, each, t);
        if (!peers.empty()) row["different"] = different(truth, sides, false);
        return row;
    };
    // Indices of their own, since they learn from what they are asked.
    const auto refined = [&] {
        BrepIndex fresh(solid);
        fresh.refine();
        return fresh;
    };
    const double first = median_seconds(1, [&](int) {
        const BrepIndex fresh(solid);
        fresh.classify(part_of(points, 0, runs), part_of(locations, 0, runs));
    });
    print(row_of(scene, what, "Trisect build and first batch", each, first));
    const BrepIndex index = refined();
    const double batch = median_seconds(runs, [&](int run) {
        index.classify(part_of(points, run, runs), part_of(locations, run, runs));
    });
    print(finish("Trisect batch", batch));
    for (const unsigned threads : {1U, 2U}) {
        const BrepIndex other = refined();
        print(finish(threads == 1 ? "Trisect batch, wall" : "Trisect batch, wall, 2 threads",
                     median_seconds(
                         runs,
                         [&](int run) {
                             other.classify(part_of(points, run, runs),
                                            part_of(locations, run, runs), threads);
                         },
                         wall_seconds)));
    }
    const trisect::Diagnostics<trisect::PredicateCounters> diagnostics;
    trisect::detail::index_counters() = {};
    const BrepIndex other = refined();
    const double single = median_seconds(runs, [&](int run) {
        const auto asked = part_of(points, run, runs);
        const auto out = part_of(locations, run, runs);
        for (std::size_t i = 0; i < asked.size(); ++i) out[i] = other.locate(asked[i]).location;
    });
    json row = finish("Trisect locate", single);
    const std::size_t asked = each * static_cast<std::size_t>(runs);
    row["signs"] = counted(diagnostics.counters(), asked);
    row["ways"] = ways(trisect::detail::index_counters(), asked);
    print(row);
}

void compare_rays(const std::string& scene, const std::vector<Ray>& rays, const BrepIndex& index,
                  const std::vector<std::unique_ptr<Peer>>& peers, const Options& options) {
    const int runs = options.runs;
    const std::size_t each = rays.size() / static_cast<std::size_t>(runs);
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
        const double t = median_seconds(runs, [&](int run) {
            peers[i]->first_hits(part_of(rays, run, runs), part_of(out, run, runs));
        });
        json row = row_of(scene, "first hit", peers[i]->name(), each, t);
        if (i != 0) row["different"] = differ();
        print(row);
    }
    const auto ask = [&](const char* name, const auto& hit) {
        const trisect::Diagnostics<trisect::PredicateCounters> diagnostics;
        const double t = median_seconds(runs, [&](int run) {
            const auto asked = part_of(rays, run, runs);
            const auto out = part_of(hits, run, runs);
            for (std::size_t i = 0; i < asked.size(); ++i)
                out[i] = hit(trisect::Ray{asked[i].origin, asked[i].direction}) ? 0 : -1;
        });
        json row = row_of(scene, "first hit", name, each, t);
        if (!peers.empty()) row["different"] = differ();
        row["signs"] = counted(diagnostics.counters(), each * static_cast<std::size_t>(runs));
        print(row);
    };
    ask("Trisect", [&](const trisect::Ray& r) { return index.first_hit(r).has_value(); });
    ask("Trisect facet", [&](const trisect::Ray& r) { return index.first_facet(r).has_value(); });
}

void compare_distances(const std::string& scene, const std::vector<Point>& points,
                       const BrepIndex& index, const std::vector<std::unique_ptr<Peer>>& peers,
                       const Options& options) {
    const int runs = options.runs;
    const std::size_t each = points.size() / static_cast<std::size_t>(runs);
    std::vector<double> out(points.size());
    for (const auto& peer : peers) {
        if (peer->name() != "CGAL") continue;
        const double t = median_seconds(runs, [&](int run) {
            peer->squared_distances(part_of(points, run, runs), part_of(out, run, runs));
        });
        print(row_of(scene, "distance", peer->name(), each, t));
    }
    const double t = median_seconds(runs, [&](int run) {
        const auto asked = part_of(points, run, runs);
        for (std::size_t i = 0; i < asked.size(); ++i)
            out[i] = index.nearest(asked[i])->squared_rounded;
    });
    print(row_of(scene, "distance", "Trisect", each, t));
    const double b = median_seconds(runs, [&](int run) {
        const auto asked = part_of(points, run, runs);
        for (std::size_t i = 0; i < asked.size(); ++i) out[i] = index.distance(asked[i])->hi;
    });
    print(row_of(scene, "distance", "Trisect bounds", each, b));
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
    const double build = median_seconds(options.runs, [&](int) { index.emplace(solid); });
    std::vector<double> refine;
    for (int i = 0; i < options.runs; ++i) {
        index.emplace(solid);
        refine.push_back(median_seconds(1, [&](int) { index->refine(); }));
    }
    const trisect::IndexStats s = index->stats();
    print({{"scene", name},
           {"what", "build"},
           {"engine", "Trisect"},
           {"triangles", s.polygons},
           {"ms", build * 1e3},
           {"refine_ms", median(refine) * 1e3},
           {"nodes", s.nodes},
           {"mixed", s.mixed_leaves},
           {"empty", s.empty_leaves},
           {"listed", s.listed},
           {"depth", s.depth},
           {"bytes_per_triangle", s.bytes_per_polygon}});
    Maker make(*mesh);
    std::vector<Point> points(options.points * static_cast<std::size_t>(options.runs));
    for (Point& p : points) p = make.uniform();
    if (options.wants("uniform")) compare_points(name, "uniform", points, solid, peers, options);
    for (Point& p : points) p = make.near_surface();
    if (options.wants("near")) compare_points(name, "near", points, solid, peers, options);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = make.exactly_on(i);
    if (options.wants("on")) compare_points(name, "on", points, solid, peers, options);
    std::vector<Ray> rays(points.size() / 3);
    for (Ray& r : rays) r = make.ray();
    if (options.wants("rays")) compare_rays(name, rays, *index, peers, options);
    points.resize(points.size() / 100);
    for (Point& p : points) p = make.uniform();
    if (options.wants("distances")) compare_distances(name, points, *index, peers, options);
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
        } else if (arg == "--what") {
            options.what.push_back(value);
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
        const oneapi::tbb::global_control two(oneapi::tbb::global_control::max_allowed_parallelism,
                                              2);
        for (const std::string& scene : options.scenes) run(scene, options);
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "compare_queries: %s\n", e.what());
        return 2;
    }
}
