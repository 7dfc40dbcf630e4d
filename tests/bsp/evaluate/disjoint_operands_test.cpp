// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/disjoint_operands.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/evaluate/named_slots.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {
namespace {

Solid box_of(const Point3d& lo, const Point3d& hi, int exponent = -4) {
    SolidOptions options;
    options.import.lattice = Lattice{exponent};
    return Solid::from_mesh(make_box(lo, hi), options);
}

Residual::Kind kind_of(const Expression& e) {
    const Translation t = with_named_slots(translate_without_constants(e));
    return with_unions_of_disjoint(t).formula->kind;
}

Expression exclusive_or_of(const std::vector<Solid>& solids) {
    Expression e(solids[0]);
    for (std::size_t i = 1; i < solids.size(); ++i) e = e ^ solids[i];
    return e;
}

TEST(DisjointOperands, TilesAreAUnion) {
    const Solid a = box_of({0, 0, 0}, {1, 1, 1});
    const Solid b = box_of({1, 0, 0}, {2, 1, 1});
    const Solid c = box_of({0, 1, 0}, {1, 2, 1}, -7);
    EXPECT_EQ(kind_of(Expression(a) ^ b ^ c), Residual::Kind::Or);
    EXPECT_EQ(kind_of(Expression(a) ^ b), Residual::Kind::Xor);
    EXPECT_EQ(kind_of(Expression(a) ^ b ^ ~Expression(c)), Residual::Kind::Xor);
    EXPECT_EQ(kind_of(Expression(a) ^ b ^ (c | b)), Residual::Kind::Xor);
    EXPECT_EQ(kind_of(Expression(a) ^ b ^ evaluate(c | b)), Residual::Kind::Xor);
    const Solid all = evaluate(Expression(a) ^ b ^ c);
    EXPECT_EQ(exact_volume(all.to_brep()), exact_volume(evaluate(a | b | c).to_brep()));
}

// By the user's own doubles, on the lattices that they choose.
TEST(DisjointOperands, OverlapsOfFractionsCount) {
    const auto own = [](double lo, double hi) {
        return Solid::from_mesh(make_box({lo, 0, 0}, {hi, 1, 1}));
    };
    const double third = 1.0 / 3;
    const Solid a = own(0, third);
    const Solid c = own(5, 6);
    EXPECT_EQ(kind_of(Expression(a) ^ own(third, 1) ^ c), Residual::Kind::Or);
    EXPECT_EQ(kind_of(Expression(a) ^ own(std::nextafter(third, 1), 1) ^ c), Residual::Kind::Or);
    EXPECT_EQ(kind_of(Expression(a) ^ own(std::nextafter(third, 0), 1) ^ c), Residual::Kind::Xor);
}

// Among a thousand tiles the last one is not in its place.
TEST(DisjointOperands, OneOfManyThatOverlaps) {
    std::vector<Solid> tiles;
    for (int x = 0; x < 10; ++x)
        for (int y = 0; y < 10; ++y)
            for (int z = 0; z < 10; ++z)
                tiles.push_back(box_of({1.0 * x, 1.0 * y, 1.0 * z}, {x + 1.0, y + 1.0, z + 1.0}));
    EXPECT_EQ(kind_of(exclusive_or_of(tiles)), Residual::Kind::Or);
    tiles.push_back(box_of({9.5, 9.5, 9.5}, {12, 12, 12}));
    EXPECT_EQ(kind_of(exclusive_or_of(tiles)), Residual::Kind::Xor);
}

// Boxes and prisms on a small grid, against one exclusive or after the other.
TEST(DisjointOperands, SetsAreThoseOfPairs) {
    std::mt19937 random(9);
    int unions = 0;
    for (int turn = 0; turn < 300; ++turn) {
        SCOPED_TRACE("turn " + std::to_string(turn));
        std::vector<Solid> solids;
        const std::size_t count = 3 + random() % 3;
        while (solids.size() < count) {
            const auto at = [&] { return static_cast<double>(random() % 4); };
            const Point3d lo{at(), at(), at()};
            const bool is_box = random() % 2 == 0;
            const PolygonMesh mesh =
                is_box ? make_box(lo, {lo[0] + 1, lo[1] + 1, lo[2] + 1})
                       : transformed(make_cylinder(0.5, 1, 8),
                                     AffineMap::translation({lo[0] + 0.5, lo[1] + 0.5, lo[2]}));
            SolidOptions options;
            options.import.lattice = Lattice{-8};
            solids.push_back(Solid::from_mesh(mesh, options));
        }
        const Expression e = exclusive_or_of(solids);
        unions += kind_of(e) == Residual::Kind::Or ? 1 : 0;
        Solid chain = solids[0];
        for (std::size_t i = 1; i < count; ++i) chain = evaluate(Expression(chain) ^ solids[i]);
        const Brep all = evaluate(e).to_brep();
        const Brep expected = chain.to_brep();
        EXPECT_EQ(exact_volume(all), exact_volume(expected));
        EXPECT_EQ(all.counts(), expected.counts());
    }
    EXPECT_GT(unions, 50);
}

}  // namespace
}  // namespace trisect::detail
