// SPDX-License-Identifier: Apache-2.0
//
// Prisms along a common axis, many of whose covers lie in the same planes while their walls cross
// each other (prism_leaf.h), against the naive engine in rationals.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/evaluate/on_common_lattice.h>
#include <trisect/bsp/evaluate/outline_prisms.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/bsp/evaluate/translate.h>

#include "engines.h"
#include "evaluate_stats.h"

namespace prism_test {
namespace {

using reference::Operand;
using Kind = reference::Expression::Kind;

struct Leaves {
    std::uint64_t prisms = 0;
    std::uint64_t mixed = 0;
};

std::int64_t turn(const std::array<std::int64_t, 2>& a, const std::array<std::int64_t, 2>& b) {
    return a[0] * b[1] - a[1] * b[0];
}

// A polygon around a point within it, which every corner sees.
reference::LatticePolygon star(reference::Random& random, std::size_t corners) {
    while (true) {
        reference::LatticePolygon p;
        for (std::size_t i = 0; i < corners; ++i)
            p.push_back({random.between(-30, 30), random.between(-30, 30)});
        const auto upper = [](const auto& a) { return a[1] > 0 || (a[1] == 0 && a[0] > 0); };
        std::sort(p.begin(), p.end(), [&](const auto& a, const auto& b) {
            return upper(a) != upper(b) ? upper(a) : turn(a, b) > 0;
        });
        bool good = true;
        for (std::size_t i = 0; i < corners; ++i)
            good = good && turn(p[i], p[(i + 1) % corners]) > 0;
        if (!good) continue;
        const std::array<std::int64_t, 2> by{random.between(-20, 20), random.between(-20, 20)};
        for (auto& c : p)
            for (std::size_t k = 0; k < 2; ++k) c[k] += by[k];
        return p;
    }
}

// Heights are few, so covers coincide.
Operand random_prism(reference::Random& random) {
    const std::array<std::int64_t, 4> heights{0, 3, 4, 9};
    const std::size_t low = random.below(3);
    const std::size_t high = low + 1 + random.below(3 - low);
    return reference::prism(star(random, 3 + random.below(4)), heights[low], heights[high]);
}

// Bits behind the point, by operand; none where the list ends.
using Bits = std::vector<int>;
using States = std::vector<std::shared_ptr<const trisect::detail::SolidState>>;

std::vector<trisect::Solid> solids_of(const std::vector<Operand>& operands, const Bits& bits) {
    std::vector<trisect::Solid> out;
    for (std::size_t i = 0; i < operands.size(); ++i)
        out.push_back(
            engines::solid(operands[i], trisect::Embedding::Assume, i < bits.size() ? bits[i] : 0));
    return out;
}

void expect_agreement(const std::vector<Operand>& operands, const reference::Expression& expression,
                      const trisect::EvaluateOptions& options, Leaves& leaves,
                      const Bits& bits = {}) {
    const std::vector<trisect::Solid> solids = solids_of(operands, bits);
    trisect::test::EvaluateStats stats;
    const trisect::Expression formula = engines::formula(expression, solids);
    const trisect::Solid by_cells = engines::evaluate_by_cells(formula, options, &stats);
    leaves.prisms += stats.prism_leaves;
    leaves.mixed += stats.mixed_leaves;
    const auto expected =
        reference::canonical_boundary(reference::evaluate(operands, expression).cells);
    // Pairs have a way of their own.
    for (const trisect::Solid& result : {by_cells, trisect::evaluate(formula, options)}) {
        EXPECT_EQ(engines::open_edge(engines::boundary_mesh(result)), "");
        EXPECT_EQ(engines::difference(result.to_brep(), expected), "");
    }
}

struct Volume {
    double value = 0;
    double terms = 0;  // the sum of their magnitudes
};

Volume volume_of(const trisect::PolygonMesh& mesh) {
    Volume out;
    for (std::size_t i = 0; i + 2 < mesh.corners.size(); i += 3) {
        const auto& a = mesh.points[mesh.corners[i]];
        const auto& b = mesh.points[mesh.corners[i + 1]];
        const auto& c = mesh.points[mesh.corners[i + 2]];
        for (std::size_t k = 0; k < 3; ++k) {
            const double left = a[k] * b[(k + 1) % 3] * c[(k + 2) % 3] / 6;
            const double right = a[k] * b[(k + 2) % 3] * c[(k + 1) % 3] / 6;
            out.value += left - right;
            out.terms += std::fabs(left) + std::fabs(right);
        }
    }
    return out;
}

const trisect::detail::FormulaRule by_outlines{&trisect::detail::may_be_prisms_of_one_axis,
                                               &trisect::detail::outline_prisms};

// The same for outlines, as large results have them, before anything is cut.
void expect_same_outlines(const std::vector<Operand>& operands,
                          const reference::Expression& expression, Leaves& leaves,
                          const Bits& bits = {}) {
    const auto formula =
        trisect::detail::translate(engines::formula(expression, solids_of(operands, bits)));
    States states;
    for (const trisect::Solid& s : formula.slots) states.push_back(trisect::detail::state_of(s));
    trisect::detail::EvaluateSettings options;
    (void)trisect::detail::move_to_common_lattice(states, trisect::EvaluateOptions{}.lattices);
    options.leaf_polygons = 0;
    trisect::detail::EvaluateStats stats;
    ++leaves.mixed;
    const auto outlined =
        trisect::detail::evaluate_by(by_outlines, formula.formula, states, options, stats);
    if (outlined == nullptr) return;
    ++leaves.prisms;
    const auto expected =
        reference::canonical_boundary(reference::evaluate(operands, expression).cells);
    const trisect::Solid result = trisect::detail::solid_of(outlined);
    EXPECT_EQ(engines::open_edge(engines::boundary_mesh(result)), "");
    EXPECT_EQ(engines::difference(trisect::detail::assemble_brep(*outlined, {}), expected), "");
    const Volume volume =
        volume_of(trisect::detail::assemble_mesh(*trisect::detail::cut_state(result)));
    // Corners that are rounded move what may be no thicker than that.
    EXPECT_NEAR(volume_of(engines::boundary_mesh(result)).value, volume.value,
                1e-9 * std::fabs(volume.value) + 0x1p-50 * volume.terms);
}

TEST(Prisms, PairsAlongEveryAxis) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        reference::Random random(seed + 410000);
        std::vector<Operand> operands{random_prism(random), random_prism(random)};
        for (auto& o : operands) o = reference::axes_rotated(o, seed % 3);
        for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor}) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            expect_agreement(operands, reference::pair_expression(kind), {}, leaves);
        }
    }
    EXPECT_GT(leaves.prisms * 10, leaves.mixed * 5);
}

