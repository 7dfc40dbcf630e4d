// SPDX-License-Identifier: Apache-2.0
//
// What the tests of algebraic laws share: families of solids, exact volumes, equality of sets and
// of boundaries.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "engines/engines.h"

namespace algebra {

/// Small random operands that touch and coincide more often than not. Every third family consists
/// of solids free of self-intersection and is taken at its word (Embedding::Assume).
struct Family {
    std::vector<reference::Operand> operands;
    std::vector<trisect::Solid> solids;

    Family(std::uint64_t seed, std::size_t count);
};

/// Leaf sizes and wall offsets vary with the seed: no law may depend on them.
struct Options : trisect::EvaluateOptions {
    Options(std::uint32_t leaf, std::uint32_t offset) : walls(offset) { leaf_polygons = leaf; }
    trisect::detail::SplittingOffset walls;  // while these live
};
Options options_of(std::uint64_t seed);

/// Of a set that may be the complement of a bounded one: then minus the volume of the complement.
trisect::ExactRational volume(const trisect::Expression& e,
                              const trisect::EvaluateOptions& options = {});

/// The symmetric difference is empty.
bool same_set(const trisect::Expression& a, const trisect::Expression& b,
              const trisect::EvaluateOptions& options = {});

/// Why two B-reps differ in faces, points or counts; empty when they do not. The numbering of their
/// entities is free.
std::string difference(const trisect::Brep& a, const trisect::Brep& b);

}  // namespace algebra
