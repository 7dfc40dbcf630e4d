// SPDX-License-Identifier: Apache-2.0
//
// Booleans of meshes that nothing needs to cut, against sets of tetrahedra: two random sets of the
// tetrahedra of one complex have boundaries that meet in corners, edges and facets of both, and
// what a boolean of them bounds follows from the sets.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/evaluate_all.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/stop_scope.h>

namespace {

using trisect::Diagnostics;
using trisect::evaluate;
using trisect::EvaluateCounters;
using trisect::Expression;
using trisect::PolygonMesh;
using trisect::Solid;

using Corner = std::array<double, 3>;
using Tetrahedron = std::array<Corner, 4>;
using Triangle = std::array<Corner, 3>;  // its least corner first

// Six for each cube of a grid, all along its diagonal; sheared, so that no facet is across an axis,
// and with fractions if need be.
std::vector<Tetrahedron> complex_of(int side, double unit) {
    std::vector<Tetrahedron> out;
    const auto placed = [&](const std::array<int, 3>& p) -> Corner {
        return {unit * (7 * p[0] + 2 * p[1] + p[2]), unit * (-p[0] + 8 * p[1] + 3 * p[2]),
                unit * (2 * p[0] - p[1] + 9 * p[2])};
    };
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            for (int z = 0; z < side; ++z) {
                std::array<std::size_t, 3> axes{0, 1, 2};
                do {
                    std::array<int, 3> p{x, y, z};
                    Tetrahedron t;
                    t[0] = placed(p);
                    for (std::size_t k = 0; k < 3; ++k) {
                        ++p[axes[k]];
                        t[k + 1] = placed(p);
                    }
                    const int inversions =
                        int{axes[0] > axes[1]} + int{axes[1] > axes[2]} + int{axes[0] > axes[2]};
                    if (inversions % 2 != 0) std::swap(t[2], t[3]);
                    out.push_back(t);
                } while (std::ranges::next_permutation(axes).found);
            }
    return out;
}

Triangle triangle(const Corner& a, const Corner& b, const Corner& c) {
    Triangle t{a, b, c};
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    return t;
}

// Seen from outside.
std::array<Triangle, 4> facets_of(const Tetrahedron& t) {
    return {triangle(t[0], t[2], t[1]), triangle(t[0], t[1], t[3]), triangle(t[1], t[2], t[3]),
            triangle(t[2], t[0], t[3])};
}

std::set<Triangle> boundary(const std::vector<Tetrahedron>& all, const std::vector<bool>& chosen) {
    std::set<Triangle> out;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!chosen[i]) continue;
        for (const Triangle& t : facets_of(all[i]))
            if (out.erase(triangle(t[0], t[2], t[1])) == 0) out.insert(t);
    }
    return out;
}

PolygonMesh mesh_of(const std::set<Triangle>& triangles) {
    PolygonMesh out;
    std::map<Corner, std::uint32_t> numbers;
    for (const Triangle& t : triangles) {
        std::vector<std::uint32_t> face;
        for (const Corner& c : t) {
            const auto next = static_cast<std::uint32_t>(numbers.size());
            const auto [at, is_new] = numbers.insert({c, next});
            if (is_new) out.points.push_back({c[0], c[1], c[2]});
            face.push_back(at->second);
        }
        out.add_face(face);
    }
    return out;
}

std::set<Triangle> triangles_of(const PolygonMesh& mesh) {
    std::set<Triangle> out;
    const auto at = [&](std::uint32_t i) -> Corner {
        return {mesh.points[i][0], mesh.points[i][1], mesh.points[i][2]};
    };
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        out.insert(triangle(at(mesh.face(f)[0]), at(mesh.face(f)[1]), at(mesh.face(f)[2])));
    EXPECT_EQ(out.size(), mesh.face_count());
    return out;
}

// By the names of points: each edge is used as often one way as the other.
void expect_closed(const PolygonMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.face(f)[k];
            const std::uint32_t b = mesh.face(f)[(k + 1) % 3];
            uses[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    for (const auto& use : uses) EXPECT_EQ(use.second, 0);
}

struct ResultCounts {
    int conforming = 0;
    int all = 0;
};

struct RandomSets {
    std::vector<Tetrahedron> all;
    std::array<std::vector<bool>, 2> chosen;
    std::array<Solid, 2> solids;

    RandomSets(std::uint32_t seed, double unit, double part) : all(complex_of(3, unit)) {
        std::mt19937 random(seed);
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t k = 0; k < all.size(); ++k)
                chosen[i].push_back(std::generate_canonical<double, 32>(random) < part);
            solids[i] = Solid::from_mesh(mesh_of(boundary(all, chosen[i])));
        }
    }
    template <class Rule>
    [[nodiscard]] std::set<Triangle> expected(const Rule& rule) const {
        std::vector<bool> both(all.size());
        for (std::size_t k = 0; k < all.size(); ++k) both[k] = rule(chosen[0][k], chosen[1][k]);
        return boundary(all, both);
    }
};

// The mesh has the facets that bound the set where nothing is cut; else it is the same set.
void expect_set(const Expression& formula, const std::set<Triangle>& expected,
                ResultCounts& counts) {
    const Diagnostics<EvaluateCounters> diagnostics;
    const Solid solid = evaluate(formula);
    const PolygonMesh mesh = solid.to_mesh();
    const bool is_conforming = diagnostics.counters().conforming_pairs == 1;
    ++counts.all;
    counts.conforming += is_conforming ? 1 : 0;
    if (is_conforming) {
        EXPECT_EQ(triangles_of(mesh), expected);
        EXPECT_EQ(diagnostics.counters().cells, 0U);
    }
    expect_closed(mesh);
    const Solid same = Solid::from_mesh(mesh_of(expected));
    EXPECT_EQ(exact_volume(solid), exact_volume(same));
    EXPECT_EQ(exact_volume(evaluate(solid ^ same)), 0);
}