// What becomes of operands before they are turned, by the seed.
using Change = std::vector<Operand> (*)(const std::vector<Operand>&, std::uint64_t);

std::vector<Operand> unchanged(const std::vector<Operand>& operands, std::uint64_t) {
    return operands;
}

void expect_same_outlines_of_pairs(std::uint64_t first_seed, std::uint64_t count, Change change) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
        reference::Random random(seed + first_seed);
        std::vector<Operand> operands = change({random_prism(random), random_prism(random)}, seed);
        for (auto& o : operands) o = reference::axes_rotated(o, seed % 3);
        for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor}) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            expect_same_outlines(operands, reference::pair_expression(kind), leaves);
        }
    }
    EXPECT_GT(leaves.prisms * 10, leaves.mixed * 5);
}

TEST(Prisms, OutlinesOfPairsAlongEveryAxis) {
    expect_same_outlines_of_pairs(450000, 300, &unchanged);
}

// What is asked of a result that has not been cut, and what is made of it.
void expect_steps_after_outlines(int bits) {
    trisect::EvaluateOptions options;
    options.leaf_polygons = 0;
    const Operand plate = reference::prism({{-70, -71}, {190, -80}, {200, 75}, {-61, 90}}, 0, 9);
    std::size_t outlined = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 470000);
        const Operand first = reference::prism(star(random, 6), 4, 9);
        const Operand second = reference::prism(star(random, 5), 0, 4);
        const std::vector<Operand> operands{plate, first, second};
        const std::vector<trisect::Solid> solids = solids_of(operands, {bits, bits, bits});
        const trisect::Solid engraved = trisect::evaluate(solids[0] - solids[1], options);
        outlined += trisect::detail::state_of(engraved)->lazy_tree() != nullptr ? 1 : 0;
        EXPECT_FALSE(engraved.is_empty());
        const trisect::Solid turned = trisect::evaluate(~engraved);
        const trisect::Solid both = trisect::evaluate(engraved | solids[2]);
        const auto expected =
            reference::evaluate({plate, first}, reference::pair_expression(Kind::Difference));
        EXPECT_EQ(
            engines::difference(engraved.to_brep(), reference::canonical_boundary(expected.cells)),
            "");
        EXPECT_TRUE(evaluate(turned & engraved).is_empty());
        EXPECT_TRUE(trisect::evaluate((both - solids[2]) - engraved).is_empty());
        EXPECT_EQ(engines::open_edge(engines::boundary_mesh(both)), "");
    }
    EXPECT_GT(outlined, 10U) << bits;
}

