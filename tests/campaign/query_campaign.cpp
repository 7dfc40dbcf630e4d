// SPDX-License-Identifier: Apache-2.0
//
// Queries of an index against brute force in rationals: places of points, a third of them exactly
// on corners, edges and faces and others on planes of faces and walls of cells, and hits of rays
// through such points. Models are spheres, blocks, sponges and random solids on a small grid, fresh
// and as results of booleans. Prints a line for every model; exits with 1 at the first difference.
//
// Made models have coordinates of 40 bits, so that points of edges and faces are doubles. Files are
// added as fresh solids, twice: with all their digits, and with coordinates of 40 bits; those that
// are not closed are passed over. A run that was interrupted goes on with --first.
//
// With --fractions 1 each model is also put on lattices whose units are 2^8, 2^24, 2^56 and 2^70
// times as large, as far as its coordinates then have no more bits behind the point than a
// coordinate may have. It is the same solid, so all answers have to be the same, with all names.
//
//     query_campaign [--points 1000] [--rays 200] [--models 24] [--first 0] [--seed 1]
//                    [--fractions 0] [FILE]...

#include <algorithm>
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
#include "support/fractions.h"
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
    bool fractions = false;
    std::vector<std::string> files;
};

constexpr std::array exponents_of_coarser_lattices{8, 24, 56, 70};

struct Model {
    std::string name;
    Solid solid;
    std::vector<Solid> coarser;  // the same solid on coarser lattices
    LatticeMesh mesh;            // to make points from, in lattice units
    brute::Boundary boundary;
    bool named = false;
};

// Whether coordinates have bits enough for a unit 2^bits times as large.
bool fits_coarser(const LatticeMesh& mesh, int bits) {
    const auto fits = [bits](trisect::Coordinate c) {
        const double last = std::ldexp(c.to_double(), trisect::fraction_limit - bits);
        return last == std::trunc(last);
    };
    return std::ranges::all_of(mesh.points,
                               [&](const auto& p) { return fits(p.x) && fits(p.y) && fits(p.z); });
}

Model fresh(const std::string& name, LatticeMesh mesh, bool fractions) {
    mesh.lattice = {};  // so that points in lattice units are points in the user's units
    const Solid solid = Solid::from_lattice_mesh(mesh);
    std::vector<Solid> coarser;
    for (const int bits : exponents_of_coarser_lattices)
        if (fractions && fits_coarser(mesh, bits))
            coarser.push_back(Solid::from_lattice_mesh(trisect::test::with_fractions(mesh, bits)));
    return {name, solid, coarser, mesh, brute::Boundary::of_mesh(mesh, solid.source_id()), true};
}

LatticeMesh imported(const trisect::PolygonMesh& mesh) { return import_mesh(mesh).mesh; }

// With coordinates of 40 bits: eighths of their sums are doubles.
LatticeMesh imported_rounded(trisect::PolygonMesh mesh) {
    double largest = 0;
    for (const auto& p : mesh.points)
        for (const double c : p) largest = std::max(largest, std::fabs(c));
    const int unit = std::ilogb(largest) - 39;
    for (auto& p : mesh.points)
        for (double& c : p) c = std::ldexp(std::nearbyint(std::ldexp(c, -unit)), unit);
    return imported(mesh);
}

