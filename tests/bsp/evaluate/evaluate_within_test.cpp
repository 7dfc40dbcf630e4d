// SPDX-License-Identifier: Apache-2.0
//
// What a formula is within a box, of operands that are closed anyhow beyond it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/evaluate_within.h>
#include <trisect/kernel/error.h>

namespace {

using trisect::evaluate;
using trisect::evaluate_within;
using trisect::Expression;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Solid;

std::vector<Expression> formulas(const Solid& a, const Solid& b) { return {a | b, a & b, a - b}; }

bool are_equal(const Solid& a, const Solid& b) { return evaluate(Expression(a) ^ b).is_empty(); }

Solid slab(double from, double to) {
    return Solid::from_mesh(trisect::make_box({from, -1024, -1024}, {to, 1024, 1024}));
}

// Boxes on a small grid, so that faces, edges and corners coincide.
Solid boxes(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto at = [&] { return static_cast<double>(random() % 8); };
    Solid out;
    for (int i = 0; i < 4; ++i) {
        const Point3d low{at(), at(), at()};
        const Point3d high{low[0] + 1 + at(), low[1] + 1 + at(), low[2] + 1 + at()};
        out = evaluate(out | Solid::from_mesh(trisect::make_box(low, high)));
    }
    return Solid::from_mesh(out.to_mesh());
}

TEST(EvaluateWithin, SlabsOfBoxesAreThoseOfTheWhole) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const Solid a = boxes(2 * seed);
        const Solid b = boxes(2 * seed + 1);
        const auto all = formulas(a, b);
        for (const Expression& formula : all) {
            const Solid whole = evaluate(formula);
            Solid joined;
            for (int i = 0; i < 5; ++i) {
                const Solid window =
                    slab(i == 0 ? -512 : 3 * i + 0.28125, i == 4 ? 512 : 3 * i + 3.28125);
                const Solid part = evaluate_within(window, formula);
                EXPECT_TRUE(are_equal(part, evaluate(Expression(window) & whole))) << seed;
                EXPECT_NO_THROW((void)part.to_brep());
                joined = evaluate(joined | part);
            }
            EXPECT_TRUE(are_equal(joined, evaluate(Expression(slab(-512, 15.28125)) & whole)));
        }
    }
}

// The triangles of a ball that come near the slab, closed by fans beyond it: each edge that lost
// its other triangle, and a corner on the same side.
TEST(EvaluateWithin, OperandsMayBeAnythingBeyondTheWindow) {
    const double from = -10.3125;
    const double to = 13.4375;
    const auto part_of = [&](const PolygonMesh& ball) {
        PolygonMesh out;
        out.points = ball.points;
        std::vector<std::array<std::uint32_t, 2>> open;
        for (std::size_t f = 0; f < ball.face_count(); ++f) {
            const auto face = ball.face(f);
            double low = 1e9;
            double high = -1e9;
            for (const std::uint32_t c : face) {
                low = std::min(low, ball.points[c][0]);
                high = std::max(high, ball.points[c][0]);
            }
            if (low > to + 3 || high < from - 3) continue;
            out.add_face(face);
            for (std::size_t i = 0; i < 3; ++i) {
                const std::array<std::uint32_t, 2> back{face[(i + 1) % 3], face[i]};
                const auto twin = std::ranges::find(open, back);
                if (twin != open.end())
                    open.erase(twin);
                else
                    open.push_back({face[i], face[(i + 1) % 3]});
            }
        }
        std::array<std::uint32_t, 2> apex{~0U, ~0U};
        for (const auto& e : open) {
            std::uint32_t& p = apex[ball.points[e[0]][0] > 0 ? 1 : 0];
            if (p == ~0U) p = e[0];
            if (e[0] == p || e[1] == p) continue;
            out.add_face(std::array<std::uint32_t, 3>{p, e[1], e[0]});
        }
        return out;
    };
    PolygonMesh first = trisect::make_icosphere(40, 4);
    PolygonMesh second = first;
    for (Point3d& p : second.points) p = {p[1] + 9.5, p[2] - 3.25, p[0] + 17.125};
    const Solid window = slab(from, to);
    const Solid a = Solid::from_mesh(first);
    const Solid b = Solid::from_mesh(second);
    trisect::SolidOptions options;
    const Solid part_a = Solid::from_mesh(part_of(first), options);
    const Solid part_b = Solid::from_mesh(part_of(second), options);
    const auto of_parts = formulas(part_a, part_b);
    const auto of_all = formulas(a, b);
    for (std::size_t i = 0; i < of_all.size(); ++i)
        EXPECT_TRUE(are_equal(evaluate_within(window, of_parts[i]),
                              evaluate(Expression(window) & of_all[i])));
}

TEST(EvaluateWithin, TakesMeshesAndABoxOnly) {
    const Solid ball = Solid::from_mesh(trisect::make_icosphere(40, 2));
    const Solid window = slab(1, 2);
    EXPECT_THROW((void)evaluate_within(ball, ball | window), trisect::UsageError);
    const Solid cut = evaluate(ball - slab(3.5, 4.5));
    EXPECT_THROW((void)evaluate_within(window, cut | ball), trisect::UsageError);
    EXPECT_TRUE(evaluate_within(window, Expression(Solid()) & ball).is_empty());
}

}  // namespace