TEST(Prisms, StepsAfterOutlines) { expect_steps_after_outlines(0); }

// A plate, prisms side by side within it that are flush with its sides, go through it or end in the
// middle, one with a hole, and some that cross what they like.
std::vector<Operand> plate_with_pockets(reference::Random& random) {
    const Operand plate = reference::prism({{-70, -71}, {190, -80}, {200, 75}, {-61, 90}}, 0, 9);
    const auto height = [&] {
        const std::array<std::int64_t, 5> heights{-2, 0, 4, 9, 12};
        const std::size_t low = random.below(4);
        return std::array{heights[low], heights[low + 1 + random.below(4 - low)]};
    };
    Operand pockets;
    for (std::int64_t i = 0; i < 2; ++i) {
        const auto [low, high] = height();
        const Operand one = reference::prism(star(random, 3 + random.below(4)), low, high);
        pockets = reference::concatenated(pockets, reference::translated(one, {112 * i, 0, 0}));
    }
    std::vector<Operand> operands{plate, pockets};
    for (std::uint64_t i = random.below(4); i > 0; --i) {
        const auto [low, high] = height();
        const reference::LatticePoint by{random.between(-60, 160), random.between(-40, 40), 0};
        operands.push_back(reference::translated(
            reference::prism(star(random, 3 + random.below(4)), low, high), by));
    }
    return operands;
}

void expect_same_outlines_of_plates(std::uint64_t first_seed, std::uint64_t count, Change change) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + first_seed);
        std::vector<Operand> operands = change(plate_with_pockets(random), seed);
        if (seed % 3 == 0) std::swap(operands[0], operands.back());
        auto expression = reference::random_expression(random, operands.size(), operands.size());
        if (operands.size() == 2)
            expression = reference::pair_expression(seed % 2 == 0 ? Kind::Difference : Kind::Union);
        for (auto& o : operands) o = reference::axes_rotated(o, seed % 3);
        expect_same_outlines(operands, expression, leaves);
    }
    EXPECT_GT(leaves.prisms * 10, leaves.mixed * 7);
}

TEST(Prisms, OutlinesOfPlatesWithPockets) {
    expect_same_outlines_of_plates(460000, 200, &unchanged);
}

// --- Side faces of any facets.

