// SPDX-License-Identifier: Apache-2.0
//
// The short way of import for triangle meshes beside the long way for all: the same meshes, reports
// and errors, whatever is wrong with the mesh; and which meshes take the short one.

#include <trisect/brep/import_mesh.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import/import_triangles.h>
#include <trisect/brep/import/side_balance.h>
#include <trisect/brep/import/weld_points.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>

#include "random_tetrahedra.h"
#include "support/lattice_arithmetic.h"
#include "support/mesh_builders.h"

namespace trisect {
namespace {

using detail::import_counters;
using detail::import_polygons;
using detail::import_triangles;
using test::below;
using test::Random;
using test::tetrahedra;

bool one_in(Random& random, std::uint64_t n) { return below(random, n) == 0; }

/// Everything that import says, or the error with its message.
struct Outcome {
    std::string error;
    ImportedMesh imported;
};

template <class Import>
Outcome outcome(const Import& import) {
    Outcome out;
    try {
        out.imported = import();
    } catch (const InvalidSolid& e) {
        out.error = std::string("InvalidSolid ") + e.what() + e.report().to_string(100);
    } catch (const Error& e) {
        out.error = std::to_string(static_cast<int>(e.code())) + " " + e.what();
    }
    return out;
}

void expect_same_lattice_report(const LatticeReport& a, const LatticeReport& b) {
    EXPECT_EQ(a.lattice, b.lattice);
    EXPECT_EQ(a.lossless, b.lossless);
    EXPECT_EQ(a.moved, b.moved);
    EXPECT_EQ(a.max_move, b.max_move);
    EXPECT_EQ(a.flipped_faces, b.flipped_faces);
}

void expect_same(const ImportedMesh& a, const ImportedMesh& b) {
    EXPECT_EQ(a.mesh.lattice, b.mesh.lattice);
    EXPECT_EQ(a.mesh.points, b.mesh.points);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(a.mesh.face_of_triangle, b.mesh.face_of_triangle);
    expect_same_lattice_report(a.report.lattice, b.report.lattice);
    EXPECT_EQ(a.report.welded_points, b.report.welded_points);
    EXPECT_EQ(a.report.nonplanar_faces, b.report.nonplanar_faces);
    EXPECT_EQ(a.report.refitted_faces, b.report.refitted_faces);
    EXPECT_EQ(a.report.max_refit_move, b.report.max_refit_move);
    EXPECT_EQ(a.report.degenerate_faces_dropped, b.report.degenerate_faces_dropped);
    EXPECT_EQ(a.report.t_edges, b.report.t_edges);
    EXPECT_EQ(a.report.closed, b.report.closed);
    EXPECT_EQ(a.report.inside_out, b.report.inside_out);
    EXPECT_EQ(a.report.defects, b.report.defects);
}

/// The same mesh in memory that is not the importer's.
void expect_same_of_a_view(const PolygonMesh& mesh, const ImportOptions& options) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face(f).size() != 3) return;
        triangles.push_back({mesh.face(f)[0], mesh.face(f)[1], mesh.face(f)[2]});
    }
    const Outcome expected = outcome([&] { return trisect::import_mesh(mesh, options); });
    const Outcome found = outcome([&] {
        return trisect::import_mesh(TriangleView{mesh.points, triangles}, options);
    });
    EXPECT_EQ(found.error, expected.error);
    expect_same(found.imported, expected.imported);
}

/// Compares both ways and says whether the short one was taken.
bool compare(const PolygonMesh& mesh, const ImportOptions& options = {},
             Fractions fractions = Fractions::Kept) {
    const Outcome expected = outcome([&] { return import_polygons(mesh, options, fractions); });
    const auto before = import_counters().triangles;
    const Outcome found = outcome([&] { return detail::import_mesh(mesh, options, fractions); });
    EXPECT_EQ(found.error, expected.error);
    expect_same(found.imported, expected.imported);
    const bool short_way = import_counters().triangles != before;
    // Every point and triangle a part of its own; of some meshes, since threads wait for each
    // other.
    static std::size_t calls = 0;
    if (++calls % 16 == 8) expect_same_of_a_view(mesh, options);
    if (calls % 16 == 0) {
        ImportOptions on_two_threads = options;
        on_two_threads.threads = 2;
        const Outcome in_parts = outcome([&] {
            auto imported = import_triangles(mesh, on_two_threads, fractions, 1);
            return imported ? *std::move(imported)
                            : import_polygons(mesh, on_two_threads, fractions);
        });
        EXPECT_EQ(in_parts.error, expected.error);
        expect_same(in_parts.imported, expected.imported);
    }
    return short_way;
}

