// SPDX-License-Identifier: Apache-2.0
//
// Results of random formulas on a small grid, with their boundary by the reference engine.
#pragma once

#include <cstddef>
#include <cstdint>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/solid.h>

#include "query_oracle.h"

namespace brute {

struct RandomResult {
    trisect::Solid solid;
    Boundary boundary;
    trisect::LatticeMesh mesh;  ///< of all operands, to make points from
};

/// Even seeds take operands that may meet themselves and resolve them; odd ones embedded operands,
/// whose facets pass through and are listed in cells for their boxes alone. Every other pair of
/// seeds has small leaves. `complements`: formulas may take them, so results may be unbounded.
[[nodiscard]] RandomResult random_result(std::uint64_t seed, std::size_t most_operands,
                                         bool complements);
/// The solid alone, of operands in units of 2^bits.
[[nodiscard]] trisect::Solid random_result_solid(std::uint64_t seed, std::size_t most_operands,
                                                 bool complements, int bits);

}  // namespace brute
