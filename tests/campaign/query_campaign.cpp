// SPDX-License-Identifier: Apache-2.0
//
// Queries of an index against brute force in rationals: places of points, a third of them exactly
// on corners, edges and faces and others on planes of faces and walls of cells, and hits of rays
// through such points. Models are spheres, blocks, sponges and random solids on a small grid, fresh
// and as results of booleans. Prints a line for every model; exits with 1 at the first difference.
//
// Files are added as fresh solids; those that are not closed are passed over. A run that was
// interrupted goes on with --first.
//
//     query_campaign [--points 1000] [--rays 200] [--models 24] [--first 0] [--seed 1] [FILE]...

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>

#include "bench/shapes.h"
#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/lattice_arithmetic.h"
#include "support/query_oracle.h"
#include "support/random_result.h"

namespace {

using trisect::BrepIndex;
using trisect::LatticeMesh;
using trisect::Solid;

struct Options {
    int points = 1000;
    int rays = 200;
    std::uint64_t models = 24;
    std::uint64_t first = 0;
    std::uint64_t seed = 1;
    std::vector<std::string> files;
};

struct Model {
    std::string name;
    Solid solid;
    LatticeMesh mesh;  // to make points from, in lattice units
    brute::Boundary boundary;
    bool named = false;
};

Model fresh(const std::string& name, LatticeMesh mesh) {
    mesh.lattice = {};  // so that points in lattice units are points in the user's units
    const Solid solid = Solid::from_lattice_mesh(mesh);
    return {name, solid, mesh, brute::Boundary::of_mesh(mesh, solid.source_id()), true};
}

LatticeMesh imported(const trisect::PolygonMesh& mesh) { return import_mesh(mesh).mesh; }

Model result(std::uint64_t seed) {
    brute::RandomResult r = brute::random_result(seed, 4, true);
    return {"result " + std::to_string(seed), std::move(r.solid), std::move(r.mesh),
            std::move(r.boundary), false};
}

LatticeMesh turned_inside_out(LatticeMesh mesh) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

void append(LatticeMesh& mesh, const LatticeMesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (const auto& [a, b, c] : other.triangles)
        mesh.triangles.push_back({a + first, b + first, c + first});
}

LatticeMesh block(const std::array<int, 3>& lo, const std::array<int, 3>& hi) {
    const auto point = [](const std::array<int, 3>& p) {
        return trisect::Point3d{static_cast<double>(p[0]), static_cast<double>(p[1]),
                                static_cast<double>(p[2])};
    };
    LatticeMesh mesh = imported(shapes::block(point(lo), point(hi), 3));
    // In the common unit of all blocks here.
    for (auto& p : mesh.points)
        for (int k = 0; k < 3; ++k) {
            const double v = std::ldexp(p[k].to_double(), mesh.lattice.exponent) * 8;
            (k == 0 ? p.x : (k == 1 ? p.y : p.z)) = static_cast<std::int64_t>(v);
        }
    return mesh;
}

LatticeMesh with_cavities() {
    LatticeMesh mesh = block({0, 0, 0}, {12, 12, 12});
    append(mesh, turned_inside_out(block({3, 3, 3}, {6, 6, 6})));
    append(mesh, turned_inside_out(block({6, 6, 6}, {9, 9, 9})));
    return mesh;
}

LatticeMesh touching_blocks() {
    LatticeMesh mesh = block({0, 0, 0}, {3, 3, 3});
    append(mesh, block({3, 3, 0}, {6, 6, 3}));
    append(mesh, block({6, 6, 3}, {9, 9, 6}));
    append(mesh, block({0, 3, 3}, {3, 6, 6}));
    return mesh;
}

/// Nothing for a file that is no closed mesh.
std::optional<Model> of_file(const std::string& path) {
    try {
        const std::size_t slash = path.rfind('/');
        return fresh(slash == std::string::npos ? path : path.substr(slash + 1),
                     imported(trisect::read_mesh(path)));
    } catch (const std::exception& e) {
        std::printf("%s: passed over: %s\n", path.c_str(), e.what());
        return std::nullopt;
    }
}

Model make_model(std::uint64_t i, std::uint64_t seed) {
    switch (i) {
        case 0:
            return fresh("sphere of 1280", imported(shapes::icosphere(3)));
        case 1:
            return fresh("sphere of 5120", imported(shapes::icosphere(4)));
        case 2:
            return fresh("block of 1200", imported(shapes::block({0, 0, 0}, {7, 5, 3}, 10)));
        case 3:
            return fresh("turned block",
                         imported(shapes::turned(shapes::block({0, 0, 0}, {7, 5, 3}, 6))));
        case 4:
            return fresh("bars", imported(shapes::menger_bars(2, 0)));
        case 5:
            return fresh("block with two cavities that touch", with_cavities());
        case 6:
            return fresh("blocks that touch in an edge and a corner", touching_blocks());
        default:
            break;
    }
    if (i % 2 == 0) {
        reference::Random random(seed + i);
        return fresh("solid " + std::to_string(seed + i),
                     engines::lattice_mesh(reference::random_embedded_solid(random)));
    }
    return result(seed + i);
}

std::array<double, 3> onto_wall(const BrepIndex& index, std::array<double, 3> p,
                                reference::Random& random) {
    const trisect::IndexCell cell = index.cell_at(p);
    const std::size_t k = random.below(3);
    const double wall = random.chance(1, 2) ? cell.lo[k] : cell.hi[k];
    if (std::fabs(wall) < 0x1p50) p[k] = wall;
    return p;
}

bool same_hits(const std::vector<trisect::RayHit>& a, const std::vector<brute::Hit>& b,
               bool named) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (brute::rational(a[i].enter.exact()) != b[i].enter ||
            brute::rational(a[i].leave.exact()) != b[i].leave ||
            !brute::agrees(a[i].place, b[i].answer, named))
            return false;
    return true;
}