/// Every face cut into a fan.
PolygonMesh cut(const PolygonMesh& mesh) {
    PolygonMesh m;
    m.points = mesh.points;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::size_t i = 2; i < mesh.face(f).size(); ++i)
            m.add_triangle(mesh.face(f)[0], mesh.face(f)[i - 1], mesh.face(f)[i]);
    return m;
}

PolygonMesh round_mesh(Random& random) {
    if (one_in(random, 2)) return make_icosphere(1.7, static_cast<std::uint32_t>(below(random, 3)));
    const auto n = static_cast<std::uint32_t>(4 + below(random, 8));
    return cut(make_torus(3, 0.9, n, 5));
}

PolygonMesh soup(const PolygonMesh& mesh) {
    PolygonMesh m;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::vector<std::uint32_t> loop;
        for (const std::uint32_t c : mesh.face(f)) {
            loop.push_back(static_cast<std::uint32_t>(m.points.size()));
            m.points.push_back(mesh.points[c]);
        }
        m.add_face(loop);
    }
    return m;
}

void move_points(Random& random, PolygonMesh& mesh, const Point3d& factor, const Point3d& by) {
    for (Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] = p[k] * factor[k] + by[k];
    if (!mesh.points.empty() && one_in(random, 2))
        mesh.points[below(random, mesh.points.size())] =
            mesh.points[below(random, mesh.points.size())];
}

/// Does one harmless or harmful thing to the mesh.
void spoil(Random& random, PolygonMesh& m) {
    if (m.face_count() == 0) return;
    const std::size_t f = below(random, m.face_count());
    const std::size_t c = below(random, m.corners.size());
    switch (below(random, 12)) {
        case 0:
            m = test::without_face(m, f);
            break;
        case 1:
            std::swap(m.corners[m.face_begin[f]], m.corners[m.face_begin[f] + 1]);
            break;
        case 2:
            m.add_face(std::vector<std::uint32_t>(m.face(f).begin(), m.face(f).end()));
            break;
        case 3:  // a triangle without area, closed by itself
            m.add_triangle(m.corners[c], m.corners[0], m.corners[c]);
            break;
        case 4:  // a triangle without area that may close the names or open them
            m.add_triangle(m.corners[c], m.corners[0], m.corners[m.corners.size() / 2]);
            break;
        case 5:
            m.corners[c] = m.corners[below(random, m.corners.size())];
            break;
        case 6:
            m.points.insert(m.points.begin(), {9, 9, 9});
            for (auto& v : m.corners) ++v;
            break;
        case 7:
            m = soup(m);
            break;
        case 8:
            m = test::flipped(m);
            break;
        case 9:  // a polygon, two corners or none
            m.add_face(std::vector<std::uint32_t>(below(random, 5), m.corners[c]));
            break;
        case 10:
            for (auto& p : m.points)
                if (p[0] == 0) p[0] = -0.0;
            break;
        default:
            m.points[m.corners[c]] = m.points[m.corners[0]];
    }
}

ImportOptions random_options(Random& random) {
    ImportOptions options;
    options.require_closed = one_in(random, 2);
    if (one_in(random, 3)) options.lattice = Lattice{8 * (static_cast<int>(below(random, 13)) - 8)};
    if (one_in(random, 3))
        options.nonplanar = one_in(random, 2) ? NonplanarPolicy::Refuse : NonplanarPolicy::Refit;
    return options;
}

TEST(ImportPaths, TetrahedraOnASmallGridTakeTheShortWayAndAgree) {
    Random random(1);
    for (int round = 0; round < 4000; ++round) {
        const PolygonMesh m = tetrahedra(random, 2 + below(random, 3), below(random, 7));
        const ImportOptions options{.lattice = Lattice{8 * static_cast<int>(below(random, 3)) - 8}};
        ASSERT_TRUE(compare(m, options)) << round;
    }
}

TEST(ImportPaths, SpoiledMeshesOnASmallGridAgree) {
    Random random(2);
    int quick = 0;
    for (int round = 0; round < 12000; ++round) {
        PolygonMesh m = tetrahedra(random, 2 + below(random, 3), 1 + below(random, 5));
        for (std::uint64_t i = below(random, 4); i > 0; --i) spoil(random, m);
        quick += compare(m, random_options(random)) ? 1 : 0;
    }
    EXPECT_GT(quick, 4000);
    EXPECT_LT(quick, 11000);
}

