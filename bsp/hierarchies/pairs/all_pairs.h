// SPDX-License-Identifier: Apache-2.0
//
// Exhaustive pairs of triangles, the reference for structures.
#pragma once

#include <memory>

#include <trisect/bsp/hierarchies/pairs/pair_structure.h>

namespace trisect::hierarchies {

[[nodiscard]] std::unique_ptr<PairStructure> make_all_pairs(const InterferenceModel& a,
                                                            const InterferenceModel& b);

}  // namespace trisect::hierarchies
