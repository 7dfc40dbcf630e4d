// SPDX-License-Identifier: Apache-2.0
//
// Relations and contact lists of pairs of placed solids on a small grid, by the library and by
// brute force in rationals (tests/support/interference_oracle.h). Prints how often each relation
// and each stage of predicates occurred; exits with 1 at the first difference, whose seed repeats
// it.
//
// With --fractions 1 each pair is compared a second time, one solid or both of them on lattices
// whose units are 2^8, 2^24, 2^56 or 2^70 times as large: the same solids.
//
// With --solids 1 the solids' own trees answer instead, in cells of one to seven polygons, beside
// models; and again after three cuts of the first solid, with what earlier questions prepared.
//
//     interference_campaign [--pairs 1000] [--seed 1] [--minutes 0] [--fractions 0] [--solids 0]

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <string>

#include <trisect/bsp/interference/interference.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/diagnostics.h>

#include "support/solid_interference_oracle.h"

namespace {

struct Options {
    std::uint64_t pairs = 1000;
    std::uint64_t seed = 1;
    double minutes = 0;  // 0: no limit
    bool fractions = false;
    bool solids = false;
};

// Of the units of both solids. The second form of a pair is drawn beside its scene, so that scenes
// are those of a run without it.
std::array<int, 2> coarser_units(std::uint64_t seed) {
    constexpr std::array bits{0, 8, 24, 56, 70};
    reference::Random random(seed ^ 0x5DEECE66D);
    std::array<int, 2> out{};
    while (out == std::array<int, 2>{}) out = {bits[random.below(5)], bits[random.below(5)]};
    return out;
}

bool parse(int argc, char** argv, Options& o) {
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        if (name == "--pairs")
            o.pairs = std::strtoull(argv[i + 1], nullptr, 10);
        else if (name == "--seed")
            o.seed = std::strtoull(argv[i + 1], nullptr, 10);
        else if (name == "--minutes")
            o.minutes = std::strtod(argv[i + 1], nullptr);
        else if (name == "--fractions")
            o.fractions = std::strtol(argv[i + 1], nullptr, 10) != 0;
        else if (name == "--solids")
            o.solids = std::strtol(argv[i + 1], nullptr, 10) != 0;
        else
            return false;
    }
    return argc % 2 == 1;
}

int run(const Options& o) {
    const trisect::Diagnostics<trisect::PredicateCounters> diagnostics;
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    std::map<trisect::Relation, std::uint64_t> seen;
    std::uint64_t done = 0;
    for (; done < o.pairs && (o.minutes == 0 || seconds() < 60 * o.minutes); ++done) {
        reference::Random random(o.seed + done);
        const brute::Scene scene = brute::random_scene(random);
        trisect::Relation relation{};
        const auto few = static_cast<std::uint32_t>(1 + (o.seed + done) % 7);
        std::string difference = o.solids ? brute::difference_of_solids(scene, few, &relation)
                                          : brute::difference(scene, &relation);
        if (difference.empty() && o.solids)
            difference = brute::difference_along_cuts(scene, few, random, 3);
        if (difference.empty() && o.fractions)
            difference = brute::difference_on_coarser_lattices(scene, coarser_units(o.seed + done));
        if (!difference.empty()) {
            std::printf("seed %llu differs:\n%s", static_cast<unsigned long long>(o.seed + done),
                        difference.c_str());
            return 1;
        }
        ++seen[relation];
    }
    std::printf("%llu pairs, seeds %llu to %llu, all equal; %.0f s\n",
                static_cast<unsigned long long>(done), static_cast<unsigned long long>(o.seed),
                static_cast<unsigned long long>(o.seed + done - 1), seconds());
    for (const auto& [relation, count] : seen)
        std::printf("  %-12s %llu\n", to_string(relation), static_cast<unsigned long long>(count));
    const trisect::PredicateCounters c = diagnostics.counters();
    std::printf(
        "signs, all parts of the library: %llu filtered, %llu up to 128 bits, %llu up to 256 bits, "
        "%llu wider\n",
        static_cast<unsigned long long>(c.filtered), static_cast<unsigned long long>(c.exact_short),
        static_cast<unsigned long long>(c.exact_narrow),
        static_cast<unsigned long long>(c.exact_wide));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    if (!parse(argc, argv, options)) {
        std::fprintf(
            stderr,
            "usage: interference_campaign [--pairs N] [--seed S] [--minutes M] [--fractions 1] "
            "[--solids 1]\n");
        return 2;
    }
    try {
        return run(options);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
