// SPDX-License-Identifier: Apache-2.0
//
// MspTree against brute force in rationals, for results of random booleans on a small grid: all
// kinds of contacts, cavities, computed corners. Each result is indexed with each heuristic, with
// maximal faces or with the faces of the operands; the tree is validated, and probes on vertices,
// edges, faces, extended planes and cut lines are located.
//
//     msp_entities [--seed N] [--models N] [--points N]
//
// Results whose boundary is not that of the set are left out and counted: whether booleans are
// right is asked elsewhere. Prints one line for each disagreement, and totals; exits with 1 if
// there was one.

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/msp_tree.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "support/probes.h"

namespace {

using namespace trisect;

struct Totals {
    std::size_t models = 0;
    std::size_t faces = 0;
    std::size_t skipped = 0;
    std::size_t unsupported = 0;
    std::size_t failures = 0;
    std::array<std::size_t, 5> probes{};
    std::array<std::size_t, 4> nodes{};
};

constexpr std::array heuristics{MspHeuristic::AsGiven, MspHeuristic::LeastSplits,
                                MspHeuristic::Balanced, MspHeuristic::LargestFirst};

std::string fault(const Brep& brep, std::size_t points, std::uint32_t seed, Totals& totals) {
    const auto probes = test::answered_probes(brep, points, seed);
    for (const test::Probe& p : probes)
        ++totals.probes[static_cast<std::size_t>(p.expected.kind())];
    for (const MspHeuristic h : heuristics) {
        MspOptions options;
        options.split_heuristic = h;
        const MspTree tree = MspTree::from_brep(brep, options);
        const MspStats stats = tree.stats();
        for (std::size_t d = 0; d < stats.nodes.size(); ++d) totals.nodes[d] += stats.nodes[d];
        if (h == MspHeuristic::Balanced) tree.validate(brep, 16);
        if (std::string why = test::first_difference(tree, probes); !why.empty()) return why;
    }
    return {};
}

void run_model(std::uint64_t seed, std::size_t points, Totals& totals) {
    reference::Random random(seed);
    const auto count = static_cast<std::size_t>(random.between(2, 4));
    const auto operands = reference::random_family(random, count);
    const auto expression = reference::random_expression(random, count, count, false);
    std::vector<Solid> solids;
    for (const auto& o : operands) solids.push_back(engines::solid(o));
    AssembleOptions assemble;
    assemble.maximal_faces = seed % 3 != 0;
    try {
        const Brep brep = evaluate(engines::formula(expression, solids)).to_brep(assemble);
        if (brep.is_empty()) return;
        const auto expected = reference::evaluate(operands, expression);
        if (assemble.maximal_faces &&
            !engines::difference(brep, reference::canonical_boundary(expected.cells)).empty()) {
            ++totals.skipped;
            return;
        }
        ++totals.models;
        totals.faces += brep.faces().size();
        const std::string why = fault(brep, points, static_cast<std::uint32_t>(seed), totals);
        if (why.empty()) return;
        ++totals.failures;
        std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed), why.c_str());
    } catch (const UnsupportedError&) {
        ++totals.unsupported;
    } catch (const Error& e) {
        ++totals.failures;
        std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed), e.what());
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t seed = 1;
    std::uint64_t models = 100;
    std::size_t points = 300;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string_view option = argv[i];
        const std::uint64_t value = std::strtoull(argv[i + 1], nullptr, 10);
        if (option == "--seed") seed = value;
        if (option == "--models") models = value;
        if (option == "--points") points = value;
    }
    Totals totals;
    for (std::uint64_t i = 0; i < models; ++i) run_model(seed + i, points, totals);
    std::printf("%zu models, %zu faces, %zu disagreements; left out: %zu wrong, %zu unsupported\n",
                totals.models, totals.faces, totals.failures, totals.skipped, totals.unsupported);
    std::printf("probes: %zu outside, %zu inside, %zu on faces, %zu on edges, %zu on vertices\n",
                totals.probes[0], totals.probes[1], totals.probes[2], totals.probes[3],
                totals.probes[4]);
    std::printf("nodes of all trees: %zu planes, %zu lines, %zu points\n", totals.nodes[3],
                totals.nodes[2], totals.nodes[1]);
    return totals.failures == 0 ? 0 : 1;
}
