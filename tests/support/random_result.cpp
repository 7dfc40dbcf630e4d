// SPDX-License-Identifier: Apache-2.0

#include "random_result.h"

#include <vector>

#include <trisect/bsp/expression.h>

#include "engines/engines.h"

namespace brute {

RandomResult random_result(std::uint64_t seed, std::size_t most_operands, bool complements) {
    reference::Random random(seed);
    const bool embedded = seed % 2 != 0;
    const std::size_t operands = 2 + random.below(most_operands - 1);
    const auto family = reference::random_family(random, operands, embedded);
    const auto expression = reference::random_expression(random, operands, operands, complements);
    std::vector<trisect::Solid> solids;
    reference::Operand all;
    for (const auto& o : family) {
        solids.push_back(
            engines::solid(o, embedded ? trisect::Embedding::Assume : trisect::Embedding::Resolve));
        all = reference::concatenated(all, o);
    }
    trisect::EvaluateOptions options;
    options.leaf_polygons = seed % 4 < 2 ? 60 : 4;
    return {evaluate(engines::formula(expression, solids), options),
            Boundary::of_result(reference::evaluate(family, expression)),
            engines::lattice_mesh(all)};
}

}  // namespace brute