TEST(ImportPaths, RoundedCoordinatesFlipAndFlattenTheSameFaces) {
    Random random(3);
    std::size_t flipped = 0;
    int quick = 0;
    constexpr int rounds = 3000;
    for (int round = 0; round < rounds; ++round) {
        PolygonMesh m = round_mesh(random);
        Point3d factor{};
        for (double& k : factor) k = std::ldexp(1.1, static_cast<int>(below(random, 14)) - 10);
        move_points(random, m, factor, {0.1, 1e3 / 3, -1e-3});
        const ImportOptions options{.lattice = Lattice{-8 * static_cast<int>(below(random, 3))},
                                    .require_closed = false};
        quick += compare(m, options) ? 1 : 0;
        flipped += import_mesh(m, options).report.lattice.flipped_faces;
    }
    EXPECT_GT(flipped, 10000U);
    EXPECT_GT(quick, rounds / 2);
}

// Slivers and triangles without area far from the origin and near it; the point that no triangle
// has makes the unit large.
TEST(ImportPaths, CoordinatesWithFractionsAgree) {
    Random random(9);
    int quick = 0;
    std::size_t degenerate = 0;
    constexpr int rounds = 4000;
    for (int round = 0; round < rounds; ++round) {
        PolygonMesh m = one_in(random, 2) ? round_mesh(random) : tetrahedra(random, 4, 3);
        Point3d factor{};
        for (double& k : factor) k = std::ldexp(1.0, -static_cast<int>(below(random, 70)));
        const double away = std::ldexp(1.0, static_cast<int>(below(random, 20)) - 20);
        move_points(random, m, factor, {away, -away / 3, 0});
        for (std::uint64_t i = below(random, 3); i > 0; --i) spoil(random, m);
        m.points.push_back({1, 0, 0});
        ImportOptions options = random_options(random);
        options.lattice.reset();
        quick += compare(m, options, Fractions::Kept) ? 1 : 0;
        options.require_closed = false;
        options.nonplanar = NonplanarPolicy::Triangulate;
        degenerate +=
            detail::import_mesh(m, options, Fractions::Kept).report.degenerate_faces_dropped;
    }
    EXPECT_GT(quick, rounds / 4);
    EXPECT_GT(degenerate, 1000U);
}

TEST(ImportPaths, ExtremeExponentsAgree) {
    Random random(4);
    for (int round = 0; round < 2000; ++round) {
        PolygonMesh m = one_in(random, 2) ? round_mesh(random) : tetrahedra(random, 4, 3);
        const int e = static_cast<int>(below(random, 2200)) - 1100;
        for (Point3d& p : m.points)
            for (double& c : p) c = std::ldexp(c, e);
        ImportOptions options;
        if (one_in(random, 2)) options.lattice = Lattice{(e / 8 - 3) * 8};
        compare(m, options);
        compare(m, options, Fractions::Kept);
    }
}

TEST(ImportPaths, FullRangeOfCoordinatesAgrees) {
    Random random(5);
    const double big = 0x1p53 - 1;
    for (int round = 0; round < 500; ++round) {
        PolygonMesh m = tetrahedra(random, 3, 1 + below(random, 5));
        for (Point3d& p : m.points)
            for (double& c : p) c = c == 0 ? -big : (c == 1 ? std::floor(big / 3) : big);
        double& c = m.points[0][below(random, 3)];
        c += c < 0 ? 1 : -1;
        ASSERT_TRUE(compare(m, {.lattice = Lattice{0}}));
    }
}

TEST(ImportPaths, SliversFarFromTheOriginAgree) {
    Random random(6);
    for (int round = 0; round < 2000; ++round) {
        // Corners near one line, so that normals are a few units of a square of 2^100.
        PolygonMesh m = tetrahedra(random, 4, 1 + below(random, 4));
        for (Point3d& p : m.points) {
            const double t = p[0] * 0x1p48;
            p = {t + p[1], t * 2 + p[2], t * 3 + p[1]};
        }
        ASSERT_TRUE(compare(m, {.lattice = Lattice{0}}));
    }
}

