// SPDX-License-Identifier: Apache-2.0
//
// Random splits, on a small grid where everything touches and in general position: split() by a
// solid and by planes, and evaluate_all(), beside one evaluation after the other. Meshes must be
// the same corner by corner, with the same names of faces, by one, two and four threads, and
// volumes of parts exactly that of the whole.
//
//     splits [--seed S] [--pairs N] [--first I] [--only I]
//
// A pair is two solids, of which most have their triangles divided into four; some meet themselves,
// some are complements, half-spaces, results of another formula, empty, whole space, or the same
// solid, and some have coordinates with fractions. The first one is also split by one to five
// planes, most of them through the grid, parallel or not. --only repeats one case. Exits with 1 if
// there was any difference.

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "engines/engines.h"
#include "engines/split_check.h"

namespace {

using trisect::Solid;

struct Counts {
    std::uint64_t pairs = 0;
    std::uint64_t splits_shared = 0;
    std::uint64_t formulas_shared = 0;
    std::uint64_t planes = 0;
    std::uint64_t parts_shared = 0;
    std::uint64_t differences = 0;
};

Solid random_solid(reference::Random& random, reference::Operand operand, bool embedded, int bits) {
    if (random.chance(3, 4)) operand = engines::divided(operand);
    return engines::solid(
        operand, embedded ? trisect::Embedding::Assume : trisect::Embedding::Resolve, bits);
}

// Something else than a mesh, now and then.
Solid changed(reference::Random& random, Solid solid, const Solid& other) {
    switch (random.below(40)) {
        case 0:
            return evaluate(~trisect::Expression(solid));
        case 1:
            return Solid::half_space({static_cast<double>(random.between(-3, 3)), 1,
                                      static_cast<double>(random.between(-3, 3)),
                                      -static_cast<double>(random.between(0, 60)) / 2});
        case 2:
            return evaluate(solid - other);
        case 3:
            return {};
        case 4:
            return Solid::whole_space();
        case 5:
            return other;
        case 6:
            return evaluate(~trisect::Expression(
                Solid::half_space({1, static_cast<double>(random.between(-3, 3)), 0,
                                   -static_cast<double>(random.between(0, 60)) / 2})));
        default:
            return solid;
    }
}

std::vector<std::array<double, 4>> random_planes(reference::Random& random) {
    std::vector<std::array<double, 4>> out;
    const std::size_t n = random.chance(1, 3) ? 1 : 1 + random.below(5);
    const bool are_parallel = !random.chance(1, 5);
    // Grid points have even coordinates where triangles are divided.
    const double step = random.chance(1, 2) ? 1 : 0.37;
    std::array<double, 3> normal{};
    double d = static_cast<double>(random.between(-4, 20));
    for (std::size_t i = 0; i < n; ++i) {
        if (i == 0 || !are_parallel) {
            do {
                for (double& c : normal) c = static_cast<double>(random.between(-2, 2));
            } while (normal == std::array<double, 3>{});
        }
        d += step * static_cast<double>(random.between(1, 6));
        out.push_back({normal[0], normal[1], normal[2], -d});
    }
    return out;
}

class SplitCase {
public:
    SplitCase(std::uint64_t seed, std::uint64_t index, Counts& counts)
        : seed_(seed), index_(index), counts_(counts) {}

    void run() {
        reference::Random mix(seed_ * 2 + 17);
        reference::Random random(mix.next() + index_);
        const bool embedded = !random.chance(1, 8);
        auto operands = reference::random_family(random, 2, embedded);
        if (random.chance(1, 3))
            for (auto& o : operands) o = engines::mapped(o, random);
        constexpr std::array bits{0, 0, 0, 2, 24, 70};
        const int common = bits[random.below(6)];
        const bool one_lattice = random.chance(1, 2);
        std::vector<Solid> solids;
        for (const auto& o : operands)
            solids.push_back(
                random_solid(random, o, embedded, one_lattice ? common : bits[random.below(6)]));
        solids[0] = changed(random, solids[0], solids[1]);
        solids[1] = changed(random, solids[1], solids[0]);
        trisect::EvaluateOptions options;
        constexpr std::array<std::uint32_t, 3> leaves{8, 25, 100};
        options.leaf_polygons = leaves[random.below(3)];
        ++counts_.pairs;
        check("split", [&] {
            return engines::split_difference(solids[0], solids[1], options, counts_.splits_shared);
        });
        if (random.chance(1, 4))
            check("all formulas", [&] {
                return engines::all_difference(solids[0], solids[1], options,
                                               counts_.formulas_shared);
            });
        const auto planes = random_planes(random);
        counts_.planes += planes.size();
        check("planes", [&] {
            return engines::planes_difference(solids[0], planes, options, counts_.parts_shared);
        });
    }

private:
    template <class Check>
    void check(const char* what, const Check& difference) {
        std::string why;
        try {
            why = difference();
        } catch (const std::exception& e) {
            why = std::string("exception: ") + e.what();
        }
        if (why.empty()) return;
        ++counts_.differences;
        std::printf("DIFFERENCE --seed %llu --only %llu, %s: %s\n",
                    static_cast<unsigned long long>(seed_), static_cast<unsigned long long>(index_),
                    what, why.c_str());
        std::fflush(stdout);
    }

    std::uint64_t seed_;
    std::uint64_t index_;
    Counts& counts_;
};

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t seed = 1;
    std::uint64_t pairs = 300;
    std::uint64_t first = 0;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        const std::uint64_t value = std::strtoull(argv[i + 1], nullptr, 10);
        if (name == "--seed") seed = value;
        if (name == "--pairs") pairs = value;
        if (name == "--first") first = value;
        if (name == "--only") {
            first = value;
            pairs = 1;
        }
    }
    Counts counts;
    for (std::uint64_t i = first; i < first + pairs; ++i) SplitCase(seed, i, counts).run();
    const auto row = [](const char* what, std::uint64_t value) {
        std::printf("| %s | %llu |\n", what, static_cast<unsigned long long>(value));
    };
    std::printf("| what | number |\n|---|---:|\n");
    row("pairs, each split by one, two and four threads", counts.pairs);
    row("of them, in one evaluation", counts.splits_shared);
    row("formulas that shared the evaluation of others", counts.formulas_shared);
    row("planes", counts.planes);
    row("parts between planes that took no evaluation of their own", counts.parts_shared);
    row("differences", counts.differences);
    return counts.differences == 0 ? 0 : 1;
}
