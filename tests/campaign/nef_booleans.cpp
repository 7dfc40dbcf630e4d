// SPDX-License-Identifier: Apache-2.0
//
// Booleans of pairs, and the same with CGAL's Nef polyhedra in rationals: the boundaries must be
// the same sets with the same faces. Small pairs are those of the other campaigns, on a grid where
// everything coincides. A medium pair has some hundred triangles: two stars (spheres whose corners
// were moved along their rays), one of them moved so that corners meet, or two terrains of low
// integer heights, whose facets lie in common planes and whose corners meet all the time.
//
//     nef_booleans [--seed S] [--pairs N] [--medium M] [--only I]
//
// Prints a line for each difference, with the number that repeats it; exits with 1 if there was
// any. Results of the first N numbers are of small pairs, the next M of medium ones.

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <trisect/brep/primitives/sphere.h>

#include "engines/engines.h"
#include "reference/nef_polyhedron.h"

namespace {

using reference::Nef;
using reference::Operand;
using reference::Random;
using Kind = reference::Expression::Kind;

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t pairs = 1000;
    std::uint64_t medium = 0;
    std::uint64_t only = ~std::uint64_t{0};
};

struct Counts {
    std::uint64_t pairs = 0;
    std::uint64_t triangles = 0;
    std::uint64_t results = 0;
    std::uint64_t empty = 0;
    std::uint64_t different = 0;
};

// Corners are moved along their rays only, so the star does not meet itself; the grid is fine
// enough for that to survive rounding.
Operand star(Random& random) {
    const trisect::PolygonMesh sphere = trisect::make_icosphere(1, 2);
    std::vector<reference::LatticePoint> points;
    for (const auto& p : sphere.points) {
        const auto radius = static_cast<double>(random.between(60'000, 100'000));
        points.push_back({std::llround(radius * p[0]), std::llround(radius * p[1]),
                          std::llround(radius * p[2])});
    }
    Operand out;
    for (std::size_t f = 0; f < sphere.face_count(); ++f) {
        const auto corners = sphere.face(f);
        out.push_back({points[corners[0]], points[corners[1]], points[corners[2]]});
    }
    return out;
}

// Heights 1 to 3 over a square of cells, down to the plane at height 0.
Operand terrain(Random& random) {
    constexpr std::int64_t cells = 7;
    std::array<std::array<std::int64_t, cells + 1>, cells + 1> heights{};
    for (auto& row : heights)
        for (std::int64_t& h : row) h = random.between(1, 3);
    const auto top = [&](std::int64_t x, std::int64_t y) {
        return reference::LatticePoint{
            x, y, heights[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)]};
    };
    const auto floor = [](std::int64_t x, std::int64_t y) {
        return reference::LatticePoint{x, y, 0};
    };
    Operand out;
    const auto quad = [&](const auto& a, const auto& b, const auto& c, const auto& d) {
        out.push_back({a, b, c});
        out.push_back({a, c, d});
    };
    for (std::int64_t x = 0; x < cells; ++x)
        for (std::int64_t y = 0; y < cells; ++y) {
            quad(top(x, y), top(x + 1, y), top(x + 1, y + 1), top(x, y + 1));
            quad(floor(x, y), floor(x, y + 1), floor(x + 1, y + 1), floor(x + 1, y));
        }
    for (std::int64_t i = 0; i < cells; ++i) {
        quad(floor(i, 0), floor(i + 1, 0), top(i + 1, 0), top(i, 0));
        quad(floor(i + 1, cells), floor(i, cells), top(i, cells), top(i + 1, cells));
        quad(floor(0, i + 1), floor(0, i), top(0, i), top(0, i + 1));
        quad(floor(cells, i), floor(cells, i + 1), top(cells, i + 1), top(cells, i));
    }
    return out;
}

