// SPDX-License-Identifier: Apache-2.0
//
// Convex hulls against CGAL's convex_hull_3 in rationals, on the same doubles.
//
// Points of grids of a few units, where most are coplanar and collinear; the same scaled by
// decimal numbers, which are no multiples of one unit; some of them moved by one ulp; points on
// circles, on spheres and within. The hulls have to have the same volume, as fractions, and the
// library's has to be closed, with corners among the points and convex along each of its edges.
//
//     hull_campaign [--seed S] [--sets N] [--only I]
//     hull_campaign --sphere N | MESH...
//
// The second form takes the vertices of meshes, or N points on a sphere, and prints what both took;
// CGAL in its kernel of filtered predicates, with corners as they are. Prints sets that differ and
// exits with 1 when there are any.

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::Point3d;
using trisect::PolygonMesh;

using Number = CGAL::Gmpq;
using Rational = CGAL::Cartesian<Number>;
using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;

// Oracle -----------------------------------------------------------------------------------------

Number six_volumes(const PolygonMesh& mesh) {
    Number sum = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::array<Rational::Vector_3, 3> v;
        for (std::size_t i = 0; i < 3; ++i) {
            const Point3d& p = mesh.points[mesh.face(f)[i]];
            v[i] = Rational::Vector_3(Number(p[0]), Number(p[1]), Number(p[2]));
        }
        sum += CGAL::cross_product(v[0], v[1]) * v[2];
    }
    return sum;
}

template <class Kernel>
CGAL::Surface_mesh<typename Kernel::Point_3> hull_by_cgal(const std::vector<Point3d>& points) {
    using Point = typename Kernel::Point_3;
    using Scalar = typename Kernel::FT;
    std::vector<Point> given;
    given.reserve(points.size());
    for (const Point3d& p : points) given.emplace_back(Scalar(p[0]), Scalar(p[1]), Scalar(p[2]));
    CGAL::Surface_mesh<Point> hull;
    CGAL::convex_hull_3(given.begin(), given.end(), hull);
    return hull;
}

// 0 where all points lie in one plane.
Number six_volumes_by_cgal(const std::vector<Point3d>& points) {
    Number sum = 0;
    const auto hull = hull_by_cgal<Rational>(points);
    if (hull.number_of_faces() < 4) return 0;
    for (const auto face : hull.faces()) {
        std::vector<Rational::Vector_3> v;
        for (const auto at : hull.vertices_around_face(hull.halfedge(face)))
            v.push_back(hull.point(at) - CGAL::ORIGIN);
        for (std::size_t i = 2; i < v.size(); ++i)
            sum += CGAL::cross_product(v[0], v[i - 1]) * v[i];
    }
    return sum;
}

// Every edge once in each direction, and no neighbour's corner above a triangle.
bool is_closed_and_convex(const PolygonMesh& mesh) {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> apex;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            if (!apex.emplace(std::array{mesh.face(f)[i], mesh.face(f)[(i + 1) % 3]},
                              mesh.face(f)[(i + 2) % 3])
                     .second)
                return false;
    const auto point = [&](std::uint32_t v) {
        const Point3d& p = mesh.points[v];
        return Rational::Point_3(Number(p[0]), Number(p[1]), Number(p[2]));
    };
    return std::ranges::all_of(apex, [&](const auto& edge) {
        const auto twin = apex.find({edge.first[1], edge.first[0]});
        return twin != apex.end() &&
               CGAL::orientation(point(edge.first[0]), point(edge.first[1]), point(edge.second),
                                 point(twin->second)) != CGAL::POSITIVE;
    });
}

// Sets of points ---------------------------------------------------------------------------------

class PointSets {
public:
    explicit PointSets(std::uint64_t seed) : random_(seed) {}