// The same solid in units of a half: edges are divided in the middle as a number says for them, so
// that facets on both sides fit, and facets along with them.
Operand with_divided_edges(const Operand& operand, std::uint64_t salt) {
    const auto twice = [](reference::LatticePoint p) {
        for (std::int64_t& c : p) c *= 2;
        return p;
    };
    const auto middle = [](const reference::LatticePoint& a, const reference::LatticePoint& b) {
        reference::LatticePoint out = a;
        for (std::size_t k = 0; k < 3; ++k) out[k] += b[k];
        return out;
    };
    const auto is_divided = [&](const reference::LatticePoint& a,
                                const reference::LatticePoint& b) {
        const auto m = middle(a, b);
        std::uint64_t key = salt;
        for (const std::int64_t c : m) key = 1000003 * key + static_cast<std::uint64_t>(c + 4096);
        return reference::Random(key).below(3) != 0;
    };
    Operand out;
    for (const auto& t : operand) {
        std::vector<reference::LatticePoint> ring;
        std::size_t divided = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            ring.push_back(twice(t[i]));
            if (!is_divided(t[i], t[(i + 1) % 3])) continue;
            ring.push_back(middle(t[i], t[(i + 1) % 3]));
            ++divided;
        }
        // Corners whose neighbours are both middles are cut off; what is left is convex, and no
        // corner of it is between others on one line but next to one that was divided.
        const std::size_t n = ring.size();
        if (divided == 3) {
            for (std::size_t i = 0; i < 6; i += 2)
                out.push_back({ring[i], ring[i + 1], ring[(i + 5) % 6]});
            out.push_back({ring[1], ring[3], ring[5]});
        } else if (divided == 0) {
            out.push_back({ring[0], ring[1], ring[2]});
        } else {
            // A fan from a middle.
            std::size_t m = 0;
            while (!(ring[m] != twice(t[0]) && ring[m] != twice(t[1]) && ring[m] != twice(t[2])))
                ++m;
            for (std::size_t i = 1; i + 1 < n; ++i)
                out.push_back({ring[m], ring[(m + i) % n], ring[(m + i + 1) % n]});
        }
    }
    return out;
}

Operand in_halves(Operand operand) {
    for (auto& t : operand)
        for (auto& p : t)
            for (std::int64_t& c : p) c *= 2;
    return operand;
}

// Every operand, or some of them.
std::vector<Operand> with_divided_edges(const std::vector<Operand>& operands, std::uint64_t seed) {
    std::vector<Operand> out;
    for (std::size_t i = 0; i < operands.size(); ++i) {
        const bool divided = seed % 2 == 0 || i % 2 == seed / 2 % 2;
        out.push_back(divided ? with_divided_edges(operands[i], 100 * seed + i)
                              : in_halves(operands[i]));
        out.back() = divided && seed % 5 != 0 ? with_divided_edges(out.back(), 100 * seed + i + 50)
                                              : in_halves(out.back());
    }
    return out;
}

TEST(PrismsOfAnyFacets, OutlinesOfPairsAlongEveryAxis) {
    expect_same_outlines_of_pairs(510000, 40, &with_divided_edges);
}

TEST(PrismsOfAnyFacets, OutlinesOfPlatesWithPockets) {
    expect_same_outlines_of_plates(520000, 30, &with_divided_edges);
}

// Walls that are no rectangles, and steps, go other ways.
TEST(PrismsOfAnyFacets, StepsInWalls) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 530000);
        const Operand step =
            reference::prism({{0, 0}, {20, 0}, {20, 8}, {9, 8}, {9, 17}, {0, 17}}, -9, 30);
        // The steps are along another axis than those of the others.
        const Operand turned = reference::axes_rotated(step, 1 + seed % 2);
        const std::vector<Operand> operands =
            with_divided_edges({turned, random_prism(random), random_prism(random)}, seed);
        expect_same_outlines(operands, reference::random_expression(random, 3, 3), leaves);
    }
}

// --- Other formulas.

TEST(Prisms, FormulasOverSeveral) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 420000);
        std::vector<Operand> operands;
        for (std::size_t i = 0; i < 3 + seed % 3; ++i) operands.push_back(random_prism(random));
        const auto expression =
            reference::random_expression(random, operands.size(), operands.size() + seed % 4);
        trisect::EvaluateOptions options;
        if (seed % 4 == 0) options.leaf_polygons = 6;
        expect_agreement(operands, expression, options, leaves);
    }
    EXPECT_GT(leaves.prisms, 50U);
}

