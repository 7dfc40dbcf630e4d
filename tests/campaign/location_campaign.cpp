// SPDX-License-Identifier: Apache-2.0
//
// Places of points on real meshes, on the doubles of the files: the index of the imported solid
// against brute force in rationals and against CGAL.
//
// The boundary of the oracles is made of the file's doubles, not of what import keeps of them.
// Points: own vertices, midpoints of edges that are doubles, points moved by one ulp off a vertex,
// off the middle of an edge or off a face, and uniform ones. Brute force (tests/support) gives the
// place with the names of faces, under the positive winding rule; CGAL's Side_of_triangle_mesh with
// exact predicates the side, where the mesh does not meet itself. One that does is resolved: off
// all its polygons places are those of brute force; on a polygon that is no boundary the place is
// that of points around it.
//
//     location_campaign [--points N] [--files N] [--least-triangles T] [--most-triangles T]
//                       [--seed S] [PATH...]
//
// N points for each of the first closed triangle meshes below the paths, smallest files first;
// without a path a sphere and a torus. Prints a row a file; exits with 1 at the first difference.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/interop/cgal.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/lattice.h>

#include "reference/random_solids.h"
#include "support/query_oracle.h"

namespace {

using trisect::Location;
using trisect::Point3d;
using trisect::PolygonMesh;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using SideOf = CGAL::Side_of_triangle_mesh<Mesh, Kernel>;

struct Options {
    std::size_t points = 1000;
    std::size_t files = 40;
    std::size_t least_triangles = 1;
    std::size_t most_triangles = 30000;
    std::uint64_t seed = 1;
    std::vector<std::string> paths;
};

struct Model {
    std::string name;
    PolygonMesh mesh;
    trisect::LatticeMesh imported;
    bool embedded = false;
};

struct Totals {
    std::size_t files = 0, fractions = 0, points = 0, sides = 0, resolved = 0, covered = 0;
    std::array<std::size_t, 5> located{};  // by Location
    std::array<std::size_t, 6> kinds{};
};

// Points -----------------------------------------------------------------------------------------

enum class Kind : std::uint8_t { Vertex, Middle, NearVertex, NearMiddle, NearFace, Uniform };

class Points {
public:
    Points(const PolygonMesh& mesh, std::uint64_t seed) : mesh_(mesh), random_(seed) {
        lo_ = hi_ = mesh.points[mesh.corners[0]];
        for (const std::uint32_t c : mesh.corners)
            for (std::size_t k = 0; k < 3; ++k) {
                lo_[k] = std::min(lo_[k], mesh.points[c][k]);
                hi_[k] = std::max(hi_[k], mesh.points[c][k]);
            }
    }

    [[nodiscard]] std::pair<Kind, Point3d> any() {
        const auto t = mesh_.face(random_.below(mesh_.face_count()));
        const Point3d& a = mesh_.points[t[0]];
        const Point3d& b = mesh_.points[t[1]];
        const Point3d& c = mesh_.points[t[2]];
        switch (random_.below(8)) {
            case 0:
                return {Kind::Vertex, a};
            case 1:
            case 2: {
                const Point3d m = middle(a, b);
                if (is_middle(m, a, b)) return {Kind::Middle, m};
                return {Kind::NearMiddle, moved(m)};
            }
            case 3:
            case 4:
                return {Kind::NearVertex, moved(a)};
            case 5:
            case 6:
                return {Kind::NearFace, moved(on_face(a, b, c))};
            default:
                return {Kind::Uniform, uniform()};
        }
    }

private:
    double real() { return static_cast<double>(random_.next() >> 11) * 0x1p-53; }
    static Point3d middle(const Point3d& a, const Point3d& b) {
        Point3d m{};
        for (std::size_t k = 0; k < 3; ++k) m[k] = 0.5 * (a[k] + b[k]);
        return m;
    }
    static bool is_middle(const Point3d& m, const Point3d& a, const Point3d& b) {
        for (std::size_t k = 0; k < 3; ++k)
            if (2 * brute::Rational(m[k]) != brute::Rational(a[k]) + brute::Rational(b[k]))
                return false;
        return true;
    }
    Point3d on_face(const Point3d& a, const Point3d& b, const Point3d& c) {
        const double s = real();
        const double t = real() * (1 - s);
        Point3d p{};
        for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]);
        return p;
    }
    // Each coordinate by one ulp up or down, or not at all; now and then none of them.
    Point3d moved(Point3d p) {
        for (double& c : p) {
            const std::uint64_t way = random_.below(3);
            if (way != 0) c = std::nextafter(c, way == 1 ? HUGE_VAL : -HUGE_VAL);
        }
        return p;
    }
    Point3d uniform() {
        Point3d p{};
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = lo_[k] + (1.1 * real() - 0.05) * (hi_[k] - lo_[k]);
        return p;
    }

    const PolygonMesh& mesh_;
    reference::Random random_;
    Point3d lo_{};
    Point3d hi_{};
};