    std::vector<Point3d> next() {
        const int count = whole(4, whole(0, 3) == 0 ? 300 : 40);
        const int kind = whole(0, 3);
        std::vector<Point3d> out;
        const int side = whole(1, 9);
        for (int i = 0; i < count; ++i) out.push_back(kind < 3 ? of_grid(side) : on_circles());
        if (kind == 1) scale(out);
        if (kind == 2) disturb(out);
        return out;
    }

private:
    int whole(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
    double real() { return std::uniform_real_distribution(-1.0, 1.0)(random_); }

    Point3d of_grid(int side) {
        return {double(whole(0, side)), double(whole(0, side)), double(whole(0, 3))};
    }
    // Pythagorean: exactly on circles of a few heights.
    Point3d on_circles() {
        static constexpr std::array<std::array<int, 2>, 4> arms{
            {{25, 0}, {24, 7}, {20, 15}, {15, 20}}};
        auto [x, y] = arms[static_cast<std::size_t>(whole(0, 3))];
        if (whole(0, 1) == 1) std::swap(x, y);
        const double sx = whole(0, 1) == 1 ? 1 : -1;
        const double sy = whole(0, 1) == 1 ? 1 : -1;
        return {sx * x, sy * y, double(whole(-2, 2))};
    }
    void scale(std::vector<Point3d>& points) {
        const std::array<double, 3> by{0.1 + std::fabs(real()), 0.1, 1e-3 * (2 + real())};
        for (Point3d& p : points)
            for (std::size_t k = 0; k < 3; ++k) p[k] *= by[k];
    }
    void disturb(std::vector<Point3d>& points) {
        for (Point3d& p : points)
            if (whole(0, 2) == 0) {
                const auto k = static_cast<std::size_t>(whole(0, 2));
                p[k] = std::nextafter(p[k] + 0.5, whole(0, 1) == 1 ? 100.0 : -100.0);
            }
    }

    std::mt19937_64 random_;
};

// What is wrong, or nothing.
std::string fault_of(const std::vector<Point3d>& points) {
    const Number expected = six_volumes_by_cgal(points);
    PolygonMesh hull;
    try {
        hull = trisect::make_hull(points);
    } catch (const trisect::UsageError&) {
        return expected == 0 ? "" : "refused";
    }
    if (six_volumes(hull) != expected) return "another volume";
    if (!is_closed_and_convex(hull)) return "not closed or not convex";
    const std::set<Point3d> given(points.begin(), points.end());
    for (const Point3d& p : hull.points)
        if (!given.contains(p)) return "a corner that was not given";
    return "";
}

int compare_sets(std::uint64_t seed, int count, int only) {
    PointSets sets(seed);
    int faults = 0;
    int solid = 0;
    for (int i = 0; i < count; ++i) {
        const std::vector<Point3d> points = sets.next();
        if (only >= 0 && i != only) continue;
        const std::string fault = fault_of(points);
        if (fault.empty()) {
            ++solid;
            continue;
        }
        ++faults;
        std::printf("set %d of %zu points: %s\n", i, points.size(), fault.c_str());
    }
    std::printf("%d sets equal, %d differ (seed %llu)\n", solid, faults,
                static_cast<unsigned long long>(seed));
    return faults == 0 ? 0 : 1;
}

// Times ------------------------------------------------------------------------------------------

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Best of three, in turns. Volumes in doubles have to agree.
bool compare_times(const std::string& name, const std::vector<Point3d>& points) {
    double ours = HUGE_VAL;
    double theirs = HUGE_VAL;
    PolygonMesh hull;
    CGAL::Surface_mesh<Filtered::Point_3> peer;
    for (int i = 0; i < 3; ++i) {
        auto start = std::chrono::steady_clock::now();
        hull = trisect::make_hull(points);
        ours = std::min(ours, seconds_since(start));
        start = std::chrono::steady_clock::now();
        peer = hull_by_cgal<Filtered>(points);
        theirs = std::min(theirs, seconds_since(start));
    }
    std::set<Point3d> corners(hull.points.begin(), hull.points.end());
    std::size_t others = 0;  // extreme for CGAL, not for us: on an edge or in a face
    for (const auto v : peer.vertices()) {
        const auto& p = peer.point(v);
        if (corners.erase({p.x(), p.y(), p.z()}) == 0) ++others;
    }
    std::printf("| %s | %zu | %zu | %.4f | %.4f | %.2f | %zu | %zu |\n", name.c_str(),
                points.size(), hull.points.size(), ours, theirs, theirs / ours, corners.size(),
                others);
    return corners.empty();
}

std::vector<Point3d> on_sphere(int count) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> number;
    std::vector<Point3d> out;
    for (int i = 0; i < count; ++i) {
        Point3d p{number(random), number(random), number(random)};
        const double size = std::hypot(p[0], p[1], p[2]);
        for (double& c : p) c = std::round(c / size * 0x1p40) * 0x1p-40;
        out.push_back(p);
    }
    return out;
}

int run(int argc, char** argv) {
    std::uint64_t seed = 1;
    int sets = 1000;
    int only = -1;
    std::vector<std::string> meshes;
    int sphere = 0;
    for (int i = 1; i < argc; ++i) {
        const std::string arg = argv[i];
        const char* value = i + 1 < argc ? argv[i + 1] : "0";
        if (arg == "--seed") {
            seed = std::strtoull(value, nullptr, 10);
            ++i;
        } else if (arg == "--sets") {
            sets = std::atoi(value);
            ++i;
        } else if (arg == "--only") {
            only = std::atoi(value);
            ++i;
        } else if (arg == "--sphere") {
            sphere = std::atoi(value);
            ++i;
        } else {
            meshes.push_back(arg);
        }
    }
    if (meshes.empty() && sphere == 0) return compare_sets(seed, sets, only);
    std::puts(
        "| points of | points | corners | seconds | CGAL | ratio | corners that CGAL has not | "
        "that only CGAL has |\n|---|---:|---:|---:|---:|---:|---:|---:|");
    bool equal = true;
    if (sphere != 0) equal = compare_times("a sphere", on_sphere(sphere));
    for (const std::string& path : meshes) {
        const std::string name = path.substr(path.find_last_of('/') + 1);
        try {
            equal = compare_times(name, trisect::read_mesh(path).points) && equal;
        } catch (const trisect::UsageError&) {
            std::printf("| %s | all in one plane |\n", name.c_str());
        }
    }
    return equal ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "hull_campaign: %s\n", e.what());
        return 2;
    }
}