// One operand with two prisms above each other, and one with two side by side.
TEST(Prisms, OperandsOfSeveralPrisms) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 430000);
        const Operand stacked = reference::concatenated(reference::prism(star(random, 4), 0, 3),
                                                        reference::prism(star(random, 3), 4, 9));
        const Operand beside = reference::concatenated(
            reference::prism(star(random, 4), 0, 4),
            reference::translated(reference::prism(star(random, 5), 3, 9), {101, 0, 0}));
        const Operand bar = reference::prism({{-60, -3}, {161, 5}, {160, 11}, {-61, 7}}, 0, 9);
        const auto expression =
            reference::random_expression(random, 3, 2 + static_cast<std::size_t>(seed % 3));
        expect_agreement({stacked, beside, bar}, expression, {}, leaves);
    }
    EXPECT_GT(leaves.prisms * 10, leaves.mixed * 5);
}

// Walls that three prisms have in one point, or that end on each other: these go the long way.
TEST(Prisms, WallsThroughOnePointAndWallsThatTouch) {
    Leaves leaves;
    const Operand a = reference::prism({{-10, -1}, {10, -1}, {10, 1}, {-10, 1}}, 0, 4);
    const Operand b = reference::prism({{-9, -11}, {11, 9}, {9, 11}, {-11, -9}}, 0, 4);
    const Operand c = reference::prism({{-11, 9}, {9, -11}, {11, -9}, {-9, 11}}, 0, 4);
    const Operand touching = reference::prism({{-3, 1}, {2, 1}, {0, 14}}, 0, 4);
    const Operand corner = reference::prism({{0, 1}, {7, 20}, {-7, 20}}, 0, 4);
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 440000);
        expect_agreement({a, b, c}, reference::random_expression(random, 3, 3), {}, leaves);
        expect_agreement({a, touching, b}, reference::random_expression(random, 3, 3), {}, leaves);
        expect_agreement({a, corner, c}, reference::random_expression(random, 3, 3), {}, leaves);
    }
    EXPECT_GT(leaves.prisms, 10U);
}

// --- Coordinates with many digits.

// What becomes of small whole coordinates. The engine in rationals has integers in units in which
// the coordinates of the cell tree have so many bits behind the point.
struct Form {
    std::vector<Operand> operands;
    Bits bits;
};

// The same solids on coarser lattices: on one, or on one for each.
Form on_coarser_lattices(std::vector<Operand> operands, std::uint64_t seed) {
    constexpr std::array<int, 5> several{0, 2, 40, 61, 65};
    const int one = 1 + static_cast<int>(seed * 29 % 65);
    Form out{std::move(operands), {}};
    for (std::size_t i = 0; i < out.operands.size(); ++i)
        out.bits.push_back(seed % 2 == 0 ? one : several[(seed + 2 * i) % several.size()]);
    return out;
}

// Tenths, which are multiples of 2^-56.
Form in_decimals(std::vector<Operand> operands, std::uint64_t) {
    constexpr int bits = 56;
    for (Operand& o : operands)
        for (auto& t : o)
            for (auto& corner : t)
                for (std::int64_t& c : corner)
                    c = static_cast<std::int64_t>(std::ldexp(static_cast<double>(c) / 10, bits));
    Form out{std::move(operands), {}};
    out.bits.assign(out.operands.size(), bits);
    return out;
}

// Corners are on the grid, or one double beside it along an axis or two; heights as well. Different
// operands do not agree about it. Below 2^52 units of the coarsest lattice there are no fractions.
Form one_double_off(std::vector<Operand> operands, std::uint64_t seed) {
    constexpr std::array<int, 4> lattices{0, 52, 61, 70};
    const int bits = lattices[seed % lattices.size()];
    const double unit = bits == 0 ? 0x1p44 : 0x1p52;
    const auto displaced = [&](std::int64_t c, std::uint64_t salt) {
        const double at = static_cast<double>(c) * unit;
        reference::Random random(salt);
        const std::int64_t way = random.between(-1, 1);
        if (way == 0) return static_cast<std::int64_t>(at);
        const double next = std::nextafter(at, way > 0 ? 0x1p80 : -0x1p80);
        const bool is_integer = next == std::floor(next) && c != 0;
        return is_integer ? static_cast<std::int64_t>(next) : static_cast<std::int64_t>(at) + way;
    };
    for (std::size_t i = 0; i < operands.size(); ++i)
        for (auto& t : operands[i])
            for (auto& p : t) {
                const std::uint64_t key = 1000 * seed + i;
                const auto corner = static_cast<std::uint64_t>(512 * (p[0] + 256) + p[1] + 256);
                const auto height = static_cast<std::uint64_t>(p[2] + 256);
                p = {displaced(p[0], key + (corner << 24)),
                     displaced(p[1], key + (corner << 24) + 500),
                     displaced(p[2], key + (height << 48) + 700)};
            }
    Form out{std::move(operands), {}};
    out.bits.assign(out.operands.size(), bits);
    return out;
}