// Files ------------------------------------------------------------------------------------------

bool is_triangle_mesh(const PolygonMesh& mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.face(f).size() != 3) return false;
    return mesh.face_count() != 0;
}

std::optional<Model> model_of(const std::string& name, PolygonMesh mesh, const Options& o) {
    if (!is_triangle_mesh(mesh) || mesh.face_count() < o.least_triangles ||
        mesh.face_count() > o.most_triangles)
        return std::nullopt;
    trisect::ImportOptions options;
    options.require_closed = false;
    trisect::ImportedMesh imported = trisect::import_mesh(mesh, options);
    if (!imported.report.closed || imported.report.inside_out) return std::nullopt;
    const bool embedded = trisect::is_embedded(imported.mesh);
    return Model{name, std::move(mesh), std::move(imported.mesh), embedded};
}

std::vector<Model> models_of(const Options& o) {
    std::vector<Model> out;
    if (o.paths.empty()) {
        out.push_back(*model_of("sphere", trisect::make_icosphere(1, 3), o));
        out.push_back(*model_of("torus", trisect::make_torus(1, 0.4, 32, 16), o));
        return out;
    }
    std::set<std::pair<std::uintmax_t, std::filesystem::path>> files;
    for (const std::string& path : o.paths)
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
            if (entry.is_regular_file() &&
                std::set<std::string>{".off", ".obj", ".stl", ".STL", ".ply"}.contains(
                    entry.path().extension().string()))
                files.emplace(entry.file_size(), entry.path());
    for (const auto& [size, path] : files) {
        if (out.size() == o.files) break;
        try {
            auto model = model_of(path.filename().string(), trisect::read_mesh(path), o);
            if (model) out.push_back(std::move(*model));
        } catch (const std::exception&) {  // no mesh
        }
    }
    return out;
}

// Comparison -------------------------------------------------------------------------------------

const char* word(CGAL::Bounded_side side) {
    return side == CGAL::ON_BOUNDARY       ? "on the boundary"
           : side == CGAL::ON_BOUNDED_SIDE ? "inside"
                                           : "outside";
}

bool is_side(CGAL::Bounded_side side, Location location) {
    switch (location) {
        case Location::Inside:
            return side == CGAL::ON_BOUNDED_SIDE;
        case Location::Outside:
            return side == CGAL::ON_UNBOUNDED_SIDE;
        default:
            return side == CGAL::ON_BOUNDARY;
    }
}

class Comparison {
public:
    explicit Comparison(const Model& m)
        : m_(m),
          solid_(trisect::Solid::from_lattice_mesh(
              m.imported, m.embedded ? trisect::Embedding::Assume : trisect::Embedding::Resolve)),
          index_(solid_),
          boundary_(brute::Boundary::of_triangles(m.mesh, solid_.source_id())) {
        if (!m.embedded) return;
        mesh_ = trisect::to_cgal_surface_mesh<Kernel::Point_3>(m.mesh);
        if (CGAL::is_closed(mesh_)) side_of_.emplace(mesh_);
    }

    [[nodiscard]] bool has_cgal() const { return side_of_.has_value(); }
    /// Places inside or outside that are on polygons.
    [[nodiscard]] std::size_t covered() const { return covered_; }

    // Where the point is; nothing when answers differ, which is printed.
    std::optional<Location> locate(const Point3d& p) {
        const trisect::Place place = index_.locate(p);
        const brute::Answer answer = boundary_.locate(brute::point(p));
        if (!m_.embedded)
            return is_resolved(p, place.location, answer.location) ? std::optional(place.location)
                                                                   : std::nullopt;
        if (!brute::agrees(place, answer, true)) {
            report(p, brute::to_string(place), brute::to_string(answer));
            return std::nullopt;
        }
        if (side_of_) {
            const CGAL::Bounded_side side = (*side_of_)(Kernel::Point_3(p[0], p[1], p[2]));
            if (!is_side(side, place.location)) {
                report(p, brute::to_string(place), std::string("CGAL: ") + word(side));
                return std::nullopt;
            }
        }
        return place.location;
    }

private:
    static bool is_off(Location l) { return l == Location::Inside || l == Location::Outside; }

