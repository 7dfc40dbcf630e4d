// SPDX-License-Identifier: Apache-2.0

#include "random_result.h"

#include <utility>
#include <vector>

#include <trisect/bsp/expression.h>

#include "engines/engines.h"

namespace brute {

namespace {

struct RandomFormula {
    std::vector<reference::Operand> family;
    reference::Expression expression;
    bool embedded = false;
};

RandomFormula random_formula(std::uint64_t seed, std::size_t most_operands, bool complements) {
    reference::Random random(seed);
    const bool embedded = seed % 2 != 0;
    const std::size_t operands = 2 + random.below(most_operands - 1);
    auto family = reference::random_family(random, operands, embedded);
    auto expression = reference::random_expression(random, operands, operands, complements);
    return {std::move(family), std::move(expression), embedded};
}

trisect::Solid evaluated(const RandomFormula& f, std::uint64_t seed, int bits) {
    std::vector<trisect::Solid> solids;
    for (const auto& o : f.family)
        solids.push_back(engines::solid(
            o, f.embedded ? trisect::Embedding::Assume : trisect::Embedding::Resolve, bits));
    trisect::EvaluateOptions options;
    options.leaf_polygons = seed % 4 < 2 ? 60 : 4;
    return evaluate(engines::formula(f.expression, solids), options);
}

}  // namespace

RandomResult random_result(std::uint64_t seed, std::size_t most_operands, bool complements) {
    const RandomFormula f = random_formula(seed, most_operands, complements);
    reference::Operand all;
    for (const auto& o : f.family) all = reference::concatenated(all, o);
    return {evaluated(f, seed, 0), Boundary::of_result(reference::evaluate(f.family, f.expression)),
            engines::lattice_mesh(all)};
}

trisect::Solid random_result_solid(std::uint64_t seed, std::size_t most_operands, bool complements,
                                   int bits) {
    return evaluated(random_formula(seed, most_operands, complements), seed, bits);
}

}  // namespace brute