constexpr std::array forms{&on_coarser_lattices, &in_decimals, &one_double_off};

Form form_of(std::size_t form, const std::vector<Operand>& operands, std::uint64_t seed) {
    Form out = forms[form](operands, seed);
    for (Operand& o : out.operands) o = reference::axes_rotated(std::move(o), seed % 3);
    return out;
}

TEST(PrismsWithFractions, PairsAlongEveryAxis) {
    for (std::size_t form = 0; form < forms.size(); ++form) {
        Leaves leaves;
        for (std::uint64_t seed = 1; seed <= 60; ++seed) {
            SCOPED_TRACE(std::to_string(form) + " seed " + std::to_string(seed));
            reference::Random random(seed + 480000);
            const auto [operands, bits] =
                form_of(form, {random_prism(random), random_prism(random)}, seed);
            for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor})
                expect_agreement(operands, reference::pair_expression(kind), {}, leaves, bits);
        }
        EXPECT_GT(leaves.prisms * 10, leaves.mixed * 5) << form;
    }
}

// A prism and the same one again with other last digits: side faces that nearly coincide cross at
// the smallest of angles, or have a corner in common, or end on each other.
TEST(PrismsWithFractions, CopiesOneDoubleApart) {
    Leaves leaves;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 485000);
        const Operand one = random_prism(random);
        const auto [operands, bits] = form_of(2, {one, one, random_prism(random)}, seed);
        expect_agreement(operands, reference::random_expression(random, 3, 3), {}, leaves, bits);
        expect_same_outlines(operands, reference::random_expression(random, 3, 2), leaves, bits);
    }
    EXPECT_GT(leaves.prisms, 20U);
}

TEST(PrismsWithFractions, OutlinesOfPlatesWithPockets) {
    for (std::size_t form = 0; form < forms.size(); ++form) {
        Leaves leaves;
        for (std::uint64_t seed = 1; seed <= 60; ++seed) {
            SCOPED_TRACE(std::to_string(form) + " seed " + std::to_string(seed));
            reference::Random random(seed + 490000);
            const auto [operands, bits] = form_of(form, plate_with_pockets(random), seed);
            auto expression =
                reference::random_expression(random, operands.size(), operands.size());
            if (operands.size() == 2)
                expression =
                    reference::pair_expression(seed % 2 == 0 ? Kind::Difference : Kind::Union);
            expect_same_outlines(operands, expression, leaves, bits);
        }
        EXPECT_GT(leaves.prisms * 10, leaves.mixed * 7) << form;
    }
}

TEST(PrismsWithFractions, StepsAfterOutlines) {
    for (const int bits : {3, 65}) expect_steps_after_outlines(bits);
}

TEST(PrismsWithFractions, FormulasOverSeveral) {
    for (std::size_t form = 0; form < forms.size(); ++form) {
        Leaves leaves;
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            SCOPED_TRACE(std::to_string(form) + " seed " + std::to_string(seed));
            reference::Random random(seed + 495000);
            std::vector<Operand> grid;
            for (std::size_t i = 0; i < 3 + seed % 3; ++i) grid.push_back(random_prism(random));
            const auto [operands, bits] = form_of(form, grid, seed);
            const auto expression =
                reference::random_expression(random, operands.size(), operands.size() + seed % 4);
            trisect::EvaluateOptions options;
            if (seed % 4 == 0) options.leaf_polygons = 6;
            expect_agreement(operands, expression, options, leaves, bits);
        }
        EXPECT_GT(leaves.prisms, 20U) << form;
    }
}

