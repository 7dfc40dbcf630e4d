// SPDX-License-Identifier: Apache-2.0
//
// What must not matter: how faces are cut into triangles, in which order they come, and where in
// space, which way round and in which hand the operands lie.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

#include <trisect/brep/polygon_mesh.h>

#include "algebra.h"

namespace {

using algebra::difference;
using reference::LatticePoint;
using reference::Operand;
using trisect::Brep;
using trisect::evaluate;
using trisect::Solid;

using Pair = std::array<Operand, 2>;

std::array<Brep, 3> results(const Solid& a, const Solid& b,
                            const trisect::EvaluateOptions& options = {}) {
    return {evaluate(a | b, options).to_brep(), evaluate(a & b, options).to_brep(),
            evaluate(a - b, options).to_brep()};
}

Pair random_pair(std::uint64_t seed) {
    reference::Random random(seed);
    auto family = reference::random_family(random, 2);
    return {std::move(family[0]), std::move(family[1])};
}

template <class Map>
Operand mapped(Operand operand, Map&& map) {
    for (auto& triangle : operand)
        for (LatticePoint& p : triangle) p = map(p);
    return operand;
}

Operand scaled(const Operand& operand, std::int64_t factor) {
    return mapped(operand, [&](const LatticePoint& p) {
        return LatticePoint{p[0] * factor, p[1] * factor, p[2] * factor};
    });
}

LatticePoint middle(const LatticePoint& a, const LatticePoint& b) {
    return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

// Every edge halved, every triangle cut in four. Coordinates must be even.
Operand subdivided(const Operand& operand) {
    Operand out;
    for (const auto& [a, b, c] : operand) {
        const LatticePoint ab = middle(a, b);
        const LatticePoint bc = middle(b, c);
        const LatticePoint ca = middle(c, a);
        out.push_back({a, ab, ca});
        out.push_back({ab, b, bc});
        out.push_back({ca, bc, c});
        out.push_back({ab, bc, ca});
    }
    return out;
}

// Triangles in another order, each starting with another corner.
Operand shuffled(Operand operand, reference::Random& random) {
    for (std::size_t i = operand.size(); i > 1; --i)
        std::swap(operand[i - 1], operand[random.below(i)]);
    for (auto& t : operand)
        std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random.below(3)), t.end());
    return operand;
}

TEST(Invariance, SubdividedOperandsGiveTheSameMaximalFaces) {
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
        SCOPED_TRACE(seed);
        const auto [a, b] = random_pair(seed);
        const auto coarse = results(engines::solid(scaled(a, 2)), engines::solid(scaled(b, 2)));
        const auto options = algebra::options_of(seed);
        const auto fine = results(engines::solid(subdivided(scaled(a, 2))),
                                  engines::solid(scaled(b, 2)), options);
        const auto both = results(engines::solid(subdivided(scaled(a, 2))),
                                  engines::solid(subdivided(scaled(b, 2))), options);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(difference(fine[i], coarse[i]), "") << "result " << i;
            EXPECT_EQ(difference(both[i], coarse[i]), "") << "result " << i;
        }
    }
}

TEST(Invariance, TheOrderOfTrianglesAndCornersDoesNotShow) {
    for (std::uint64_t seed = 100; seed < 130; ++seed) {
        SCOPED_TRACE(seed);
        reference::Random random(seed);
        const auto [a, b] = random_pair(seed);
        const auto expected = results(engines::solid(a), engines::solid(b));
        const auto found = results(engines::solid(shuffled(a, random)),
                                   engines::solid(shuffled(b, random)), algebra::options_of(seed));
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(difference(found[i], expected[i]), "") << "result " << i;
    }
}