std::vector<Operand> medium_pair(Random& random) {
    const auto corner = [&](const Operand& o) {
        return o[random.below(o.size())][random.below(3)];
    };
    const bool stars = random.chance(1, 2);
    Operand a = stars ? star(random) : terrain(random);
    Operand b = random.chance(1, 4) ? a : stars ? star(random) : terrain(random);
    if (!stars) b = reference::axes_rotated(b, random.below(3));
    const auto p = corner(a);
    const auto q = corner(b);
    b = reference::translated(b, {p[0] - q[0], p[1] - q[1], p[2] - q[2]});
    return {std::move(a), std::move(b)};
}

Nef nef_of(Kind kind, const Nef& a, const Nef& b) {
    switch (kind) {
        case Kind::Union:
            return a + b;
        case Kind::Intersection:
            return a * b;
        case Kind::Difference:
            return a - b;
        default:
            return a ^ b;
    }
}

void compare(const Options& options, std::uint64_t number, Counts& counts) {
    Random mix(options.seed * 2 + 1);
    Random random(mix.next() + number);
    const std::vector<Operand> pair =
        number < options.pairs ? random_family(random, 2, true) : medium_pair(random);
    const Nef a = reference::to_nef(pair[0]);
    const Nef b = reference::to_nef(pair[1]);
    const std::vector<trisect::Solid> solids{engines::solid(pair[0]), engines::solid(pair[1])};
    ++counts.pairs;
    counts.triangles += pair[0].size() + pair[1].size();
    for (const Kind kind : {Kind::Union, Kind::Intersection, Kind::Difference, Kind::Xor}) {
        const reference::CanonicalBoundary expected = reference::boundary_of(nef_of(kind, a, b));
        if (expected.empty()) ++counts.empty;
        ++counts.results;
        std::string why;
        try {
            const auto formula = engines::formula(reference::pair_expression(kind), solids);
            why = engines::difference(evaluate(formula).to_brep(), expected);
        } catch (const std::exception& e) {
            why = e.what();
        }
        if (why.empty()) continue;
        ++counts.different;
        std::printf(
            "DIFFERENT --seed %llu --pairs %llu --medium %llu --only %llu, operation %d: %s\n",
            static_cast<unsigned long long>(options.seed),
            static_cast<unsigned long long>(options.pairs),
            static_cast<unsigned long long>(options.medium),
            static_cast<unsigned long long>(number), static_cast<int>(kind), why.c_str());
        std::fflush(stdout);
    }
}

bool parse(int argc, char** argv, Options& out) {
    for (int i = 1; i < argc; i += 2) {
        if (i + 1 == argc) return false;
        const std::string_view word = argv[i];
        const std::uint64_t value = std::strtoull(argv[i + 1], nullptr, 10);
        if (word == "--seed")
            out.seed = value;
        else if (word == "--pairs")
            out.pairs = value;
        else if (word == "--medium")
            out.medium = value;
        else if (word == "--only")
            out.only = value;
        else
            return false;
    }
    return true;
}

void print(const Options& o, const Counts& c, double seconds) {
    const auto n = [](std::uint64_t v) { return static_cast<unsigned long long>(v); };
    std::printf(
        "%llu pairs (seed %llu), %llu triangles, %llu results, %llu of them empty, %llu different; "
        "%.0f s\n",
        n(c.pairs), n(o.seed), n(c.triangles), n(c.results), n(c.empty), n(c.different), seconds);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    if (!parse(argc, argv, options)) {
        std::fprintf(stderr,
                     "usage: nef_booleans [--seed S] [--pairs N] [--medium M] [--only I]\n");
        return 2;
    }
    const auto start = std::chrono::steady_clock::now();
    Counts counts;
    const bool one = options.only != ~std::uint64_t{0};
    const std::uint64_t end = one ? options.only + 1 : options.pairs + options.medium;
    for (std::uint64_t i = one ? options.only : 0; i < end; ++i) compare(options, i, counts);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    print(options, counts, seconds.count());
    return counts.different == 0 ? 0 : 1;
}
