// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums and offsets of regions on small grids, and the same sets with CGAL: unions of the
// hulls of sums of convex pieces, in its exact kernel. Regions are squares and halves of squares,
// which touch, hang together in corners and have holes.
//
//     region_sums [--seed S] [--cases N] [--only I]
//
// Prints a line for each difference, with the number that repeats it; exits with 1 if there was
// any. An offset by miters is the sum with a square, one by bevels that with a diamond, since all
// edges of its regions are along the axes; a negative one that of the complement.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/convex_hull_2.h>

#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/minkowski.h>
#include <trisect/bsp/modelling/offset.h>

#include "reference/random_solids.h"

namespace {

using reference::Random;
using trisect::FlatOutline;
using trisect::Solid;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;
using PolygonSet = CGAL::Polygon_set_2<Kernel>;

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t cases = 1000;
    std::uint64_t only = ~std::uint64_t{0};
};

using Pieces = std::vector<FlatOutline>;

// A square of a grid, or the half of it on one side of a diagonal, counter-clockwise.
FlatOutline piece_at(double x, double y, std::size_t half) {
    FlatOutline square{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
    if (half < 4) square.erase(square.begin() + static_cast<std::ptrdiff_t>(half));
    return square;
}

Pieces random_region(Random& random, bool along_axes) {
    Pieces out;
    const auto columns = random.between(1, 3);
    const auto rows = random.between(1, 3);
    const auto x = random.between(-2, 2);
    const auto y = random.between(-2, 2);
    while (out.empty())
        for (std::int64_t i = 0; i < columns; ++i)
            for (std::int64_t j = 0; j < rows; ++j)
                if (random.chance(2, 3))
                    out.push_back(piece_at(static_cast<double>(x + i), static_cast<double>(y + j),
                                           along_axes ? 4 : random.below(8)));
    return out;
}

PolygonSet joined(const std::vector<Polygon>& polygons) {
    PolygonSet out;
    out.join(polygons.begin(), polygons.end());
    return out;
}

PolygonSet sum_by_cgal(const Pieces& a, const Pieces& b) {
    std::vector<Polygon> hulls;
    for (const FlatOutline& p : a)
        for (const FlatOutline& q : b) {
            std::vector<Kernel::Point_2> sums;
            for (const auto& u : p)
                for (const auto& v : q) sums.emplace_back(u[0] + v[0], u[1] + v[1]);
            Polygon hull;
            CGAL::convex_hull_2(sums.begin(), sums.end(), std::back_inserter(hull));
            hulls.push_back(std::move(hull));
        }
    return joined(hulls);
}

// Squares of a frame around all regions and offsets that are not in the region.
Pieces complement_of(const Pieces& squares) {
    constexpr int far = 8;
    Pieces out;
    for (int x = -far; x < far; ++x)
        for (int y = -far; y < far; ++y) {
            FlatOutline square = piece_at(x, y, 4);
            if (std::ranges::find(squares, square) == squares.end())
                out.push_back(std::move(square));
        }
    return out;
}

PolygonSet set_of(const Solid& prism) {
    const auto flat = trisect::flat_outlines(prism);
    if (!flat) return {};
    std::vector<Polygon> triangles;
    for (const auto& t : trisect::flat_triangles(prism)) {
        Polygon& triangle = triangles.emplace_back();
        for (const std::uint32_t v : t)
            triangle.push_back({flat->points[v][0], flat->points[v][1]});
    }
    return joined(triangles);
}

bool are_equal(PolygonSet a, const PolygonSet& b) {
    a.symmetric_difference(b);
    return a.is_empty();
}

Solid prism_of(const Pieces& pieces) {
    return trisect::flat_prism(pieces, trisect::OutlineRule::Positive, 0, 1);
}

class Campaign {
public:
    explicit Campaign(const Options& options) : options_(options) {}

    void run(std::uint64_t number) {
        Random mix(options_.seed * 2 + 1);
        Random random(mix.next() + number);
        const bool is_sum = number % 2 == 0;
        const Pieces a = random_region(random, !is_sum);
        if (is_sum) {
            const Pieces b = random_region(random, false);
            check(number, "sum", trisect::minkowski_sum_of_regions(prism_of(a), prism_of(b)),
                  sum_by_cgal(a, b));
            return;
        }
        check_offset(number, a, random);
    }
    [[nodiscard]] std::array<std::uint64_t, 4> counts() const {
        return {sums_, offsets_, empty_, different_};
    }

private:
    void check_offset(std::uint64_t number, const Pieces& a, Random& random) {
        const bool bevel = random.chance(1, 2);
        const bool grows = random.chance(2, 3);
        const double d = std::array{0.25, 0.5, 1.0, 2.0}[random.below(grows ? 4 : 3)];
        trisect::OffsetOptions how;
        how.corners =
            bevel ? trisect::OffsetOptions::Corners::Bevel : trisect::OffsetOptions::Corners::Miter;
        const Solid ours = trisect::offset_of_region(prism_of(a), grows ? d : -d, how);
        const FlatOutline tool = bevel ? FlatOutline{{d, 0}, {0, d}, {-d, 0}, {0, -d}}
                                       : FlatOutline{{-d, -d}, {d, -d}, {d, d}, {-d, d}};
        PolygonSet expected = sum_by_cgal(grows ? a : complement_of(a), {tool});
        if (!grows) {
            std::vector<Polygon> squares;
            for (const FlatOutline& square : a) {
                Polygon& p = squares.emplace_back();
                for (const auto& c : square) p.push_back({c[0], c[1]});
            }
            PolygonSet whole = joined(squares);
            whole.difference(expected);
            expected = std::move(whole);
        }
        check(number, bevel ? "bevel" : "miter", ours, expected);
    }

    void check(std::uint64_t number, const char* what, const Solid& ours,
               const PolygonSet& expected) {
        ++(std::string_view(what) == "sum" ? sums_ : offsets_);
        if (expected.is_empty()) ++empty_;
        if (are_equal(set_of(ours), expected)) return;
        ++different_;
        std::printf("DIFFERENT --seed %llu --only %llu: %s\n",
                    static_cast<unsigned long long>(options_.seed),
                    static_cast<unsigned long long>(number), what);
        std::fflush(stdout);
    }

    const Options& options_;
    std::uint64_t sums_ = 0;
    std::uint64_t offsets_ = 0;
    std::uint64_t empty_ = 0;
    std::uint64_t different_ = 0;
};

bool parse(int argc, char** argv, Options& out) {
    for (int i = 1; i < argc; i += 2) {
        if (i + 1 == argc) return false;
        const std::string_view word = argv[i];
        const std::uint64_t value = std::strtoull(argv[i + 1], nullptr, 10);
        if (word == "--seed")
            out.seed = value;
        else if (word == "--cases")
            out.cases = value;
        else if (word == "--only")
            out.only = value;
        else
            return false;
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    if (!parse(argc, argv, options)) {
        std::fprintf(stderr, "usage: region_sums [--seed S] [--cases N] [--only I]\n");
        return 2;
    }
    Campaign campaign(options);
    const bool one = options.only != ~std::uint64_t{0};
    const std::uint64_t end = one ? options.only + 1 : options.cases;
    for (std::uint64_t i = one ? options.only : 0; i < end; ++i) campaign.run(i);
    const auto [sums, offsets, empty, different] = campaign.counts();
    std::printf("%llu sums, %llu offsets (seed %llu), %llu of them empty, %llu different\n",
                static_cast<unsigned long long>(sums), static_cast<unsigned long long>(offsets),
                static_cast<unsigned long long>(options.seed),
                static_cast<unsigned long long>(empty), static_cast<unsigned long long>(different));
    return different == 0 ? 0 : 1;
}
