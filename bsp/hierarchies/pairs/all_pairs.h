// SPDX-License-Identifier: Apache-2.0
//
// Every triangle against every other: what structures are compared with.
#pragma once

#include <memory>

#include <trisect/bsp/hierarchies/pairs/pair_structure.h>

namespace trisect::hierarchies {

[[nodiscard]] std::unique_ptr<PairStructure> make_all_pairs(const InterferenceModel& a,
                                                            const InterferenceModel& b);

}  // namespace trisect::hierarchies
