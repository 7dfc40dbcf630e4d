// SPDX-License-Identifier: Apache-2.0
//
// Formulas of boxes whose coordinates are any doubles. What they give depends on the order of the
// coordinates alone: a table of the units between them has its volume, and the same boxes with
// the numbers of the coordinates instead have its boundary.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <trisect/brep/measure.h>

#include "engines/evaluate_stats.h"

namespace {

using trisect::Brep;
using trisect::ExactRational;
using trisect::Expression;
using trisect::Lattice;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::test::evaluate;
using trisect::test::EvaluateStats;

using Random = std::mt19937_64;
using Ranks = std::array<int, 3>;
using Coordinates = std::vector<double>;  // sorted

std::size_t below(Random& random, std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

enum class Kind { Decimals, OneUlpApart, AnyDoubles, ManyBits, TooManyBits };

double one(Random& random, Kind kind) {
    const auto k = static_cast<double>(below(random, 200));
    switch (kind) {
        case Kind::Decimals:
            return k / 10;
        case Kind::OneUlpApart:
            return below(random, 2) == 0 ? k / 10 : std::nextafter((k + 1) / 10, 100);
        case Kind::AnyDoubles:
            return std::uniform_real_distribution<double>(-1, 1)(random);
        default: {
            // Below the unit of the lattice, 2^-53 of the extent.
            const int bits = kind == Kind::ManyBits ? 66 : 71;
            return below(random, 3) == 0 ? k : std::ldexp(2 * k + 1, 9 - 53 - bits);
        }
    }
}

Coordinates coordinates(Random& random, Kind kind, std::size_t n) {
    std::set<double> all;
    while (all.size() < n) all.insert(one(random, kind));
    if (kind == Kind::ManyBits || kind == Kind::TooManyBits) all.insert(256);
    return {all.begin(), all.end()};
}

/// A box between coordinates of these ranks, with some of those between in its faces.
struct RankBox {
    Ranks low{};
    Ranks high{};
    std::array<std::vector<int>, 3> lines;
};

std::pair<int, int> interval(Random& random, int n) {
    const auto a = static_cast<int>(below(random, static_cast<std::size_t>(n)));
    const auto b = static_cast<int>(below(random, static_cast<std::size_t>(n) - 1));
    return std::minmax(a, b >= a ? b + 1 : b);
}

RankBox random_box(Random& random, const std::array<int, 3>& counts) {
    RankBox out;
    for (std::size_t k = 0; k < 3; ++k) {
        std::tie(out.low[k], out.high[k]) = interval(random, counts[k]);
        for (int i = out.low[k]; i <= out.high[k]; ++i)
            if (i == out.low[k] || i == out.high[k] || below(random, 4) == 0)
                out.lines[k].push_back(i);
    }
    return out;
}

/// The faces cut into rectangles, and these along either diagonal.
class BoxSurface {
public:
    BoxSurface(const RankBox& box, Random& random) : box_(box), random_(random) {
        for (std::size_t k = 0; k < 3; ++k)
            for (const bool is_high : {false, true}) add_face(k, is_high);
    }
    [[nodiscard]] PolygonMesh at(const std::array<Coordinates, 3>& coordinates) const {
        PolygonMesh out;
        for (const Ranks& r : points_) {
            trisect::Point3d& p = out.points.emplace_back();
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = coordinates[k][static_cast<std::size_t>(r[k])];
        }
        for (const auto& t : triangles_) out.add_triangle(t[0], t[1], t[2]);
        return out;
    }

private:
    std::uint32_t vertex(const Ranks& r) {
        const auto [it, is_new] = numbers_.emplace(r, static_cast<std::uint32_t>(points_.size()));
        if (is_new) points_.push_back(r);
        return it->second;
    }
    void add_face(std::size_t k, bool is_high) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        for (std::size_t i = 1; i < box_.lines[u].size(); ++i)
            for (std::size_t j = 1; j < box_.lines[v].size(); ++j) {
                const auto corner = [&](std::size_t a, std::size_t b) {
                    Ranks r{};
                    r[k] = is_high ? box_.high[k] : box_.low[k];
                    r[u] = box_.lines[u][i - a];
                    r[v] = box_.lines[v][j - b];
                    return vertex(r);
                };
                std::array<std::uint32_t, 4> loop{corner(1, 1), corner(0, 1), corner(0, 0),
                                                  corner(1, 0)};
                if (!is_high) std::ranges::reverse(loop);
                const std::size_t s = below(random_, 2);
                triangles_.push_back({loop[s], loop[s + 1], loop[s + 2]});
                triangles_.push_back({loop[s], loop[s + 2], loop[(s + 3) % 4]});
            }
    }

    const RankBox& box_;
    Random& random_;
    std::map<Ranks, std::uint32_t> numbers_;
    std::vector<Ranks> points_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

/// A formula over boxes, three times: of doubles, of ranks, and as a table of units.
struct Formula {
    Expression doubles;
    Expression ranks;
    std::vector<bool> units;
};

class Scene {
public:
    Scene(std::uint64_t seed, Kind kind, std::size_t n, bool in_steps)
        : random_(seed), in_steps_(in_steps) {
        for (std::size_t k = 0; k < 3; ++k) {
            doubles_[k] = coordinates(random_, kind, n);
            counts_[k] = static_cast<int>(doubles_[k].size());
            for (int i = 0; i < counts_[k]; ++i) numbers_[k].push_back(i);
        }
        options_.leaf_polygons = below(random_, 2) == 0 ? 12 : 512;
    }

    [[nodiscard]] Formula formula(std::size_t operands) {
        if (operands == 1) return operand();
        const std::size_t first = 1 + below(random_, operands - 1);
        Formula a = formula(first);
        const Formula b = formula(operands - first);
        const std::size_t op = below(random_, 4);
        for (std::size_t i = 0; i < a.units.size(); ++i) {
            const bool p = a.units[i];
            const bool q = b.units[i];
            a.units[i] = op == 0 ? p || q : op == 1 ? p && q : op == 2 ? p && !q : p != q;
        }
        const auto apply = [&](const Expression& p, const Expression& q) {
            const Expression r = op == 0 ? p | q : op == 1 ? p & q : op == 2 ? p - q : p ^ q;
            return in_steps_ ? Expression(trisect::evaluate(r, options_)) : r;
        };
        a.doubles = apply(a.doubles, b.doubles);
        a.ranks = apply(a.ranks, b.ranks);
        return a;
    }

    void check(const Formula& f, EvaluateStats& stats) const {
        const Solid result = evaluate(f.doubles, options_, &stats);
        const Brep brep = result.to_brep();
        const Brep expected = trisect::evaluate(f.ranks, options_).to_brep();
        EXPECT_EQ(trisect::exact_volume(brep), volume(f.units));
        EXPECT_EQ(trisect::exact_volume(result.to_brep({.maximal_faces = false})), volume(f.units));
        EXPECT_EQ(trisect::exact_volume(result.to_exact_mesh()), volume(f.units));
        EXPECT_EQ(brep.faces().size(), expected.faces().size());
        EXPECT_EQ(brep.edges().size(), expected.edges().size());
        EXPECT_EQ(vertices(brep, doubles_), vertices(expected, numbers_));
    }

private:
    [[nodiscard]] Formula operand() {
        const RankBox box = random_box(random_, counts_);
        const BoxSurface surface(box, random_);
        Formula out{Expression(Solid::from_mesh(surface.at(doubles_))),
                    Expression(Solid::from_mesh(surface.at(numbers_))),
                    {}};
        for_each_unit([&](const Ranks& r) {
            bool inside = true;
            for (std::size_t k = 0; k < 3; ++k)
                inside = inside && r[k] >= box.low[k] && r[k] < box.high[k];
            out.units.push_back(inside);
        });
        return out;
    }
    template <class Visit>
    void for_each_unit(Visit visit) const {
        for (int x = 0; x + 1 < counts_[0]; ++x)
            for (int y = 0; y + 1 < counts_[1]; ++y)
                for (int z = 0; z + 1 < counts_[2]; ++z) visit(Ranks{x, y, z});
    }
    [[nodiscard]] ExactRational volume(const std::vector<bool>& units) const {
        ExactRational sum;
        std::size_t i = 0;
        for_each_unit([&](const Ranks& r) {
            if (!units[i++]) return;
            ExactRational product(1);
            for (std::size_t k = 0; k < 3; ++k) {
                const auto at = static_cast<std::size_t>(r[k]);
                product *= ExactRational::from_double(doubles_[k][at + 1]) -
                           ExactRational::from_double(doubles_[k][at]);
            }
            sum += product;
        });
        return sum;
    }
    [[nodiscard]] static std::multiset<Ranks> vertices(const Brep& brep,
                                                       const std::array<Coordinates, 3>& all) {
        std::multiset<Ranks> out;
        for (const trisect::VertexId v : brep.vertices()) {
            const auto p = brep.point(v).nearest();
            Ranks r{};
            for (std::size_t k = 0; k < 3; ++k) {
                const double c = brep.lattice().to_double(p[k]);
                const auto it = std::ranges::lower_bound(all[k], c);
                EXPECT_TRUE(it != all[k].end() && *it == c) << c;
                r[k] = static_cast<int>(it - all[k].begin());
            }
            out.insert(r);
        }
        return out;
    }

    mutable Random random_;
    bool in_steps_;
    std::array<Coordinates, 3> doubles_;
    std::array<Coordinates, 3> numbers_;
    std::array<int, 3> counts_{};
    trisect::EvaluateOptions options_;
};

class RandomBoxFormulas : public testing::TestWithParam<std::tuple<Kind, bool>> {};

TEST_P(RandomBoxFormulas, DependOnTheOrderOfCoordinates) {
    const auto [kind, in_steps] = GetParam();
    EvaluateStats sum;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        Scene scene(seed, kind, 4 + seed % 9, in_steps);
        EvaluateStats stats;
        scene.check(scene.formula(2 + seed % 7), stats);
        sum.grid_leaves += stats.grid_leaves;
        sum.exact_leaves += stats.exact_leaves;
        if (HasFailure()) break;
    }
    if (kind == Kind::TooManyBits || in_steps) return;
    EXPECT_GT(sum.grid_leaves, 20U);
    EXPECT_EQ(sum.exact_leaves, 0U);
}

/// Boxes of small integers.
RankBox box_of(const std::array<std::vector<int>, 3>& lines) {
    RankBox out;
    for (std::size_t k = 0; k < 3; ++k) {
        out.low[k] = lines[k].front();
        out.high[k] = lines[k].back();
    }
    out.lines = lines;
    return out;
}

/// Checks the volume for many choices of diagonals. `formula` gets solids from make(lines).
template <class MakeFormula>
void check_with_all_diagonals(const MakeFormula& formula, std::int64_t volume) {
    const Coordinates numbers{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    trisect::EvaluateOptions options;
    options.leaf_polygons = 4;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        const auto make = [&](const std::array<std::vector<int>, 3>& lines) {
            const RankBox box = box_of(lines);
            return Expression(
                Solid::from_mesh(BoxSurface(box, random).at({numbers, numbers, numbers})));
        };
        const Solid result = trisect::evaluate(formula(make), options);
        EXPECT_EQ(trisect::exact_volume(result.to_brep()), ExactRational(volume));
        EXPECT_EQ(trisect::exact_volume(result.to_exact_mesh()), ExactRational(volume));
    }
}

// One cell has a facet of the last box with both facings, and another operand's facet stands for
// part of it; the next cell lists the facet whole.
TEST(BoxFormulas, FacetsBoundWithBothFacings) {
    check_with_all_diagonals(
        [](const auto& make) {
            return (make({{{0, 2}, {2, 3}, {2, 3}}}) - make({{{0, 1}, {0, 3}, {0, 2}}})) ^
                   make({{{1, 2}, {2, 3}, {0, 1, 3}}});
        },
        3);
}

// Where another operand's facet stands for parts of those of the last box, its corner at bounding
// planes of the cell lies on a diagonal of that box: of a facet without area in the cell.
TEST(BoxFormulas, CornersOfCellsLieOnDiagonals) {
    check_with_all_diagonals(
        [](const auto& make) {
            const Expression gone =
                (((make({{{3, 6}, {4, 7}, {6, 7}}}) ^ make({{{0, 3}, {3, 5}, {0, 6}}})) -
                  make({{{3, 7}, {7, 8}, {1, 2, 3, 8}}})) &
                 make({{{4, 9}, {1, 3}, {8, 9}}}));
            return make({{{4, 8}, {8, 9}, {3, 7}}}) | gone |
                   make({{{3, 4}, {3, 5, 7}, {1, 2, 5, 6, 8}}});
        },
        4 * 1 * 4 + 1 * 4 * 7);
}

INSTANTIATE_TEST_SUITE_P(All, RandomBoxFormulas,
                         testing::Combine(testing::Values(Kind::Decimals, Kind::OneUlpApart,
                                                          Kind::AnyDoubles, Kind::ManyBits,
                                                          Kind::TooManyBits),
                                          testing::Bool()));

}  // namespace