TEST(ImportPaths, WhatTakesWhichWay) {
    const PolygonMesh sphere = make_icosphere(1, 3);
    EXPECT_TRUE(compare({}));
    EXPECT_TRUE(compare(sphere));
    EXPECT_TRUE(compare(soup(sphere)));
    EXPECT_TRUE(compare(test::flipped(sphere)));
    EXPECT_TRUE(compare(test::together(sphere, sphere)));
    EXPECT_TRUE(compare(sphere, {.lattice = Lattice{-8}}));  // rounds
    EXPECT_TRUE(compare(cut(test::cuboid())));
    EXPECT_FALSE(compare(test::cuboid()));  // polygons
    EXPECT_FALSE(compare(test::without_face(sphere, 5)));
    EXPECT_FALSE(compare(test::without_face(sphere, 5), {.require_closed = false}));
    // A corner inside the side of a neighbour: closed, but not by the names of the edges.
    auto t = test::make_mesh({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}},
                             {{0, 2, 4}, {4, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    EXPECT_FALSE(compare(t));
    EXPECT_EQ(import_mesh(t).report.t_edges, 3U);
    t.add_triangle(0, 4, 1);  // closes the names
    EXPECT_TRUE(compare(t));
}

TEST(ImportPaths, LargeMeshesAgreeForAnyNumberOfThreads) {
    const PolygonMesh sphere = make_icosphere(1, 6);
    ASSERT_TRUE(compare(sphere));
    ASSERT_TRUE(compare(sphere, {.lattice = Lattice{-8}}));  // flattens most triangles
    PolygonMesh twice = test::together(sphere, sphere);      // repeats all points
    ASSERT_TRUE(compare(twice));
    ASSERT_TRUE(compare(soup(sphere)));
    ASSERT_FALSE(compare(test::without_face(sphere, 70000), {.require_closed = false}));
    twice.points[70000][2] = std::numeric_limits<double>::infinity();
    twice.points[60000][2] = std::numeric_limits<double>::infinity();
    for (const std::uint32_t threads : {1U, 2U, 8U}) {
        const Outcome found = outcome([&] { return import_mesh(twice, {.threads = threads}); });
        EXPECT_NE(found.error.find("vertex 60000:"), std::string::npos) << found.error;
    }
}

TEST(ImportPaths, HostileMeshesAgree) {
    auto m = make_icosphere(1, 1);
    m.corners[7] = static_cast<std::uint32_t>(m.points.size());
    EXPECT_FALSE(compare(m));
    m = make_icosphere(1, 1);
    m.face_begin[2] = 5;
    EXPECT_FALSE(compare(m));
    m = make_icosphere(1, 1);
    m.face_begin.clear();
    EXPECT_FALSE(compare(m));
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        m = make_icosphere(1, 1);
        m.points[3][1] = bad;
        compare(m);
    }
}

/// The net traversals of every edge, counted in a map.
bool cancels_by_map(const PolygonMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> net;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = mesh.face(f)[i];
            const std::uint32_t b = mesh.face(f)[(i + 1) % 3];
            if (a < b) ++net[{a, b}];
            if (b < a) --net[{b, a}];
        }
    return std::all_of(net.begin(), net.end(), [](const auto& e) { return e.second == 0; });
}

detail::SideBalance balance_sides(const PolygonMesh& mesh) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        triangles.push_back({mesh.face(f)[0], mesh.face(f)[1], mesh.face(f)[2]});
    return detail::balance_sides(mesh.points.size(), triangles);
}

bool sides_cancel(const PolygonMesh& mesh) { return balance_sides(mesh).cancel; }

// Whether every point is a corner of a triangle of three points.
bool reach_all_points(const PolygonMesh& mesh) {
    std::set<std::uint32_t> reached;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const std::set<std::uint32_t> corners(mesh.face(f).begin(), mesh.face(f).end());
        if (corners.size() == 3) reached.insert(corners.begin(), corners.end());
    }
    return reached.size() == mesh.points.size();
}

TEST(SideBalance, AgreesWithCountingEveryEdge) {
    Random random(7);
    int balanced = 0;
    for (int round = 0; round < 20000; ++round) {
        PolygonMesh m = tetrahedra(random, 3, below(random, 12));
        const std::uint64_t changes = below(random, 3);
        for (std::uint64_t i = 0; i < changes && !m.corners.empty(); ++i)
            m.corners[below(random, m.corners.size())] =
                static_cast<std::uint32_t>(below(random, m.points.size()));
        const bool expected = cancels_by_map(m);
        const detail::SideBalance sides = balance_sides(m);
        ASSERT_EQ(sides.cancel, expected) << round;
        ASSERT_EQ(sides.reach_all_points, reach_all_points(m)) << round;
        balanced += expected ? 1 : 0;
    }
    EXPECT_GT(balanced, 6000);
    EXPECT_LT(balanced, 19000);
}

