// SPDX-License-Identifier: Apache-2.0
//
// Counted and timed queries of a structure for a sequence of poses.
#pragma once

#include <span>

#include "comparison.h"

namespace scenes {

/// Of this thread: what else the machine does is no part of it.
[[nodiscard]] double processor_seconds();

/// Places the structure at every pose, B against A where it was modelled, and asks.
trisect::hierarchies::CostCounters run(trisect::hierarchies::PairStructure& structure,
                                       std::span<const trisect::Pose> poses, Question question);

/// The least time of as many rounds as fit into `seconds`: at least two.
[[nodiscard]] double least_time(trisect::hierarchies::PairStructure& structure,
                                std::span<const trisect::Pose> poses, Question question,
                                double seconds);

}  // namespace scenes