// Side faces in one plane, some of which overlap; three that have a line in common, or miss it by a
// digit; and some that end on others.
TEST(PrismsWithFractions, WallsInOnePlaneThroughOneLineAndWallsThatTouch) {
    const Operand a = reference::prism({{-10, -1}, {10, -1}, {10, 1}, {-10, 1}}, 0, 4);
    const Operand b = reference::prism({{-9, -11}, {11, 9}, {9, 11}, {-11, -9}}, 0, 4);
    const Operand c = reference::prism({{-11, 9}, {9, -11}, {11, -9}, {-9, 11}}, 0, 4);
    const Operand touching = reference::prism({{-3, 1}, {2, 1}, {0, 14}}, 0, 4);
    const Operand corner = reference::prism({{0, 1}, {7, 20}, {-7, 20}}, 0, 4);
    const Operand beside = reference::prism({{12, -1}, {25, -1}, {21, 17}}, 0, 9);
    const Operand over = reference::prism({{3, 1}, {27, 1}, {24, -13}, {4, -7}}, 0, 3);
    for (std::size_t form = 0; form < forms.size(); ++form) {
        Leaves leaves;
        for (std::uint64_t seed = 1; seed <= 16; ++seed) {
            SCOPED_TRACE(std::to_string(form) + " seed " + std::to_string(seed));
            reference::Random random(seed + 500000);
            for (const std::vector<Operand>& grid :
                 {std::vector{a, b, c}, std::vector{a, touching, b}, std::vector{a, corner, c},
                  std::vector{a, beside, b}, std::vector{a, over, c}}) {
                const auto [operands, bits] = form_of(form, grid, seed);
                expect_agreement(operands, reference::random_expression(random, 3, 3), {}, leaves,
                                 bits);
                expect_same_outlines(operands, reference::random_expression(random, 3, 3), leaves,
                                     bits);
            }
        }
        EXPECT_GT(leaves.prisms, 20U) << form;
    }
}

// --- Sizes.

// Slanted bars side by side, and one across all of them; a quarter turn takes bars that are long in
// the one coordinate to bars that are long in the other.
bool outlines_bars(std::int64_t count, bool turned) {
    const auto place = [turned](std::int64_t x, std::int64_t y) {
        return turned ? std::array{-y, x} : std::array{x, y};
    };
    Operand bars;
    for (std::int64_t i = 0; i < count; ++i) {
        const std::int64_t y = 4 * i;
        const Operand bar = reference::prism(
            {place(i, y), place(30'000 + i, y + 1), place(30'000 + i, y + 3), place(i, y + 2)}, 0,
            9);
        bars = reference::concatenated(std::move(bars), bar);
    }
    const std::int64_t far = 4 * count + 5;
    const Operand across = reference::prism(
        {place(25'000, -5), place(25'002, -5), place(25'012, far), place(25'010, far)}, 3, 7);
    std::vector<trisect::Solid> solids;
    for (const Operand& o : {bars, across})
        solids.push_back(engines::solid(o, trisect::Embedding::Assume));
    const auto formula = trisect::detail::translate(trisect::Expression(solids[0]) - solids[1]);
    std::vector<std::shared_ptr<const trisect::detail::SolidState>> states;
    for (const trisect::Solid& s : formula.slots) states.push_back(trisect::detail::state_of(s));
    trisect::detail::EvaluateStats stats;
    return trisect::detail::evaluate_by(by_outlines, formula.formula, states, {}, stats) != nullptr;
}

// Where most walls lie beside most others, looking at all pairs, or at all walls for each outline,
// would take a time that grows with the square of their number; cells are the better way then.
TEST(Prisms, ThousandsOfLongWallsSideBySideAreNotOutlined) {
    for (const bool turned : {false, true}) {
        EXPECT_TRUE(outlines_bars(1000, turned)) << turned;
        EXPECT_FALSE(outlines_bars(12000, turned)) << turned;
    }
}

}  // namespace
}  // namespace prism_test