TEST(SideBalance, FansOfEverySizeAndOneSwappedEnd) {
    for (std::uint32_t n = 3; n < 40; ++n) {
        for (const bool apex_first : {true, false}) {
            // Two cones over one circle; the apexes come before or after all other vertices.
            PolygonMesh m;
            m.points.resize(n + 2);
            const std::uint32_t first = apex_first ? 2 : 0;
            const std::uint32_t top = apex_first ? 0 : n;
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t a = first + i;
                const std::uint32_t b = first + (i + 1) % n;
                m.add_triangle(top, a, b);
                m.add_triangle(top + 1, b, a);
            }
            EXPECT_TRUE(sides_cancel(m));
            // The same number of sides at every vertex, but not the same sides.
            std::swap(m.corners[1], m.corners[7]);
            EXPECT_EQ(sides_cancel(m), cancels_by_map(m));
        }
    }
}

TEST(WeldInPlace, NumbersLikeWeldPointsForEveryHint) {
    Random random(8);
    for (int round = 0; round < 3000; ++round) {
        std::vector<LatticePoint> points(below(random, 400));
        const std::int64_t grid = one_in(random, 2) ? 6 : std::int64_t{1} << 40;
        for (LatticePoint& p : points)
            p = {static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(grid)),
                 static_cast<std::int64_t>(random() % 3), -1};
        std::map<LatticePoint, std::uint32_t> names;
        std::vector<LatticePoint> distinct;
        std::vector<std::uint32_t> ids;
        for (const LatticePoint& p : points) {
            const auto [at, is_new] =
                names.try_emplace(p, static_cast<std::uint32_t>(names.size()));
            if (is_new) distinct.push_back(p);
            ids.push_back(at->second);
        }
        const detail::WeldedPoints welded = detail::weld_points(points);
        EXPECT_EQ(welded.points, distinct);
        EXPECT_EQ(welded.id, ids);
        for (std::size_t i = 0; i < distinct.size(); ++i)
            EXPECT_EQ(points[welded.first[i]], distinct[i]);
        auto kept = points;
        const auto in_place = detail::weld_in_place(kept, below(random, 500));
        EXPECT_EQ(kept, distinct);
        EXPECT_EQ(in_place.empty(), distinct.size() == points.size());
        EXPECT_TRUE(in_place.empty() || in_place == ids);
    }
}

/// Points that differ and have one hash, each twice: the bits of z undo what x did. Most bits are
/// no coordinate; those points are left out.
std::vector<LatticePoint> colliding_points(std::size_t n) {
    // The inverse of the factor of z modulo 2^64, by Newton's iteration.
    constexpr std::uint64_t factor = 0x165667b19e3779f9U;
    std::uint64_t inverse = factor;
    for (int i = 0; i < 6; ++i) inverse *= 2 - factor * inverse;
    std::vector<LatticePoint> points;
    for (std::int64_t x = 0; points.size() < n; ++x) {
        auto h = std::rotl(Coordinate(x).bits(), 32) * 0x9e3779b97f4a7c15U;
        h = std::rotl(std::rotl(h, 29), 31);
        const auto z = std::bit_cast<double>(std::rotr((h ^ 12345U) * inverse, 32));
        // Then all bits are above the last that a coordinate may have.
        if (!(std::fabs(z) < 0x1p53 && std::fabs(z) >= 0x1p-21)) continue;
        for (int twice = 0; twice < 2; ++twice) points.push_back({x, 0, Coordinate(z)});
    }
    return points;
}

TEST(WeldInPlace, PointsMadeToCollideAreSortedInstead) {
    // Each twice. Hashing would take n^2 / 4 steps: a minute and more.
    const auto points = colliding_points(400000);
    auto kept = points;
    const auto ids = detail::weld_in_place(kept, kept.size());
    ASSERT_EQ(kept.size(), points.size() / 2);
    ASSERT_EQ(ids.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(ids[i], i / 2);
}

}  // namespace
}  // namespace trisect
