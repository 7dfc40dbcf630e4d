// SPDX-License-Identifier: Apache-2.0
//
// Operands on different lattices move to the finest one exactly, or, where one is too large for
// that, to the finest on which all fit, with a report.

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include <trisect/brep/measure.h>
#include <trisect/kernel/error.h>

#include "engines/evaluate_stats.h"
#include "figures.h"
#include "support/lattice_arithmetic.h"
#include "support/solids.h"

namespace {

using solids::volume;
using trisect::evaluate;
using trisect::Expression;
using trisect::Lattice;
using trisect::Solid;

// A box with corners in units of 2^exponent.
Solid box_on(int exponent, const reference::LatticePoint& low,
             const reference::LatticePoint& high) {
    trisect::LatticeMesh mesh = engines::lattice_mesh(reference::box(low, high));
    mesh.lattice = Lattice{exponent};
    return Solid::from_lattice_mesh(std::move(mesh), trisect::Embedding::Resolve);
}

TEST(LatticeMix, CoarseMeetsFine) {
    const Solid coarse = box_on(16, {0, 0, 0}, {1, 1, 1});      // edge 65,536
    const Solid middle = box_on(0, {-8, -8, -8}, {8, 8, 8});    // edge 16
    const Solid fine = box_on(-8, {0, 0, 0}, {128, 128, 128});  // edge 1/2
    EXPECT_EQ(evaluate(coarse - fine).lattice(), Lattice{-8});
    EXPECT_EQ(evaluate(coarse | middle).lattice(), Lattice{0});
    EXPECT_EQ(volume(fine), "1/8");
    EXPECT_EQ(volume(coarse - middle), "281474976710144");  // 2^48 - 8^3
    EXPECT_EQ(volume(coarse & fine), "1/8");
    EXPECT_EQ(volume(coarse - fine), "2251799813685247/8");
    EXPECT_EQ(volume((middle - coarse) - fine), "3584");  // 16^3 - 8^3
    EXPECT_EQ(volume(middle - fine), "32767/8");
}

TEST(LatticeMix, ResultsMoveAsWell) {
    // The cut cube has vertices off the lattice and a tree.
    trisect::EvaluateOptions options;
    options.leaf_polygons = 10;
    const Solid cut = evaluate(
        engines::solid(degeneracy::octahedron({0, 0, 0}, 9)) -
            engines::solid(reference::tetrahedron({1, 1, 1}, {12, 2, 1}, {3, 14, 2}, {2, 3, 17})),
        options);
    const Solid fine = box_on(-8, {-1, -1, -1}, {700, 800, 900});
    const auto whole = trisect::exact_volume(cut.to_brep());
    const auto common = trisect::exact_volume(evaluate(cut & fine, options).to_brep());
    const auto rest = trisect::exact_volume(evaluate(cut - fine, options).to_brep());
    EXPECT_EQ(common + rest, whole);
    EXPECT_GT(common.sign(), 0);
    const Solid moved = evaluate(cut | (fine & Solid()), options);
    EXPECT_TRUE(evaluate(moved ^ cut).to_brep().is_empty());
}

TEST(LatticeMix, FlushFacesStayFlush) {
    const Solid a = box_on(0, {0, 0, 0}, {2, 2, 2});
    const Solid b = box_on(-8, {512, 0, 0}, {1024, 512, 512});  // from x = 2 to 4
    const trisect::Brep joined = evaluate(a | b).to_brep();
    EXPECT_EQ(joined.counts().faces, 6U);
    EXPECT_EQ(trisect::exact_volume(joined).to_string(), "16");
    EXPECT_TRUE(evaluate(a & b).to_brep().is_empty());
    EXPECT_TRUE(evaluate(a ^ box_on(-8, {0, 0, 0}, {512, 512, 512})).is_empty());
}

TEST(LatticeMix, HalfSpacesMoveToo) {
    const Solid half = Solid::half_space(trisect::Plane(1, 0, 0, trisect::Plane::Coefficient(-1)),
                                         Lattice{0});  // x < 1
    const Solid fine = box_on(-8, {0, 0, 0}, {512, 512, 512});
    EXPECT_EQ(volume(fine & half), "4");
    const Solid fine_half = Solid::half_space(
        trisect::Plane(1, 0, 0, trisect::Plane::Coefficient(-128)), Lattice{-8});  // x < 1/2
    EXPECT_EQ(volume(box_on(0, {0, 0, 0}, {2, 2, 2}) & fine_half), "2");
}

TEST(LatticeMix, SetsWithoutBoundaryHaveNoLattice) {
    const Solid coarse = box_on(16, {0, 0, 0}, {1, 1, 1});
    EXPECT_EQ(evaluate(coarse | Solid()).lattice(), Lattice{16});
    EXPECT_EQ(evaluate(coarse & Solid::whole_space()).lattice(), Lattice{16});
}

// A cube of edge 2^k in units of 2^exponent.
Solid large_cube(int exponent, int k) {
    trisect::LatticeMesh mesh = engines::lattice_mesh(reference::box({0, 0, 0}, {1, 1, 1}));
    mesh.lattice = Lattice{exponent};
    for (trisect::LatticePoint& p : mesh.points)
        p = {p.x.to_integer() << k, p.y.to_integer() << k, p.z.to_integer() << k};
    return Solid::from_lattice_mesh(std::move(mesh));
}

TEST(LatticeMix, WhatHasNoRoomOnTheFinerLatticeGetsFractions) {
    // Edge 2^44 and unit 2^0: no room for the unit 2^-16.
    const Solid wide = large_cube(0, 44);
    const Solid fine = box_on(-16, {-65536, -65536, -65536}, {3 * 65536 + 1, 65536, 131072 - 1});
    trisect::EvaluateOptions refuse;
    refuse.lattices = trisect::EvaluateOptions::Lattices::Refuse;
    trisect::test::EvaluateStats stats;
    const Solid both = evaluate(wide & fine, refuse, &stats);
    EXPECT_EQ(both.lattice(), Lattice{0});
    EXPECT_EQ(stats.lattice.lattice, Lattice{0});
    EXPECT_TRUE(stats.lattice.lossless);
    // (3 + 2^-16) (2 - 2^-16)
    EXPECT_EQ(trisect::exact_volume(both.to_brep()).to_string(), "25769738239/4294967296");
}

TEST(LatticeMix, WhatDoesNotFitIsRoundedAndReported) {
    // Edge 2^52 and unit 2^24: no room for multiples of 2^-56.
    const Solid wide = large_cube(24, 28);
    const std::int64_t one = std::int64_t{1} << 40;
    const auto fine_box = [&](std::int64_t more) {
        trisect::LatticeMesh mesh = engines::lattice_mesh(reference::box({0, 0, 0}, {1, 1, 1}));
        mesh.lattice = Lattice{-56};
        for (trisect::LatticePoint& p : mesh.points)
            p = {p.x.to_integer() * (one + more), p.y.to_integer() * one, p.z.to_integer() * one};
        return Solid::from_lattice_mesh(std::move(mesh));
    };
    trisect::test::EvaluateStats stats;
    const Solid both = evaluate(wide & fine_box(0), {}, &stats);
    EXPECT_TRUE(stats.lattice.lossless);  // 2^-16, of few bits
    EXPECT_EQ(trisect::exact_volume(both.to_brep()), trisect::ExactRational(1).scaled(-48));
    const Solid whole = large_cube(72, 8);
    trisect::EvaluateOptions refuse;
    refuse.lattices = trisect::EvaluateOptions::Lattices::Refuse;
    EXPECT_THROW((void)evaluate(whole & fine_box(1), refuse), trisect::LimitError);
}

TEST(LatticeMix, ResultsAreRoundedByTheirBoundary) {
    const Solid wide = large_cube(0, 44);
    const Solid tool = box_on(-16, {1, 1, 1}, {65536 + 1, 65536 + 1, 65536 + 1});
    const Solid cut =
        evaluate(box_on(-16, {-65536, -65536, -65536}, {131072, 131072, 131072}) - tool);
    EXPECT_EQ(volume(cut & wide), "7");  // what was cut off by 2^-16 is 2^-8 units away
    // The complement of a bounded result keeps its outside.
    const Solid outside = evaluate(~cut);
    EXPECT_EQ(volume(outside & (wide - large_cube(0, 43))), volume(wide - large_cube(0, 43)));
    EXPECT_EQ(volume((outside | wide) & box_on(-8, {-256, -256, -256}, {256, 256, 256})), "1");
}

TEST(LatticeMix, HalfSpacesHaveAPlaceOnEveryLattice) {
    // x <= 2^-16, and no room for that unit: the half-space moves, exactly.
    const Solid half =
        Solid::half_space(trisect::Plane(1, 0, 0, trisect::Plane::Coefficient(-1)), Lattice{-16});
    const Solid cut = evaluate(half & large_cube(0, 44));
    EXPECT_EQ(cut.lattice(), Lattice{0});
    EXPECT_EQ(trisect::exact_volume(cut.to_brep()), trisect::ExactRational(1).scaled(88 - 16));
    const Solid coarse =
        Solid::half_space(trisect::Plane(1, 0, 0, trisect::Plane::Coefficient(-1)), Lattice{48});
    EXPECT_EQ(volume(coarse & box_on(-8, {0, 0, 0}, {256, 256, 256})), "1");
    EXPECT_EQ(volume(box_on(-8, {0, 0, 0}, {256, 256, 256}) - coarse), "0");
    // In the user's units.
    EXPECT_EQ(volume(Solid::half_space({0, 2, 0, -1}) & box_on(-8, {0, 0, 0}, {256, 256, 256})),
              "1/2");
    EXPECT_THROW((void)evaluate(Solid::half_space({1, 0, 0, -0x1p-500}) & large_cube(0, 44)),
                 trisect::LimitError);
}

// A mesh cut by a half-space, beside one so large that it has no room on the finer lattice.
TEST(LatticeMix, WhatAHalfSpaceCutOffMeetsLargerSolids) {
    const Solid part = evaluate(box_on(-16, {-65536, -65536, -65536}, {65537, 65536, 65536}) &
                                Solid::half_space({1, 1, 1, 0}));
    const Solid wide = large_cube(0, 44);
    trisect::EvaluateOptions refuse;
    refuse.lattices = trisect::EvaluateOptions::Lattices::Refuse;
    const auto volume_of = [&](const Expression& formula) {
        const Solid result = evaluate(formula, refuse);
        EXPECT_EQ(result.lattice(), Lattice{0});
        return trisect::exact_volume(result.to_brep());
    };
    const auto whole = trisect::exact_volume(wide.to_brep());
    for (const Solid& set : {part, evaluate(~part)})
        EXPECT_EQ(volume_of(wide & set) + volume_of(wide - set), whole);
    EXPECT_EQ(volume_of(wide | part),
              whole + trisect::exact_volume(part.to_brep()) - volume_of(wide & part));
}

TEST(LatticeMix, WhatWouldVanishIsRefused) {
    const Solid wide = large_cube(116, 50);
    const Solid fine = box_on(-8, {0, 0, 0}, {1, 1, 1});
    EXPECT_THROW((void)evaluate(wide - fine), trisect::LimitError);
    // Alone each of them is fine.
    EXPECT_FALSE(evaluate(wide | Solid()).is_empty());
}

}  // namespace
