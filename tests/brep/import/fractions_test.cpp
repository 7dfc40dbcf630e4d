// SPDX-License-Identifier: Apache-2.0
//
// Import that keeps the user's doubles: what comes out is what went in, and all that import decides
// is as on whole coordinates.

#include <trisect/brep/import_mesh.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <trisect/brep/import/import_triangles.h>
#include <trisect/brep/import/line_balance.h>
#include <trisect/brep/import/volume_sign.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/dyadic.h>

#include "random_tetrahedra.h"
#include "support/fractions.h"
#include "support/mesh_builders.h"

namespace trisect::import_fractions {
namespace {

using test::below;
using test::Random;
using test::tetrahedra;

ImportedMesh keep(const PolygonMesh& mesh, ImportOptions options = {}) {
    return detail::import_mesh(mesh, options, Fractions::Kept);
}

std::array<std::uint64_t, 3> bits(const Point3d& p) {
    return {std::bit_cast<std::uint64_t>(p[0] + 0.0), std::bit_cast<std::uint64_t>(p[1] + 0.0),
            std::bit_cast<std::uint64_t>(p[2] + 0.0)};
}

// Of every corner of every triangle: the doubles that the file has for it.
void expect_own_doubles(const PolygonMesh& mesh, const ImportedMesh& imported) {
    ASSERT_TRUE(imported.report.lattice.lossless);
    EXPECT_EQ(imported.report.lattice.moved, 0U);
    EXPECT_EQ(imported.report.lattice.max_move, 0);
    EXPECT_EQ(imported.report.lattice.flipped_faces, 0U);
    const LatticeMesh& out = imported.mesh;
    ASSERT_EQ(out.triangles.size(), mesh.face_count());
    for (std::uint32_t t = 0; t < out.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const Point3d p = to_user(out.points[out.triangles[t][i]], out.lattice);
            ASSERT_EQ(bits(p), bits(mesh.points[mesh.face(out.face_of(t))[i]]));
        }
}

/// A sphere whose coordinates are doubles of any bits, times powers of two of a range.
PolygonMesh any_doubles(Random& random, int range, int exponent) {
    PolygonMesh m = make_icosphere(1, 2);
    std::uniform_real_distribution<double> noise(0.9, 1.1);
    for (Point3d& p : m.points)
        for (double& c : p) c = std::ldexp(c * noise(random), exponent);
    // Corners near coordinate planes, whose last bits are far down.
    for (Point3d& p : m.points)
        p[below(random, 3)] *=
            std::ldexp(1.0, -static_cast<int>(below(random, static_cast<std::uint64_t>(range))));
    return m;
}

TEST(ImportFractions, RandomDoublesComeBackBitForBit) {
    Random random(1);
    for (int round = 0; round < 300; ++round) {
        const int exponent = static_cast<int>(below(random, 1900)) - 900;
        // 1.1 < 2^1, and a double has 53 bits; noise and the sphere's own zeros take some more.
        const PolygonMesh m = any_doubles(random, 70, exponent);
        if (span_bits(m.points) > 126) continue;
        expect_own_doubles(m, keep(m));
        expect_own_doubles(m, detail::import_polygons(m, {}, Fractions::Kept));
    }
}

TEST(ImportFractions, SubnormalNumbersComeBackBitForBit) {
    Random random(2);
    for (const int exponent : {-1074 + 52, -1060, -1000, -960}) {
        PolygonMesh m = make_icosphere(1, 2);
        std::uniform_real_distribution<double> noise(0.9, 1.1);
        for (Point3d& p : m.points)
            for (double& c : p) c = std::ldexp(c * noise(random), exponent);
        expect_own_doubles(m, keep(m));
    }
}

TEST(ImportFractions, WhatSpansMoreIsRoundedAndReported) {
    PolygonMesh m = test::make_mesh({{0, 0, 0}, {1e308, 0, 0}, {0, 1e308, 0}, {1, 1, 1e308}},
                                    {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    const ImportedMesh imported = keep(m);
    EXPECT_FALSE(imported.report.lattice.lossless);
    EXPECT_EQ(imported.report.lattice.moved, 1U);
    EXPECT_EQ(imported.report.lattice.max_move, 1);
    EXPECT_EQ(to_user(imported.mesh.points[3], imported.mesh.lattice), (Point3d{0, 0, 1e308}));
    EXPECT_EQ(to_user(imported.mesh.points[1], imported.mesh.lattice), (Point3d{1e308, 0, 0}));
    // 127 bits.
    m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0x1p-126, 0, 1}};
    EXPECT_EQ(keep(m).report.lattice.moved, 1U);
    EXPECT_EQ(keep(m).report.lattice.max_move, 0x1p-126);
    m.points[3][0] = 0x1p-125;
    EXPECT_TRUE(keep(m).report.lattice.lossless);
}

// A soup whose repeated points differ in their last bits bounds something once they are rounded.
TEST(ImportFractions, WhatOnlyRoundingClosesIsRounded) {
    const PolygonMesh sphere = make_icosphere(1, 2);
    PolygonMesh m;
    for (const std::uint32_t c : sphere.corners) m.points.push_back(sphere.points[c]);
    for (std::uint32_t i = 0; i < m.points.size(); i += 3) m.add_triangle(i, i + 1, i + 2);
    EXPECT_TRUE(import_mesh(m, {}).report.lattice.lossless);
    m.points[7][0] = std::nextafter(m.points[7][0], 2);
    m.points[11] = {m.points[11][0], m.points[11][1] + 0x1p-60, m.points[11][2] - 0x1p-70};
    EXPECT_FALSE(keep(m, {.require_closed = false}).report.closed);
    const ImportedMesh imported = import_mesh(m, {});
    EXPECT_TRUE(imported.report.closed);
    EXPECT_FALSE(imported.report.lattice.lossless);
    EXPECT_EQ(imported.mesh.points, detail::import_mesh(m, {}, Fractions::Rounded).mesh.points);
    m.points[5][0] += 1e-3;  // remains open
    EXPECT_THROW((void)import_mesh(m, {}), InvalidSolid);
    const ImportedMesh open = import_mesh(m, {.require_closed = false});
    EXPECT_FALSE(open.report.closed);
    EXPECT_TRUE(open.report.lattice.lossless);
}

TEST(ImportFractions, MinusZeroBecomesPlusZero) {
    const PolygonMesh m =
        test::make_mesh({{-0.0, 0, -0.0}, {0.1, -0.0, 0}, {0, 0.3, 0}, {0, 0, 1e-9}, {0, 0, -0.0}},
                        {{0, 2, 1}, {4, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    const ImportedMesh imported = keep(m);
    EXPECT_TRUE(imported.report.lattice.lossless);
    EXPECT_EQ(imported.report.welded_points, 1U);
    for (const LatticePoint& p : imported.mesh.points)
        for (const double c : to_user(p, imported.mesh.lattice)) EXPECT_FALSE(std::signbit(c));
}

TEST(ImportFractions, AGivenLatticeRoundsToWholeNumbers) {
    const PolygonMesh m = make_icosphere(1, 2);
    const Lattice lattice{-8};
    const ImportedMesh imported = keep(m, {.lattice = lattice});
    EXPECT_EQ(imported.mesh.lattice, lattice);
    EXPECT_FALSE(imported.report.lattice.lossless);
    for (const LatticePoint& p : imported.mesh.points) EXPECT_TRUE(p.is_whole());
}

std::string off_text(const std::vector<std::string>& points) {
    std::string out = "OFF\n" + std::to_string(points.size()) + " 4 0\n";
    for (const std::string& p : points) out += p + "\n";
    return out + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
}

TEST(ImportFractions, DecimalsAreTheNearestDoublesAndAreWrittenAgain) {
    const std::string text =
        off_text({"0.1 1e-5 -0.30000000000000004", "1000.7 4.9e-3 1e-7",
                  "0.00048828125 123.456789012345678901234567890 0.5", "0.25 1e-8 7.7"});
    const PolygonMesh m = read_mesh(text, MeshFormat::Off, "t.off");
    EXPECT_EQ(m.points[2][1], 123.45678901234568);
    const ImportedMesh imported = keep(m);
    expect_own_doubles(m, imported);
    PolygonMesh out;
    for (const LatticePoint& p : imported.mesh.points)
        out.points.push_back(to_user(p, imported.mesh.lattice));
    for (const auto& t : imported.mesh.triangles) out.add_triangle(t[0], t[1], t[2]);
    for (const MeshFormat format :
         {MeshFormat::Off, MeshFormat::Obj, MeshFormat::Ply, MeshFormat::StlAscii}) {
        WriteOptions options;
        options.format = format;
        const FormattedMesh written = format_mesh(out, options, "t");
        const PolygonMesh again = read_mesh(written.bytes, format, "t");
        expect_own_doubles(m, keep(again));
    }
}

// A square face in the place of two triangles, or a face less, or a side divided.
void change(Random& random, PolygonMesh& m) {
    if (m.face_count() == 0) return;
    const std::uint32_t a = m.corners[below(random, m.corners.size())];
    const std::uint32_t b = m.corners[below(random, m.corners.size())];
    const std::uint32_t c = m.corners[below(random, m.corners.size())];
    switch (below(random, 4)) {
        case 0:
            m = test::without_face(m, below(random, m.face_count()));
            break;
        case 1:
            m.add_face(std::vector<std::uint32_t>{a, b, c, m.corners[0]});
            m.add_face(std::vector<std::uint32_t>{m.corners[0], c, b, a});
            break;
        case 2:
            m.add_triangle(a, b, c);
            break;
        default:
            m.corners[below(random, m.corners.size())] = a;
    }
}

// The point of no face makes the unit large. What else there is stays where it is.
TEST(ImportFractions, FindTheSameAsOnWholeCoordinates) {
    Random random(3);
    std::map<bool, int> closed;
    int t_edges = 0;
    for (int round = 0; round < 4000; ++round) {
        PolygonMesh m = tetrahedra(random, 2 + below(random, 4), 1 + below(random, 5));
        for (std::uint64_t i = below(random, 3); i > 0; --i) change(random, m);
        const int scale = 50 + static_cast<int>(below(random, 60));
        for (Point3d& p : m.points)
            for (double& c : p) c = std::ldexp(c, -scale);
        ImportOptions options;
        options.require_closed = false;
        const ImportedMesh whole = import_mesh(m, options);
        m.points.push_back({1, 0.5, 0});
        const ImportedMesh fine = keep(m, options);
        ASSERT_TRUE(whole.report.lattice.lossless);
        ASSERT_TRUE(fine.report.lattice.lossless);
        ASSERT_EQ(fine.mesh.triangles, whole.mesh.triangles);
        ASSERT_EQ(fine.mesh.face_of_triangle, whole.mesh.face_of_triangle);
        ASSERT_EQ(fine.mesh.points.size(), whole.mesh.points.size());
        for (std::size_t i = 0; i < fine.mesh.points.size(); ++i)
            ASSERT_EQ(bits(to_user(fine.mesh.points[i], fine.mesh.lattice)),
                      bits(to_user(whole.mesh.points[i], whole.mesh.lattice)));
        ASSERT_EQ(fine.report.welded_points, whole.report.welded_points);
        ASSERT_EQ(fine.report.nonplanar_faces, whole.report.nonplanar_faces);
        ASSERT_EQ(fine.report.degenerate_faces_dropped, whole.report.degenerate_faces_dropped);
        ASSERT_EQ(fine.report.t_edges, whole.report.t_edges);
        ASSERT_EQ(fine.report.closed, whole.report.closed);
        ASSERT_EQ(fine.report.inside_out, whole.report.inside_out);
        ASSERT_EQ(fine.report.defects, whole.report.defects);
        ++closed[whole.report.closed];
        t_edges += whole.report.t_edges != 0 ? 1 : 0;
    }
    EXPECT_GT(closed[true], 400);
    EXPECT_GT(closed[false], 400);
    EXPECT_GT(t_edges, 10);
}

TEST(ImportFractions, RefitRoundsToWholeCoordinates) {
    // A box whose upper face has one corner off by 2^-60, and sides that are not dyadic.
    PolygonMesh m = test::cuboid();
    for (Point3d& p : m.points) p = {p[0] * 0.3, p[1] * 0.7, p[2] * 0.1 + 1};
    ImportOptions options{.nonplanar = NonplanarPolicy::Refit, .refit_move = 1e-3};
    const auto expect_same = [&] {
        const ImportedMesh kept = keep(m, options);
        const ImportedMesh rounded = detail::import_mesh(m, options, Fractions::Rounded);
        EXPECT_EQ(kept.mesh.lattice, rounded.mesh.lattice);
        EXPECT_EQ(kept.mesh.points, rounded.mesh.points);
        EXPECT_EQ(kept.mesh.triangles, rounded.mesh.triangles);
        EXPECT_EQ(kept.report.refitted_faces, rounded.report.refitted_faces);
        EXPECT_EQ(kept.report.max_refit_move, rounded.report.max_refit_move);
        EXPECT_EQ(kept.report.lattice.lossless, rounded.report.lattice.lossless);
        EXPECT_EQ(kept.report.lattice.moved, rounded.report.lattice.moved);
        EXPECT_EQ(kept.report.lattice.max_move, rounded.report.lattice.max_move);
        return kept;
    };
    EXPECT_TRUE(keep(m, options).report.lattice.lossless) << "planar as it is";
    m.points[m.corners[0]][2] += 1e-4;
    const ImportedMesh refitted = expect_same();
    EXPECT_GT(refitted.report.refitted_faces, 0U);
    EXPECT_FALSE(refitted.report.lattice.lossless);
    m.points[m.corners[0]][2] -= 1e-4;
    m.points[m.corners[0]][0] += 0x1p-54;  // planar once it is rounded
    EXPECT_EQ(expect_same().report.refitted_faces, 0U);
    options.nonplanar = NonplanarPolicy::Refuse;
    EXPECT_THROW(keep(m, options), InvalidSolid);
}

mpq_class exact_volume6(std::span<const LatticePoint> points,
                        std::span<const std::array<std::uint32_t, 3>> triangles) {
    mpq_class sum;
    const LatticePoint& o = points[triangles[0][0]];
    for (const auto& t : triangles) {
        std::array<std::array<mpq_class, 3>, 3> m;
        for (std::size_t i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                m[i][static_cast<std::size_t>(k)] =
                    mpq_class(points[t[i]][k].to_double()) - mpq_class(o[k].to_double());
        sum += m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    }
    return sum;
}

// Tetrahedra that are nearly flat, with coordinates of all 126 bits; open ones too, whose volume is
// that of the cone to the first corner.
TEST(VolumeSignFractions, AgreesWithRationals) {
    Random random(4);
    std::map<int, int> signs;
    for (int round = 0; round < 20000; ++round) {
        const auto coordinate = [&] {
            const auto v = static_cast<std::int64_t>(random() >> 11U) - (std::int64_t{1} << 52U);
            return Coordinate(
                std::ldexp(static_cast<double>(v), -static_cast<int>(below(random, 74))));
        };
        std::vector<LatticePoint> points;
        for (int i = 0; i < 3; ++i) points.push_back({coordinate(), coordinate(), coordinate()});
        // Twice the middle of two corners less the third one, where that is a double: no volume.
        LatticePoint p = points[static_cast<std::size_t>(below(random, 3))];
        if (round % 3 != 0) {
            const double nudge = std::ldexp(1.0, -static_cast<int>(below(random, 74)));
            p = {p.x, p.y, Coordinate(p.z.to_double() + nudge)};
        }
        if (round % 7 == 0) p = {coordinate(), coordinate(), coordinate()};
        points.push_back(p);
        if (detail::fraction_bits(p) > fraction_limit) continue;
        std::vector<std::array<std::uint32_t, 3>> triangles{
            {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
        if (round % 2 == 0) triangles.pop_back();
        const int expected = sgn(exact_volume6(points, triangles));
        ASSERT_EQ(detail::volume_sign(points, triangles), expected);
        ++signs[expected];
    }
    for (const int s : {-1, 0, 1}) EXPECT_GT(signs[s], 1000) << s;
}

TEST(LineBalanceFractions, AsOnAFinerLattice) {
    Random random(5);
    int left_over = 0;
    for (int round = 0; round < 3000; ++round) {
        std::vector<LatticePoint> whole;
        for (int i = 0; i < 6; ++i) {
            const auto t = static_cast<std::int64_t>(below(random, 5));
            whole.push_back({3 * t - 7, -t, static_cast<std::int64_t>(below(random, 2)) + 2 * t});
        }
        std::vector<detail::NetEdge> edges;
        for (int i = 0; i < 5; ++i) {
            const auto a = static_cast<std::uint32_t>(below(random, 6));
            const auto b = static_cast<std::uint32_t>(below(random, 6));
            if (whole[a] != whole[b]) edges.push_back({a, b, 1});
        }
        const auto expected = detail::find_uncancelled(whole, edges);
        for (const int bits : {1, 24, 70}) {
            std::vector<LatticePoint> fine;
            for (const LatticePoint& p : whole) fine.push_back(test::with_fractions(p, bits));
            ASSERT_EQ(detail::find_uncancelled(fine, edges), expected);
        }
        for (const bool open : expected) left_over += open ? 1 : 0;
    }
    EXPECT_GT(left_over, 1000);
}

LatticeMesh tetrahedron(double scale) {
    LatticeMesh m;
    const auto at = [&](double x, double y, double z) {
        return LatticePoint{Coordinate(x * scale), Coordinate(y * scale), Coordinate(z * scale)};
    };
    m.points = {at(0, 0, 0), at(5, 0, 0), at(0, 7, 0), at(1, 2, 3)};
    m.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return m;
}

TEST(TransformFractions, LatticeMapsAreExactOrRefused) {
    const LatticeMesh m = tetrahedron(0x1p-60);
    const LatticeMesh moved = translated(m, {Coordinate(0x1p-70), 0, Coordinate(-0x1p-20)});
    EXPECT_EQ(moved.points[1].x.to_double(), 0x5p-60 + 0x1p-70);
    EXPECT_EQ(moved.points[3].z.to_double(), 0x3p-60 - 0x1p-20);
    EXPECT_EQ(translated(moved, {Coordinate(-0x1p-70), 0, Coordinate(0x1p-20)}).points, m.points);
    EXPECT_THROW((void)translated(m, {1, 0, 0}), LimitError) << "61 bits";
    EXPECT_EQ(rotated_by_quarter_turns(rotated_by_quarter_turns(m, 2, 1), 2, 3).points, m.points);
    EXPECT_EQ(mirrored(mirrored(m, 1), 1).points, m.points);
    const LatticeMesh larger = scaled_by_power_of_two(m, 11);
    EXPECT_EQ(larger.lattice.exponent, 8);
    EXPECT_EQ(larger.points[1].x.to_double(), 0x5p-57);
}

TEST(TransformFractions, AffineMapsGiveTheNearestDoubles) {
    const LatticeMesh m = tetrahedron(0x1p-60);
    LatticeReport report;
    EXPECT_EQ(transformed(m, {}, report).points, m.points) << "nothing moves";
    EXPECT_TRUE(report.lossless);
    report = {};
    const LatticeMesh third = transformed(m, AffineMap::scaling({1 / 3.0, 1, 0.5}), report);
    EXPECT_EQ(third.points[1].x.to_double(),
              std::ldexp(std::nearbyint(std::ldexp(5 * (1 / 3.0), 13)), -73));
    EXPECT_EQ(third.points[3].z.to_double(), 0x3p-61);
    EXPECT_EQ(report.moved, 2U);
    EXPECT_GT(report.max_move, 0);
    EXPECT_LE(report.max_move, 0x1p-74);
    report = {};
    (void)transformed(m, AffineMap::translation({1, 0, 0}), report);  // 61 bits
    EXPECT_EQ(report.moved, 2U);
    EXPECT_EQ(report.max_move, 0x5p-60);
}

}  // namespace
}  // namespace trisect::import_fractions