Model result(std::uint64_t seed, bool fractions) {
    brute::RandomResult r = brute::random_result(seed, 4, true);
    std::vector<Solid> coarser;
    for (const int bits : exponents_of_coarser_lattices)
        if (fractions) coarser.push_back(brute::random_result_solid(seed, 4, true, bits));
    return {"result " + std::to_string(seed),
            std::move(r.solid),
            std::move(coarser),
            std::move(r.mesh),
            std::move(r.boundary),
            false};
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
std::optional<Model> of_file(const std::string& path, bool rounded, bool fractions) {
    try {
        const std::size_t slash = path.rfind('/');
        const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
        trisect::PolygonMesh mesh = trisect::read_mesh(path);
        return rounded ? fresh(name + " to 40 bits", imported_rounded(std::move(mesh)), fractions)
                       : fresh(name, imported(mesh), fractions);
    } catch (const std::exception& e) {
        std::printf("%s: passed over: %s\n", path.c_str(), e.what());
        return std::nullopt;
    }
}

Model make_model(std::uint64_t i, std::uint64_t seed, bool fractions) {
    const auto made = [&](const std::string& name, LatticeMesh mesh) {
        return fresh(name, std::move(mesh), fractions);
    };
    switch (i) {
        case 0:
            return made("sphere of 1280", imported_rounded(shapes::icosphere(3)));
        case 1:
            return made("sphere of 5120", imported_rounded(shapes::icosphere(4)));
        case 2:
            return made("block of 1200", imported_rounded(shapes::block({0, 0, 0}, {7, 5, 3}, 10)));
        case 3:
            return made("turned block",
                        imported_rounded(shapes::turned(shapes::block({0, 0, 0}, {7, 5, 3}, 6))));
        case 4:
            return made("bars", imported_rounded(shapes::menger_bars(2, 0)));
        case 5:
            return made("block with two cavities that touch", with_cavities());
        case 6:
            return made("blocks that touch in an edge and a corner", touching_blocks());
        default:
            break;
    }
    if (i % 2 == 0) {
        reference::Random random(seed + i);
        return made("solid " + std::to_string(seed + i),
                    engines::lattice_mesh(reference::random_embedded_solid(random)));
    }
    return result(seed + i, fractions);
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

// The operands of two solids have different names. Of facets that coincide any may speak for all,
// in each cell another one, and cells differ between lattices: then only what is not a matter of
// names is compared.
bool same(const trisect::Place& a, const trisect::Place& b, bool named) {
    if (!named) return a.location == b.location && a.face_count == b.face_count;
    bool faces = a.face_count == b.face_count;
    for (std::size_t i = 0; faces && i < a.face_count; ++i)
        faces = a.faces[i].face == b.faces[i].face;
    return faces && a.location == b.location && a.corner.corner == b.corner.corner &&
           a.face == b.face && a.edge == b.edge && a.vertex == b.vertex;
}

bool same(const std::vector<trisect::RayHit>& a, const std::vector<trisect::RayHit>& b,
          bool named) {
    return std::ranges::equal(a, b, [&](const trisect::RayHit& x, const trisect::RayHit& y) {
        return x.enter.exact() == y.enter.exact() && x.leave.exact() == y.leave.exact() &&
               x.is_interval == y.is_interval && same(x.place, y.place, named);
    });
}

void print_point(const char* what, const std::array<double, 3>& p) {
    std::printf("%s %.17g %.17g %.17g\n", what, p[0], p[1], p[2]);
}

// Many points at once are where each of them is.
bool same_at_once(const Solid& solid, const std::vector<std::array<double, 3>>& points,
                  const std::vector<trisect::Place>& places, bool named) {
    const BrepIndex index(solid);
    std::vector<trisect::Location> found(points.size());
    index.classify(points, found);
    const std::vector<trisect::Place> again = index.locate(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (found[i] == places[i].location && same(again[i], places[i], named)) continue;
        print_point("one of many points", points[i]);
        return false;
    }
    return true;
}

class Run {
public:
    Run(const Model& m, std::uint64_t seed) : m_(m), index_(m.solid), make_(m.mesh, seed) {
        for (const Solid& solid : m.coarser) coarser_.emplace_back(solid);
    }

    // False at the first difference, which is printed.
    bool points(int count);
    bool rays(int count);
    void print_counts(const Options& o) const;

private:
    std::array<double, 3> point(int i);
    bool right_place(const std::array<double, 3>& p, const trisect::Place& place) const;
    bool right_hits(const trisect::Ray& ray, const std::vector<trisect::RayHit>& found) const;
    bool right_first_hit(const BrepIndex& index, const trisect::Ray& ray,
                         const std::vector<brute::Hit>& expected) const;

    const Model& m_;
    BrepIndex index_;
    std::vector<BrepIndex> coarser_;
    brute::PointMaker make_;
    std::array<int, 5> counts_{};
    std::size_t hits_ = 0;
    std::size_t intervals_ = 0;
};

std::array<double, 3> Run::point(int i) {
    const std::array<double, 3> p = make_.any();
    if (i % 8 != 0) return p;
    // A cell of each index in turn.
    const auto which = static_cast<std::size_t>(i / 8) % (coarser_.size() + 1);
    return onto_wall(which == 0 ? index_ : coarser_[which - 1], p, make_.random());
}

bool Run::right_place(const std::array<double, 3>& p, const trisect::Place& place) const {
    const brute::Answer answer = m_.boundary.locate(brute::point(p));
    if (!brute::agrees(place, answer, m_.named)) {
        print_point("point", p);
        std::printf("%s instead of %s\n", brute::to_string(place).c_str(),
                    brute::to_string(answer).c_str());
        return false;
    }
    for (std::size_t i = 0; i < coarser_.size(); ++i) {
        const trisect::Place other = coarser_[i].locate(p);
        if (same(place, other, m_.named)) continue;
        print_point("point", p);
        std::printf("%s, on a lattice of exponent %d %s\n", brute::to_string(place).c_str(),
                    m_.coarser[i].lattice().exponent, brute::to_string(other).c_str());
        return false;
    }
    return true;
}

bool Run::points(int count) {
    std::vector<std::array<double, 3>> points;
    std::vector<trisect::Place> places;
    for (int i = 0; i < count; ++i) {
        const std::array<double, 3> p = point(i);
        const trisect::Place place = index_.locate(p);
        ++counts_[static_cast<std::size_t>(place.location)];
        points.push_back(p);
        places.push_back(place);
        if (!right_place(p, place)) return false;
    }
    if (!same_at_once(m_.solid, points, places, true)) return false;
    return std::ranges::all_of(m_.coarser, [&](const Solid& solid) {
        return same_at_once(solid, points, places, m_.named);
    });
}

bool Run::right_first_hit(const BrepIndex& index, const trisect::Ray& ray,
                          const std::vector<brute::Hit>& expected) const {
    const auto first = index.first_hit(ray);
    const auto facet = index.first_facet(ray);
    if (first.has_value() == expected.empty() || facet.has_value() == expected.empty())
        return false;
    if (!first) return true;
    return brute::rational(first->enter.exact()) == expected.front().enter &&
           facet->face == first->place.faces[0] &&
           brute::Rational(facet->lo) <= expected.front().enter &&
           expected.front().enter <= brute::Rational(facet->hi);
}

bool Run::right_hits(const trisect::Ray& ray, const std::vector<trisect::RayHit>& found) const {
    const auto expected =
        m_.boundary.hits(brute::point(ray.origin), brute::point(ray.direction), false);
    const auto first = index_.first_hit(ray);
    if (!same_hits(found, expected, m_.named) || !right_first_hit(index_, ray, expected) ||
        (first && !same_hits({*first}, {expected.front()}, m_.named)))
        return false;
    return std::ranges::all_of(coarser_, [&](const BrepIndex& index) {
        const auto other = index.first_hit(ray);
        return same(index.all_hits(ray), found, m_.named) &&
               right_first_hit(index, ray, expected) &&
               (!other || same(other->place, first->place, m_.named));
    });
}

bool Run::rays(int count) {
    for (int i = 0; i < count; ++i) {
        const std::array<double, 3> from = make_.any();
        const std::array<double, 3> to = make_.any();
        const trisect::Ray ray{from, {to[0] - from[0], to[1] - from[1], to[2] - from[2]}};
        if (ray.direction == std::array<double, 3>{}) continue;
        const auto found = index_.all_hits(ray);
        for (const auto& h : found) {
            ++hits_;
            intervals_ += h.is_interval ? 1 : 0;
        }
        if (right_hits(ray, found)) continue;
        print_point("ray from", from);
        print_point("direction", ray.direction);
        return false;
    }
    return true;
}

void Run::print_counts(const Options& o) const {
    std::printf(
        "%s: %zu polygons; outside %d, face %d, edge %d, vertex %d, inside %d; %d rays, "
        "%zu hits, %zu of them intervals: equal",
        m_.name.c_str(), index_.stats().polygons, counts_[0], counts_[1], counts_[2], counts_[3],
        counts_[4], o.rays, hits_, intervals_);
    if (o.fractions) std::printf(", also on %zu coarser lattices", coarser_.size());
    std::printf("\n");
    std::fflush(stdout);
}

bool run(const Model& m, const Options& o, std::uint64_t seed) {
    Run run(m, seed);
    if (!run.points(o.points) || !run.rays(o.rays)) return false;
    run.print_counts(o);
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
        } else if (arg == "--fractions") {
            o.fractions = value != 0;
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
        for (std::uint64_t i = o.first; i < o.models + 2 * o.files.size(); ++i) {
            const std::uint64_t file = i - o.models;
            const std::optional<Model> m =
                i < o.models ? make_model(i, o.seed, o.fractions)
                             : of_file(o.files[file / 2], file % 2 != 0, o.fractions);
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