// Triangles with three points of their own, and every second one cut in two at the middle of an
// edge that its neighbour keeps whole: corners lie inside edges.
trisect::PolygonMesh soup_with_t_junctions(const Operand& operand) {
    trisect::PolygonMesh mesh;
    const auto add = [&](const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        for (const LatticePoint& p : {a, b, c})
            mesh.points.push_back(
                {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
        mesh.add_triangle(first, first + 1, first + 2);
    };
    for (std::size_t i = 0; i < operand.size(); ++i) {
        const auto& [a, b, c] = operand[i];
        if (i % 2 == 0) {
            add(a, b, c);
        } else {
            add(a, middle(a, b), c);
            add(middle(a, b), b, c);
        }
    }
    return mesh;
}

TEST(Invariance, CornersInsideEdgesDoNotShow) {
    trisect::SolidOptions import;
    import.embedding = trisect::Embedding::Resolve;
    import.import.lattice = trisect::Lattice{0};
    for (std::uint64_t seed = 200; seed < 225; ++seed) {
        SCOPED_TRACE(seed);
        reference::Random random(seed);
        const auto family = reference::random_family(random, 2, true);
        const Operand a = scaled(family[0], 2);
        const Operand b = scaled(family[1], 2);
        const auto expected = results(engines::solid(a), engines::solid(b));
        const auto found =
            results(Solid::from_mesh(soup_with_t_junctions(a), import),
                    Solid::from_mesh(soup_with_t_junctions(b), import), algebra::options_of(seed));
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(difference(found[i], expected[i]), "") << "result " << i;
    }
}

// ---------------------------------------------------------------------------------------------

// A signed permutation of the axes and a translation: coordinate i of the image is
// sign[i] · p[axis[i]] + shift[i].
struct Isometry {
    std::array<std::size_t, 3> axis{0, 1, 2};
    std::array<std::int64_t, 3> sign{1, 1, 1};
    std::array<std::int64_t, 3> shift{0, 0, 0};

    [[nodiscard]] bool reverses() const {
        const bool even = (axis[0] + 1) % 3 == axis[1] % 3;
        return (sign[0] * sign[1] * sign[2] > 0) != even;
    }
    [[nodiscard]] Operand operator()(const Operand& operand) const {
        Operand out = mapped(operand, [&](const LatticePoint& p) {
            LatticePoint q;
            for (std::size_t i = 0; i < 3; ++i) q[i] = sign[i] * p[axis[i]] + shift[i];
            return q;
        });
        return reverses() ? reference::reversed(std::move(out)) : out;
    }
    [[nodiscard]] std::vector<reference::Polygon> operator()(
        const std::vector<reference::Polygon>& polygons) const {
        std::vector<reference::Polygon> out;
        for (const reference::Polygon& p : polygons) {
            std::array<reference::Integer, 3> n;
            reference::Integer offset = p.plane.offset;
            for (std::size_t i = 0; i < 3; ++i) {
                n[i] = p.plane.normal[axis[i]] * reference::to_integer(sign[i]);
                offset -= n[i] * reference::to_integer(shift[i]);
            }
            reference::Polygon q{{n[0], n[1], n[2], offset}, {}};
            for (auto loop : p.loops) {
                for (auto& x : loop) {
                    const auto y = x;
                    for (std::size_t i = 0; i < 3; ++i)
                        x[i] = y[axis[i]] * reference::to_integer(sign[i]) +
                               reference::Rational(reference::to_integer(shift[i]));
                }
                if (reverses()) std::ranges::reverse(loop);
                q.loops.push_back(std::move(loop));
            }
            out.push_back(std::move(q));
        }
        return out;
    }
};

void check_commutes(const Isometry& map, std::uint64_t first_seed, std::uint64_t count) {
    for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
        SCOPED_TRACE(seed);
        const auto [a, b] = random_pair(seed);
        const auto plain = results(engines::solid(a), engines::solid(b));
        const auto moved =
            results(engines::solid(map(a)), engines::solid(map(b)), algebra::options_of(seed));
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(reference::explain_difference(
                          reference::canonical_boundary(map(engines::polygons(plain[i]))),
                          reference::canonical_boundary(engines::polygons(moved[i]))),
                      "")
                << "result " << i;
            EXPECT_EQ(plain[i].counts(), moved[i].counts()) << "result " << i;
        }
    }
}

TEST(Invariance, Translations) {
    check_commutes({.shift = {1, -7, 300}}, 300, 8);
    // Wide numbers: the coordinates take 50 bits.
    const std::int64_t far = (std::int64_t{1} << 50) - 12345;
    check_commutes({.shift = {far, -far + 99, far / 3}}, 310, 8);
}

TEST(Invariance, QuarterTurns) {
    check_commutes({.axis = {1, 0, 2}, .sign = {-1, 1, 1}}, 320, 8);
    check_commutes({.axis = {0, 2, 1}, .sign = {1, 1, -1}}, 330, 8);
    check_commutes({.axis = {2, 0, 1}}, 340, 8);
}

TEST(Invariance, Mirrors) {
    check_commutes({.sign = {-1, 1, 1}}, 350, 8);
    check_commutes({.axis = {1, 0, 2}}, 360, 8);
    check_commutes({.sign = {-1, -1, -1}}, 370, 8);
}

}  // namespace