void print_point(const char* what, const std::array<double, 3>& p) {
    std::printf("%s %.17g %.17g %.17g\n", what, p[0], p[1], p[2]);
}

/// Many points at once are where each of them is.
bool same_at_once(const Solid& solid, const std::vector<std::array<double, 3>>& points,
                  const std::vector<trisect::Place>& places) {
    const BrepIndex index(solid);
    std::vector<trisect::Location> found(points.size());
    index.classify(points, found);
    const std::vector<trisect::Place> named = index.locate(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (found[i] == places[i].location && named[i] == places[i]) continue;
        print_point("one of many points", points[i]);
        return false;
    }
    return true;
}

bool run(const Model& m, const Options& o, std::uint64_t seed) {
    const BrepIndex index(m.solid);
    brute::PointMaker make(m.mesh, seed);
    std::array<int, 5> counts{};
    std::vector<std::array<double, 3>> points;
    std::vector<trisect::Place> places;
    for (int i = 0; i < o.points; ++i) {
        std::array<double, 3> p = make.any();
        if (i % 8 == 0) p = onto_wall(index, p, make.random());
        const trisect::Place place = index.locate(p);
        const brute::Answer answer = m.boundary.locate(brute::point(p));
        ++counts[static_cast<std::size_t>(place.location)];
        points.push_back(p);
        places.push_back(place);
        if (brute::agrees(place, answer, m.named)) continue;
        print_point("point", p);
        std::printf("%s instead of %s\n", brute::to_string(place).c_str(),
                    brute::to_string(answer).c_str());
        return false;
    }
    if (!same_at_once(m.solid, points, places)) return false;
    std::size_t hits = 0;
    std::size_t intervals = 0;
    for (int i = 0; i < o.rays; ++i) {
        const std::array<double, 3> from = make.any();
        const std::array<double, 3> to = make.any();
        trisect::Ray ray{from, {to[0] - from[0], to[1] - from[1], to[2] - from[2]}};
        if (ray.direction == std::array<double, 3>{}) continue;
        const auto found = index.all_hits(ray);
        const auto expected =
            m.boundary.hits(brute::point(from), brute::point(ray.direction), false);
        const auto first = index.first_hit(ray);
        const auto facet = index.first_facet(ray);
        for (const auto& h : found) {
            ++hits;
            intervals += h.is_interval ? 1 : 0;
        }
        if (same_hits(found, expected, m.named) && first.has_value() == !expected.empty() &&
            (!first || same_hits({*first}, {expected.front()}, m.named)) &&
            facet.has_value() == first.has_value() &&
            (!facet || (facet->face == first->place.faces[0] &&
                        brute::Rational(facet->lo) <= expected.front().enter &&
                        expected.front().enter <= brute::Rational(facet->hi))))
            continue;
        print_point("ray from", from);
        print_point("direction", ray.direction);
        return false;
    }
    std::printf(
        "%s: %zu polygons; outside %d, face %d, edge %d, vertex %d, inside %d; %d rays, "
        "%zu hits, %zu of them intervals: equal\n",
        m.name.c_str(), index.stats().polygons, counts[0], counts[1], counts[2], counts[3],
        counts[4], o.rays, hits, intervals);
    std::fflush(stdout);
    return true;
}

Options parse(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string arg = argv[i];
        if (!arg.starts_with("--")) {
            o.files.push_back(arg);
            continue;
        }
        if (i + 1 == argc) throw std::runtime_error("value missing after " + arg);
        const long value = std::atol(argv[++i]);
        if (arg == "--points") {
            o.points = static_cast<int>(value);
        } else if (arg == "--rays") {
            o.rays = static_cast<int>(value);
        } else if (arg == "--models") {
            o.models = static_cast<std::uint64_t>(value);
        } else if (arg == "--first") {
            o.first = static_cast<std::uint64_t>(value);
        } else if (arg == "--seed") {
            o.seed = static_cast<std::uint64_t>(value);
        } else {
            throw std::runtime_error("unknown option " + arg);
        }
    }
    return o;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Options o = parse(argc, argv);
        for (std::uint64_t i = o.first; i < o.models + o.files.size(); ++i) {
            const std::optional<Model> m =
                i < o.models ? make_model(i, o.seed)
                             : of_file(o.files[static_cast<std::size_t>(i - o.models)]);
            if (m && !run(*m, o, o.seed + i)) {
                std::printf("%s: DIFFERENT\n", m->name.c_str());
                return 1;
            }
        }
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "query_campaign: %s\n", e.what());
        return 2;
    }
}