    bool is_resolved(const Point3d& p, Location found, Location expected) {
        if (is_off(expected)) {
            if (found == expected) return true;
            report(p, trisect::to_string(found), trisect::to_string(expected));
            return false;
        }
        if (!is_off(found)) return true;
        ++covered_;
        // All around on the same side, as far as points are on no polygon.
        for (int i = 0; i < 100; ++i) {
            Point3d q = p;
            for (double& c : q)
                for (std::uint64_t n = random_.below(5), up = random_.below(2); n != 0; --n)
                    c = std::nextafter(c, up != 0 ? HUGE_VAL : -HUGE_VAL);
            const Location around = boundary_.locate(brute::point(q)).location;
            if (!is_off(around) || around == found) continue;
            report(p, trisect::to_string(found),
                   std::string("near a point ") + trisect::to_string(around));
            return false;
        }
        return true;
    }
    void report(const Point3d& p, const std::string& found, const std::string& expected) const {
        std::printf("%s: point %a %a %a is %s, not %s\n", m_.name.c_str(), p[0], p[1], p[2],
                    found.c_str(), expected.c_str());
    }

    const Model& m_;
    trisect::Solid solid_;
    trisect::BrepIndex index_;
    brute::Boundary boundary_;
    Mesh mesh_;
    std::optional<SideOf> side_of_;
    reference::Random random_{1};
    std::size_t covered_ = 0;
};

bool compare(const Model& m, const Options& o, std::uint64_t seed, Totals& totals) {
    Comparison comparison(m);
    Points points(m.mesh, seed);
    std::array<std::size_t, 5> located{};
    for (std::size_t i = 0; i < o.points; ++i) {
        const auto [kind, p] = points.any();
        const std::optional<Location> location = comparison.locate(p);
        if (!location) return false;
        ++located[static_cast<std::size_t>(*location)];
        ++totals.kinds[static_cast<std::size_t>(kind)];
    }
    const auto at = [&](Location l) { return located[static_cast<std::size_t>(l)]; };
    std::printf("| %s | %zu | %s | %zu | %zu | %zu | %zu | %zu |\n", m.name.c_str(),
                m.mesh.face_count(), comparison.has_cgal() ? "both" : "brute force",
                at(Location::Outside), at(Location::OnFace), at(Location::OnEdge),
                at(Location::OnVertex), at(Location::Inside));
    std::fflush(stdout);
    ++totals.files;
    totals.fractions +=
        std::ranges::all_of(m.imported.points, [](const auto& p) { return p.is_whole(); }) ? 0U
                                                                                           : 1U;
    totals.points += o.points;
    totals.resolved += m.embedded ? 0 : o.points;
    totals.covered += comparison.covered();
    totals.sides += comparison.has_cgal() ? o.points : 0;
    for (std::size_t i = 0; i < located.size(); ++i) totals.located[i] += located[i];
    return true;
}

void print(const Totals& t) {
    std::printf("\n| | |\n|---|---:|\n");
    std::printf("| files | %zu |\n", t.files);
    std::printf("| of these, with bits behind the point | %zu |\n", t.fractions);
    std::printf("| places compared with brute force | %zu |\n", t.points);
    std::printf("| sides compared with CGAL | %zu |\n", t.sides);
    std::printf("| points of files that meet themselves | %zu |\n", t.resolved);
    std::printf("| of these, on a polygon but inside or outside | %zu |\n", t.covered);
    constexpr std::array<const char*, 6> kinds{
        "own vertices",         "midpoints of edges",
        "one ulp off a vertex", "one ulp off the middle of an edge",
        "one ulp off a face",   "uniform"};
    for (std::size_t i = 0; i < kinds.size(); ++i)
        std::printf("| points: %s | %zu |\n", kinds[i], t.kinds[i]);
}

Options parse(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        if (!name.starts_with("--") || i + 1 == argc) {
            o.paths.push_back(name);
            continue;
        }
        const auto value = std::strtoull(argv[++i], nullptr, 10);
        if (name == "--points") o.points = value;
        if (name == "--files") o.files = value;
        if (name == "--least-triangles") o.least_triangles = value;
        if (name == "--most-triangles") o.most_triangles = value;
        if (name == "--seed") o.seed = value;
    }
    return o;
}

}  // namespace

int main(int argc, char** argv) {
    const Options o = parse(argc, argv);
    std::printf("| file | triangles | oracles | outside | face | edge | vertex | inside |\n");
    std::printf("|---|---:|---|---:|---:|---:|---:|---:|\n");
    Totals totals;
    std::uint64_t seed = o.seed;
    for (const Model& m : models_of(o)) {
        try {
            if (!compare(m, o, seed++, totals)) return 1;
        } catch (const std::exception& e) {
            std::printf("%s: %s\n", m.name.c_str(), e.what());
            return 1;
        }
    }
    print(totals);
    return 0;
}
