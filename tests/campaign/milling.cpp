// SPDX-License-Identifier: Apache-2.0
//
// Milling: a long chain of cuts, and every so often the same set computed from the beginning, the
// block less the union of all tools so far as one expression. Nothing of the chain's tree takes
// part in that, so whatever a chain could spoil little by little shows.
//
//     milling [--scene e:25k] [--every 100]
//
// Compared are the sets (their symmetric difference must be empty), and of the boundaries with
// maximal faces, which are a function of the set alone: the exact volume, rounded, and the numbers
// of vertices, edges, faces, loops and shells. Prints a line a comparison; exits with 1 at the
// first difference.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "bench/scene.h"

namespace {

using trisect::Brep;
using trisect::Expression;
using trisect::Solid;
using Clock = std::chrono::steady_clock;

struct Options {
    std::string scene = "e:25k";
    std::size_t every = 100;
};

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Empty when both are the same set.
std::string difference(const Solid& chain, const Solid& cold) {
    if (!trisect::evaluate(chain ^ cold).is_empty()) return "the symmetric difference is not empty";
    const Brep a = chain.to_brep();
    const Brep b = cold.to_brep();
    if (a.counts() != b.counts()) return "the boundaries differ";
    if (trisect::volume(a) != trisect::volume(b)) return "the volumes differ";
    std::printf(" %zu | %zu | %.17g |", a.counts().vertices, a.counts().faces, trisect::volume(a));
    return {};
}

bool run(const Options& options) {
    const bench::Scene scene = bench::make_scene(options.scene);
    const Solid block = Solid::from_mesh(scene.operands.at(0));
    Solid chain = block;
    std::vector<Expression> tools;
    double chain_seconds = 0;
    std::printf(
        "| cuts | chain so far, s | cold, s | vertices | faces | volume | |\n"
        "|---:|---:|---:|---:|---:|---:|---|\n");
    for (std::size_t i = 0; i < scene.steps; ++i) {
        const Solid tool = Solid::from_mesh(scene.step(i).tool);
        tools.emplace_back(tool);
        auto start = Clock::now();
        chain = trisect::evaluate(chain - tool);
        chain_seconds += seconds_since(start);
        if ((i + 1) % options.every != 0) continue;
        start = Clock::now();
        const Solid cold = trisect::evaluate(block - Expression::any_of(tools));
        std::printf("| %zu | %.2f | %.2f |", i + 1, chain_seconds, seconds_since(start));
        const std::string why = difference(chain, cold);
        std::printf(" %s |\n", why.empty() ? "same" : why.c_str());
        std::fflush(stdout);
        if (!why.empty()) return false;
    }
    return true;
}

std::optional<Options> parse(int argc, char** argv) {
    Options out;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string word = argv[i];
        if (word == "--scene")
            out.scene = argv[i + 1];
        else if (word == "--every")
            out.every = std::strtoul(argv[i + 1], nullptr, 10);
        else
            return std::nullopt;
    }
    if (argc % 2 == 0 || out.every == 0 || !out.scene.starts_with("e:")) return std::nullopt;
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse(argc, argv);
    if (!options) {
        std::fprintf(stderr, "usage: %s [--scene e:25k] [--every 100]\n", argv[0]);
        return 2;
    }
    try {
        return run(*options) ? 0 : 1;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "milling: %s\n", e.what());
        return 1;
    }
}
