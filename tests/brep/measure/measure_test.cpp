// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/measure.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <trisect/brep/brep_mesh.h>

#include "support/breps.h"
#include "support/numbers.h"

namespace {

using numbers::q;

using namespace trisect;
using namespace trisect::test;

Brep corner_pyramid(Int128 a, Int128 b, Int128 c, std::int64_t d, Lattice lattice = {}) {
    // The octant's corner cut off by a x + b y + c z = d.
    const Plane x(-1, 0, 0, Plane::Coefficient(0)), y(0, -1, 0, Plane::Coefficient(0));
    const Plane z(0, 0, -1, Plane::Coefficient(0)), cut(a, b, c, Plane::Coefficient(-d));
    BrepBuilder builder(lattice);
    const auto o = builder.add_vertex(Point(x, y, z)), px = builder.add_vertex(Point(cut, y, z));
    const auto py = builder.add_vertex(Point(x, cut, z)), pz = builder.add_vertex(Point(x, y, cut));
    builder.add_face(z, {{o, py, px}}, {});
    builder.add_face(y, {{o, px, pz}}, {});
    builder.add_face(x, {{o, pz, py}}, {});
    builder.add_face(cut, {{px, py, pz}}, {});
    return std::move(builder).build();
}

// A box with faces at rational positions: every corner is a plane point.
Brep rational_box(std::int64_t scale, std::int64_t lo, std::int64_t hi, int at = 0) {
    BrepBuilder b{Lattice{}};
    std::array<std::array<Plane, 2>, 3> planes;
    for (int i = 0; i < 3; ++i) {
        const std::int64_t shift = i == 0 ? at : 0;
        planes[static_cast<std::size_t>(i)] = {Plane::axis_aligned(i, scale, lo + shift).flipped(),
                                               Plane::axis_aligned(i, scale, hi + shift)};
    }
    std::array<std::uint32_t, 8> v{};
    for (std::size_t i = 0; i < 8; ++i)
        v[i] = b.add_vertex(
            Point(planes[0][i & 1U], planes[1][(i >> 1U) & 1U], planes[2][(i >> 2U) & 1U]));
    b.add_face(planes[2][0], {{v[0], v[2], v[3], v[1]}}, {});
    b.add_face(planes[2][1], {{v[4], v[5], v[7], v[6]}}, {});
    b.add_face(planes[1][0], {{v[0], v[1], v[5], v[4]}}, {});
    b.add_face(planes[1][1], {{v[2], v[6], v[7], v[3]}}, {});
    b.add_face(planes[0][0], {{v[0], v[4], v[6], v[2]}}, {});
    b.add_face(planes[0][1], {{v[1], v[3], v[7], v[5]}}, {});
    return std::move(b).build();
}

TEST(Measure, EmptySet) {
    const Brep b;
    EXPECT_EQ(exact_volume(b), ExactRational(0));
    EXPECT_EQ(volume(b), 0.0);
    EXPECT_EQ(area(b).value, 0.0);
    EXPECT_FALSE(centroid(b).has_value());
    EXPECT_FALSE(bounds(b).has_value());
}

TEST(Measure, Cube) {
    const Brep b = cube(3, Lattice{-8});
    EXPECT_EQ(exact_volume(b), ExactRational(27).scaled(-24));
    EXPECT_EQ(volume(b), std::ldexp(27.0, -24));
    const Area a = area(b);
    ASSERT_TRUE(a.exact.has_value());
    EXPECT_EQ(*a.exact, ExactRational(54).scaled(-16));
    EXPECT_EQ(a.value, std::ldexp(54.0, -16));
    EXPECT_EQ(*centroid(b), (Point3d{1.5 / 256, 1.5 / 256, 1.5 / 256}));
    EXPECT_EQ(*bounds(b), (Bounds{{0, 0, 0}, {3.0 / 256, 3.0 / 256, 3.0 / 256}}));
}

TEST(Measure, TheSignOfAVolumeBelowTheLeastDouble) {
    const Brep b = cube(3, Lattice{-400});
    EXPECT_EQ(volume(b), 0.0);
    EXPECT_EQ(sign_of_volume(b), 1);
    EXPECT_EQ(sign_of_volume(b, ShellId(0)), 1);
    EXPECT_EQ(sign_of_volume(Brep()), 0);
}

TEST(Measure, TetrahedronHasIrrationalArea) {
    SolidSketch s;
    const LatticePoint o{0, 0, 0}, x{6, 0, 0}, y{0, 6, 0}, z{0, 0, 6};
    const Brep b =
        s.face({{o, y, x}}).face({{o, x, z}}).face({{o, z, y}}).face({{x, y, z}}).build();
    EXPECT_EQ(exact_volume(b), ExactRational(36));
    EXPECT_EQ(*centroid(b), (Point3d{1.5, 1.5, 1.5}));
    const Area a = area(b);
    EXPECT_FALSE(a.exact.has_value());
    EXPECT_EQ(a.value, 85.17691453623979);
    EXPECT_EQ(area(b, FaceId(3)).value, std::sqrt(972.0));
}

TEST(Measure, PythagoreanFacesHaveRationalArea) {
    // A ramp: a 3-4-5 triangle drawn out.
    const Brep b = prism({{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}}, 2);
    const Area a = area(b);
    ASSERT_TRUE(a.exact.has_value());
    EXPECT_EQ(*a.exact, ExactRational(2 * 6 + 2 * (3 + 4 + 5)));
}

TEST(Measure, AreasOfAllMagnitudesAddUp) {
    // Slanted slivers from 1 to 2^100 square units: the sum of n equal roots is n times the root.
    for (int bits = 1; bits <= 50; bits += 7) {
        const std::int64_t s = std::int64_t{1} << bits;
        LatticeMesh mesh;
        mesh.points = {{0, 0, 0}, {s, -s, 0}, {s, 0, -s}};
        mesh.triangles.assign(1000, {0, 1, 2});
        const double expected = std::ldexp(std::sqrt(3.0 * 1000 * 1000), 2 * bits - 1);
        EXPECT_EQ(area(mesh).value, expected) << bits;
    }
}

TEST(Measure, HolesSubtract) {
    const Brep b = prism({rectangle(0, 0, 9, 9), reversed(rectangle(3, 3, 6, 6))}, 9);
    EXPECT_EQ(exact_volume(b), ExactRational(81 * 9 - 9 * 9));
    EXPECT_EQ(*area(b).exact, ExactRational(2 * (81 - 9) + 4 * 81 + 4 * 27));
    EXPECT_EQ(area(b, FaceId(8)).exact->to_string(), "72");
    EXPECT_EQ(*centroid(b), (Point3d{4.5, 4.5, 4.5}));
}

TEST(Measure, CavityHasNegativeVolume) {
    const Brep b = SolidSketch().box({0, 0, 0}, {9, 9, 9}).box({3, 3, 3}, {6, 6, 6}, false).build();
    EXPECT_EQ(exact_volume(b, ShellId(0)), ExactRational(729));
    EXPECT_EQ(exact_volume(b, ShellId(1)), ExactRational(-27));
    EXPECT_EQ(exact_volume(b), ExactRational(702));
    EXPECT_EQ(sign_of_volume(b, ShellId(0)), 1);
    EXPECT_EQ(sign_of_volume(b, ShellId(1)), -1);
    EXPECT_EQ(volume(b, ShellId(1)), -27.0);
}

TEST(Measure, PlanePointsGiveRationals) {
    const Brep b = corner_pyramid(3, 5, 7, 11);
    EXPECT_EQ(exact_volume(b), q("1331/630"));  // 11^3 / (6·3·5·7)
    EXPECT_EQ(volume(b), 1331.0 / 630.0);
    const auto c = exact_centroid(b);
    ASSERT_TRUE(c.has_value());
    EXPECT_EQ((*c)[0], q("11/12"));
    EXPECT_EQ((*c)[1], q("11/20"));
    EXPECT_EQ((*c)[2], q("11/28"));
    EXPECT_EQ(*centroid(b), (Point3d{11.0 / 12, 11.0 / 20, 11.0 / 28}));
    EXPECT_EQ(*bounds(b), (Bounds{{0, 0, 0}, {11.0 / 3, 11.0 / 5, 11.0 / 7}}));
    // The right faces have d²/(2bc), d²/(2ac), d²/(2ab); the slanted one d²·sqrt(83)/(2abc).
    const double expected = 121.0 / 210 * (15 + std::sqrt(83.0));
    EXPECT_DOUBLE_EQ(area(b).value, expected);
}

TEST(Measure, EqualDenominatorsAreCountedOften) {
    // All corners have w = 8: the volume has the denominator 8^3, not 8.
    const Brep b = rational_box(2, 1, 2);
    EXPECT_EQ(exact_volume(b), q("1/8"));
    EXPECT_EQ(exact_volume(rational_box(7, -3, 5)), q("512/343"));
    EXPECT_EQ(*area(rational_box(7, -3, 5)).exact, q("384/49"));
    EXPECT_EQ((*exact_centroid(rational_box(7, -3, 5, 1)))[0], q("2/7"));
    EXPECT_EQ((*exact_centroid(rational_box(7, -3, 5, 1)))[1], q("1/7"));
}

TEST(Measure, FractionsAreScaledByTheLattice) {
    EXPECT_EQ(exact_volume(corner_pyramid(3, 5, 7, 11, Lattice{8})), q("1331/630").scaled(24));
    EXPECT_EQ(volume(corner_pyramid(3, 5, 7, 11, Lattice{-16})), std::ldexp(1331.0 / 630.0, -48));
}

TEST(Measure, WideCoefficients) {
    const std::int64_t big = (std::int64_t{1} << 52) - 1;
    const Int128 a = Int128{big} * big;
    const Brep b = corner_pyramid(a, a + 2, a - 2, big);
    const ExactRational wide(WideInt<3>{a});
    const ExactRational d(big);
    const ExactRational expected =
        d * d * d /
        (ExactRational(6) * wide * (wide + ExactRational(2)) * (wide - ExactRational(2)));
    EXPECT_EQ(exact_volume(b), expected);
    EXPECT_EQ(volume(b), expected.to_double());
}

TEST(Measure, ZeroVolumeOfPlanePointsIsFoundExactly) {
    // The pyramid and its mirror image turned inside out.
    const Plane x(-1, 0, 0, Plane::Coefficient(0)), y(0, -1, 0, Plane::Coefficient(0));
    const Plane z(0, 0, -1, Plane::Coefficient(0)), cut(3, 5, 7, Plane::Coefficient(-11));
    BrepBuilder builder{Lattice{}};
    const auto o = builder.add_vertex(Point(x, y, z)), px = builder.add_vertex(Point(cut, y, z));
    const auto py = builder.add_vertex(Point(x, cut, z)), pz = builder.add_vertex(Point(x, y, cut));
    const std::vector<std::pair<Plane, std::vector<std::uint32_t>>> faces{
        {z, {o, py, px}}, {y, {o, px, pz}}, {x, {o, pz, py}}, {cut, {px, py, pz}}};
    for (const auto& [plane, loop] : faces) {
        builder.add_face(plane, {loop}, {});
        builder.add_face(plane.flipped(), {{loop[2], loop[1], loop[0]}}, {});
    }
    const Brep b = std::move(builder).build();
    EXPECT_EQ(volume(b), 0.0);
    EXPECT_EQ(exact_volume(b), ExactRational(0));
    EXPECT_FALSE(centroid(b).has_value());
}

TEST(Measure, LatticeMeshAgreesWithItsBrep) {
    LatticeMesh mesh;
    mesh.lattice = {-8};
    mesh.points = {{1, 2, 3}, {100, 5, 7}, {-3, 90, 1}, {4, 8, 77}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const Brep b = brep_from_lattice_mesh(mesh);
    EXPECT_EQ(exact_volume(mesh), exact_volume(b));
    EXPECT_GT(volume(mesh), 0.0);
    EXPECT_EQ(volume(mesh), volume(b));
    EXPECT_EQ(area(mesh).value, area(b).value);
    EXPECT_EQ(exact_centroid(mesh), exact_centroid(b));
    EXPECT_EQ(*centroid(mesh), *centroid(b));
    EXPECT_EQ(*bounds(mesh), *bounds(b));
}

TEST(Measure, LargestCoordinates) {
    const std::int64_t L = coordinate_limit - 1;
    const Brep b = SolidSketch().box({-L, -L, -L}, {L, L, L}).build();
    const ExactRational side(2 * L);
    EXPECT_EQ(exact_volume(b), side * side * side);
    EXPECT_EQ(*area(b).exact, ExactRational(6) * side * side);
    EXPECT_EQ(*centroid(b), (Point3d{0, 0, 0}));
}

// Its doubled area is 3 sqrt(N^2 + 1) = 3 N + 3 / (2 N) - ...: just above an odd number of 54 bits,
// the middle between two doubles, of which the even one lies below.
TEST(Measure, AreaJustAboveTheMiddleBetweenTwoDoubles) {
    constexpr std::int64_t n = (std::int64_t{1} << 52) + 3;
    const LatticePoint o{0, 0, 0}, z{0, 0, 3}, far{1, -n, 0}, apex{1, 0, 0};
    const Brep b = SolidSketch()
                       .face({{o, z, far}})
                       .face({{o, far, apex}})
                       .face({{z, apex, far}})
                       .face({{o, apex, z}})
                       .build();
    const Area a = area(b, FaceId(0));
    EXPECT_FALSE(a.exact.has_value());
    EXPECT_EQ(a.value, std::ldexp(static_cast<double>((std::int64_t{3} << 51) + 5), 0));
}

// The octant's corner cut off by 3x + 5y + 7z = d, as material or as a cavity.
TEST(Measure, SignOfVolumeOfShellsOffTheLattice) {
    for (const std::int64_t d : {1, 11, 1'000'003}) {
        for (const bool cavity : {false, true}) {
            const Plane x(-1, 0, 0, Plane::Coefficient(0)), y(0, -1, 0, Plane::Coefficient(0));
            const Plane z(0, 0, -1, Plane::Coefficient(0)), cut(3, 5, 7, Plane::Coefficient(-d));
            BrepBuilder builder{Lattice{}};
            const auto o = builder.add_vertex(Point(x, y, z));
            const auto px = builder.add_vertex(Point(cut, y, z));
            const auto py = builder.add_vertex(Point(x, cut, z));
            const auto pz = builder.add_vertex(Point(x, y, cut));
            const auto face = [&](const Plane& p, std::uint32_t i, std::uint32_t k,
                                  std::uint32_t m) {
                if (cavity) {
                    builder.add_face(p.flipped(), {{m, k, i}}, {});
                } else {
                    builder.add_face(p, {{i, k, m}}, {});
                }
            };
            face(z, o, py, px);
            face(y, o, px, pz);
            face(x, o, pz, py);
            face(cut, px, py, pz);
            const Brep b = std::move(builder).build();
            EXPECT_EQ(sign_of_volume(b, ShellId(0)), cavity ? -1 : 1);
            const ExactRational volume = ExactRational(d) * ExactRational(d) * ExactRational(d) /
                                         ExactRational(6 * 3 * 5 * 7);
            EXPECT_EQ(exact_volume(b), cavity ? -volume : volume);
            EXPECT_EQ(*exact_centroid(b), (std::array{ExactRational(d) / ExactRational(12),
                                                      ExactRational(d) / ExactRational(20),
                                                      ExactRational(d) / ExactRational(28)}));
        }
    }
}

}  // namespace
