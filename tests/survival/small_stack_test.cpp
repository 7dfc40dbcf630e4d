// SPDX-License-Identifier: Apache-2.0
//
// Everything that recurses, on input that makes it recurse as deeply as it can, with 256 KiB of
// stack. What is deep: formulas, chains of results, trees of slivers, polygons with many corners.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/prism.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/msp_tree.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

#include "support/small_stack.h"
#include "support/solids.h"

namespace {

using solids::box;
using trisect::Expression;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::test::run_with_small_stack;

Solid slab(double low, double high, double width) {
    return Solid::from_mesh(trisect::make_box({low, 0, 0}, {high, width, width}));
}

trisect::EvaluateOptions one_thread(std::uint32_t leaf_polygons = 100) {
    trisect::EvaluateOptions options;
    options.threads = 1;
    options.leaf_polygons = leaf_polygons;
    return options;
}

// Three operands, each used a thousand times; no operation undoes the one before.
Expression alternating(int levels) {
    const Solid a = box(0, 4);
    const Solid b = box(1, 5);
    const Solid c = box(2, 6);
    Expression e = a;
    for (int i = 1; i < levels; ++i) {
        switch (i % 3) {
            case 0:
                e = e | a;
                break;
            case 1:
                e = b - e;
                break;
            default:
                e = e ^ c;
        }
    }
    return e;
}

// The same, unit cube by unit cube.
int alternating_volume(int levels) {
    const auto in_box = [](int cell, int low) {
        const auto inside = [low](int c) { return c >= low && c < low + 4; };
        return inside(cell % 6) && inside(cell / 6 % 6) && inside(cell / 36);
    };
    int count = 0;
    for (int cell = 0; cell < 216; ++cell) {
        bool e = in_box(cell, 0);
        for (int i = 1; i < levels; ++i) {
            if (i % 3 == 0) {
                e = e || in_box(cell, 0);
            } else {
                e = i % 3 == 1 ? in_box(cell, 1) && !e : e != in_box(cell, 2);
            }
        }
        count += e ? 1 : 0;
    }
    return count;
}

TEST(SmallStack, FormulaOfAlternatingOperations) {
    EXPECT_EQ(run_with_small_stack([] {
                  const Solid s = evaluate(alternating(3000), one_thread());
                  EXPECT_EQ(trisect::volume(s.to_brep()), alternating_volume(3000));
              }),
              "");
}

TEST(SmallStack, FormulaThatIsTooDeepIsRefused) {
    const std::string message =
        run_with_small_stack([] { (void)evaluate(alternating(9000), one_thread()); });
    EXPECT_NE(message.find("4096"), std::string::npos) << message;
}

TEST(SmallStack, ChainOfAHundredThousandOperationsInOneFormula) {
    EXPECT_EQ(run_with_small_stack([] {
                  Expression e = box(0, 64);
                  const Solid tool = box(1, 2);
                  for (int i = 0; i < 100'000; ++i) e = e - tool;
                  EXPECT_EQ(trisect::volume(evaluate(e, one_thread()).to_brep()),
                            64. * 64 * 64 - 1);
              }),
              "");
}

// Each result is the operand of the next one: trees grow where the cuts are.
TEST(SmallStack, ChainOfResults) {
    EXPECT_EQ(run_with_small_stack([] {
                  Solid s = slab(0, 1 << 12, 4);
                  for (int i = 0; i < 400; ++i)
                      s = evaluate(s - slab(5 * i + 1, 5 * i + 2, 2), one_thread(6));
                  EXPECT_EQ(trisect::volume(s.to_brep()), 16. * (1 << 12) - 400 * 4);
                  EXPECT_EQ(trisect::BrepIndex(s).locate(std::array{1.5, 1., 1.}).location,
                            trisect::Location::Outside);
              }),
              "");
}

// Sizes fall by half: splitting planes trim off one slab after the other.
TEST(SmallStack, SlabsThatHalve) {
    EXPECT_EQ(run_with_small_stack([] {
                  std::vector<Expression> slabs;
                  for (int i = 0; i < 44; ++i)
                      slabs.emplace_back(slab(std::ldexp(1, i), std::ldexp(1.5, i), 1));
                  const Solid s = evaluate(Expression::any_of(slabs) - box(0, 1), one_thread(1));
                  EXPECT_GT(trisect::volume(s.to_brep()), 8e12);
              }),
              "");
}

// All facets meet in two corners: no wall separates them.
TEST(SmallStack, FansOfSlivers) {
    EXPECT_EQ(run_with_small_stack([] {
                  const PolygonMesh a = trisect::make_regular_prism(100, 1, 1);
                  PolygonMesh b = a;
                  for (auto& p : b.points) p[0] += 0.001;
                  const Solid s =
                      evaluate(Solid::from_mesh(a) & Solid::from_mesh(b), one_thread(4));
                  const trisect::Brep brep = s.to_brep();
                  EXPECT_GT(brep.faces().size(), 100U);
                  (void)trisect::MspTree::from_brep(brep);
                  (void)s.to_mesh();
              }),
              "");
}

TEST(SmallStack, PolygonOfManyCornersIsTriangulated) {
    EXPECT_EQ(run_with_small_stack([] {
                  const PolygonMesh mesh = trisect::make_regular_prism(1'500, 1000, 1);
                  const Solid s = Solid::from_mesh(mesh);
                  EXPECT_GT(trisect::volume(s.to_brep()), 3e6);
                  EXPECT_TRUE(trisect::validate(mesh).is_solid());
              }),
              "");
}

TEST(SmallStack, QueriesAndInterferenceOfAFineSphere) {
    EXPECT_EQ(
        run_with_small_stack([] {
            const Solid s = Solid::from_mesh(trisect::make_icosphere(1, 5));
            const trisect::BrepIndex index(s);
            index.refine();
            EXPECT_EQ(index.locate(std::array{0., 0., 0.}).location, trisect::Location::Inside);
            const trisect::InterferenceModel a(index);
            const trisect::InterferenceModel b(box(0, 1));
            EXPECT_EQ(interfere(a, trisect::Pose(), b, trisect::Pose()).relation,
                      trisect::Relation::Overlapping);
        }),
        "");
}

}  // namespace
