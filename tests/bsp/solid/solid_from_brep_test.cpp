// SPDX-License-Identifier: Apache-2.0
//
// Exact boundaries as operands: cut at lattice points and elsewhere, with holes and cavities, on
// other lattices, again and again; against the same formulas without the way through a boundary.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <trisect/brep/io/exact_boundary.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/solids.h"

namespace {

using solids::box;
using trisect::AssembleOptions;
using trisect::Brep;
using trisect::Embedding;
using trisect::Expression;
using trisect::Solid;

// Through the file.
Solid again(const Solid& s, Embedding embedding = Embedding::Assume) {
    return Solid::from_brep(trisect::read_exact(trisect::exact_text(s.to_brep()), "again"),
                            embedding);
}

bool are_equal(const Solid& a, const Solid& b) {
    return evaluate(Expression(a) ^ Expression(b)).is_empty();
}

// A text says all of a boundary but where its faces came from.
std::string shape(const Solid& s) { return trisect::exact_volume(s.to_brep()).to_string(); }

// Five-sided cuts through a ball: nearly all corners of the result are off the lattice.
Solid cut_ball() {
    const Solid ball = Solid::from_mesh(trisect::make_icosphere(1, 1));
    const Solid torus = Solid::from_mesh(trisect::make_torus(1, 0.3, 7, 5));
    return evaluate(Expression(ball) - Expression(torus));
}

TEST(SolidFromBrep, OfLatticeCorners) {
    const Solid s =
        evaluate(Expression(box(0, 0, 0, 4, 4, 4)) - Expression(box(1, 1, -1, 2, 2, 5)) -
                 Expression(box(3, 3, 3, 5, 5, 5)));
    const Solid t = again(s);
    EXPECT_TRUE(are_equal(s, t));
    EXPECT_EQ(shape(t), shape(s));
}

TEST(SolidFromBrep, OfCornersOffTheLattice) {
    const Solid s = cut_ball();
    bool off = false;
    const Brep brep = s.to_brep();
    for (const trisect::Point& p : brep.points()) off = off || !p.is_lattice();
    ASSERT_TRUE(off);
    const Solid t = again(s);
    EXPECT_TRUE(are_equal(s, t));
    EXPECT_EQ(shape(t), shape(s));
    EXPECT_TRUE(are_equal(s, again(s, Embedding::Resolve)));
    // The same maximal faces; only their origin is another one.
    EXPECT_EQ(t.to_brep().faces().size(), brep.faces().size());
    EXPECT_EQ(t.to_brep().vertices().size(), brep.vertices().size());
}

TEST(SolidFromBrep, OfWholeFacetsWithHoles) {
    // A ball drilled by a slanted prism: faces with holes whose corners are off the lattice.
    const Solid block = box(-4, -4, -1, 4, 4, 1);
    const Solid cone = Solid::from_mesh(trisect::make_icosphere(1.5, 0));
    const Solid s = evaluate(Expression(block) - Expression(cone));
    EXPECT_EQ(shape(again(s)), shape(s));
    EXPECT_TRUE(are_equal(again(s), s));
}

TEST(SolidFromBrep, IsAnOperandLikeAnyOther) {
    const Solid s = cut_ball();
    const Solid t = again(s);
    const std::vector<Solid> others{box(0, -2, -2, 2, 2, 2), box(-0.5, -0.5, -2, 0.5, 0.5, 2),
                                    Solid::from_mesh(trisect::make_icosphere(0.75, 2)), s};
    for (const Solid& o : others) {
        EXPECT_TRUE(are_equal(evaluate(Expression(t) | Expression(o)),
                              evaluate(Expression(s) | Expression(o))));
        EXPECT_TRUE(are_equal(evaluate(Expression(t) & Expression(o)),
                              evaluate(Expression(s) & Expression(o))));
        EXPECT_TRUE(are_equal(evaluate(Expression(o) - Expression(t)),
                              evaluate(Expression(o) - Expression(s))));
    }
    EXPECT_TRUE(evaluate(Expression(t) & ~Expression(t)).is_empty());
    EXPECT_TRUE(evaluate(Expression(t) | ~Expression(t)).is_whole_space());
}

TEST(SolidFromBrep, OnAFinerLattice) {
    const Solid s = evaluate(Expression(box(0, 0, 0, 8, 8, 8)) -
                             Expression(Solid::from_mesh(trisect::make_icosphere(5, 0))));
    const Solid fine = box(1 + 0x1p-36, 1, 1, 9, 9, 9);
    EXPECT_TRUE(are_equal(evaluate(Expression(again(s)) & Expression(fine)),
                          evaluate(Expression(s) & Expression(fine))));
    const Brep brep = evaluate(Expression(again(s)) & Expression(fine)).to_brep();
    EXPECT_EQ(trisect::exact_volume(brep),
              trisect::exact_volume(evaluate(Expression(s) & Expression(fine)).to_brep()));
}

TEST(SolidFromBrep, MayBeRefinedAndAsked) {
    const Solid s = cut_ball();
    const Solid t = again(s);
    t.refine();
    EXPECT_TRUE(are_equal(s, t));
    const trisect::BrepIndex of_s(s);
    const trisect::BrepIndex of_t(t);
    for (int i = 0; i < 1000; ++i) {
        const trisect::Point3d p{-1.25 + 0.25 * (i % 10), -1.25 + 0.25 * (i / 10 % 10),
                                 -1.25 + 0.25 * (i / 100)};
        EXPECT_EQ(of_s.locate(p).location, of_t.locate(p).location) << i;
    }
}

TEST(SolidFromBrep, OfFacesThatAreNotJoined) {
    AssembleOptions as_they_came;
    as_they_came.maximal_faces = false;
    const Solid s = evaluate(Expression(box(0, 0, 0, 4, 4, 4)) | Expression(box(4, 1, 1, 8, 4, 4)));
    const Solid t = Solid::from_brep(s.to_brep(as_they_came));
    EXPECT_TRUE(are_equal(s, t));
}

TEST(SolidFromBrep, InsideOutIsRefused) {
    const Brep brep = evaluate(~Expression(cut_ball())).to_brep();
    EXPECT_THROW((void)Solid::from_brep(brep), trisect::Error);
    EXPECT_TRUE(Solid::from_brep(Brep()).is_empty());
}

// Chains of random solids on a small grid, each step through a file.
TEST(SolidFromBrep, ChainsOnASmallGrid) {
    reference::Random random(17);
    int off = 0;
    for (int round = 0; round < 60; ++round) {
        Solid direct = engines::solid(reference::random_embedded_solid(random));
        Solid filed = direct;
        for (int step = 0; step < 4; ++step) {
            const Solid next = engines::solid(reference::random_embedded_solid(random));
            const auto apply = [&](const Solid& s) {
                if (step % 3 == 0) return evaluate(Expression(s) | Expression(next));
                if (step % 3 == 1) return evaluate(Expression(s) ^ Expression(next));
                return evaluate(Expression(s) - Expression(next));
            };
            direct = apply(direct);
            filed = again(apply(filed));
        }
        const Brep brep = direct.to_brep();
        for (const trisect::Point& p : brep.points()) off += p.is_lattice() ? 0 : 1;
        EXPECT_TRUE(are_equal(direct, filed)) << round;
        EXPECT_EQ(shape(filed), shape(direct)) << round;
        EXPECT_EQ(filed.to_brep().faces().size(), brep.faces().size()) << round;
    }
    EXPECT_GT(off, 1000);
}

}  // namespace