TEST(ConformingMeshes, GiveTheFacetsOfSetsOfTetrahedra) {
    ResultCounts counts;
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        const double unit = seed % 3 == 0 ? 1.0 / 3 : 1;
        const RandomSets sets(seed, unit, seed % 2 == 0 ? 0.5 : 0.15);
        const Expression a(sets.solids[0]);
        const Expression b(sets.solids[1]);
        expect_set(a | b, sets.expected([](bool x, bool y) { return x || y; }), counts);
        expect_set(a & b, sets.expected([](bool x, bool y) { return x && y; }), counts);
        expect_set(a - b, sets.expected([](bool x, bool y) { return x && !y; }), counts);
        expect_set(b - a, sets.expected([](bool x, bool y) { return !x && y; }), counts);
    }
    EXPECT_GT(2 * counts.conforming, counts.all);
}

TEST(ConformingMeshes, GiveMaximalFacesThatAreThoseOfCells) {
    for (std::uint32_t seed = 100; seed < 104; ++seed) {
        const RandomSets sets(seed, 1, 0.3);
        for (const Expression& formula :
             {Expression(sets.solids[0]) | sets.solids[1], sets.solids[0] - sets.solids[1]}) {
            const Solid solid = evaluate(formula);
            const auto brep = solid.to_brep();
            const trisect::StopScope by_cells({.max_work = std::uint64_t{1} << 60});
            const auto expected = evaluate(formula).to_brep();
            EXPECT_EQ(brep.counts(), expected.counts());
        }
    }
}

TEST(ConformingMeshes, AreLookedAtOnceForSeveralFormulas) {
    const PolygonMesh torus = trisect::make_torus(0.7, 0.3, 24, 12);
    const Solid a = Solid::from_mesh(torus);
    PolygonMesh image;
    image.points = torus.points;
    for (auto& p : image.points) p[0] = -p[0];
    for (std::size_t f = 0; f < torus.face_count(); ++f) {
        const auto face = torus.face(f);
        image.add_face(std::vector<std::uint32_t>(face.rbegin(), face.rend()));
    }
    const Solid b = Solid::from_mesh(image);
    const Diagnostics<EvaluateCounters> diagnostics;
    const std::vector<Expression> formulas{a | b, a & b, a - b, b - a, a ^ b};
    const std::vector<Solid> together = evaluate_all(formulas);
    EXPECT_GE(diagnostics.counters().conforming_pairs, 4U);
    for (std::size_t i = 0; i < formulas.size(); ++i) {
        const PolygonMesh one = evaluate(formulas[i]).to_mesh();
        const PolygonMesh other = together[i].to_mesh();
        EXPECT_EQ(one.corners, other.corners);
        EXPECT_TRUE(one.points == other.points);
        expect_closed(one);
    }
    const auto volume = [&](std::size_t i) { return exact_volume(together[i]); };
    EXPECT_EQ(volume(0) + volume(1), exact_volume(a) + exact_volume(b));
    EXPECT_EQ(volume(1) + volume(2), exact_volume(a));
    EXPECT_EQ(volume(4), volume(2) + volume(3));
}

// A mesh of many facets that has a few in common with another one: the sides of all others follow
// from these.
TEST(ConformingMeshes, HaveSidesFarFromTheirCommonFaces) {
    const auto grid = [](double z, int n) {
        // A box whose faces are cut into n by n squares.
        PolygonMesh out;
        std::map<std::array<int, 3>, std::uint32_t> numbers;
        const auto number = [&](std::array<int, 3> p) {
            const auto [at, is_new] =
                numbers.insert({p, static_cast<std::uint32_t>(numbers.size())});
            if (is_new)
                out.points.push_back({static_cast<double>(p[0]), static_cast<double>(p[1]),
                                      z + static_cast<double>(p[2])});
            return at->second;
        };
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const int level : {0, n})
                for (int i = 0; i < n; ++i)
                    for (int k = 0; k < n; ++k) {
                        std::vector<std::uint32_t> loop;
                        for (const auto& [u, v] :
                             {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
                            std::array<int, 3> p{};
                            p[axis] = level;
                            p[(axis + 1) % 3] = i + u;
                            p[(axis + 2) % 3] = k + v;
                            loop.push_back(number(p));
                        }
                        if (level == 0) std::reverse(loop.begin(), loop.end());
                        out.add_face(loop);
                    }
        return out;
    };
    constexpr int n = 12;
    const Solid below = Solid::from_mesh(grid(0, n));
    const Solid above = Solid::from_mesh(grid(n, n));
    const Diagnostics<EvaluateCounters> diagnostics;
    const Solid both = evaluate(below | above);
    const Solid rest = evaluate(below - above);
    const Solid common = evaluate(below & above);
    EXPECT_EQ(exact_volume(both), 2 * n * n * n);
    EXPECT_EQ(exact_volume(rest), n * n * n);
    EXPECT_TRUE(common.is_empty());
    // The faces in which they stand on each other vanish from both parts.
    const Solid either = evaluate(below ^ above);
    EXPECT_EQ(exact_volume(either), 2 * n * n * n);
    EXPECT_EQ(either.to_brep().counts().faces, 6U);
    EXPECT_EQ(diagnostics.counters().conforming_pairs, 5U);
    EXPECT_EQ(both.to_brep().counts().faces, 6U);
    expect_closed(both.to_mesh());
}

}  // namespace
