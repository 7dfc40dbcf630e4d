// SPDX-License-Identifier: Apache-2.0
//
// PairStructure of tracked hulls of convex parts.
#pragma once

#include <memory>

#include <trisect/bsp/hierarchies/convex/hull_tree.h>
#include <trisect/bsp/hierarchies/pairs/pair_structure.h>

namespace trisect::hierarchies {

/// A HullTree over each model. Two nodes are apart when their hulls are, which a FeatureWalk
/// decides exactly, from the features where it ended for the same two nodes at the last pose.
///
/// `volume_tests` counts walks; nothing is updated. \throw UsageError as HullTree; queries throw
/// LimitError as interfere(), where hulls are too near for doubles.
[[nodiscard]] std::unique_ptr<PairStructure> make_convex_parts(const InterferenceModel& a,
                                                               const InterferenceModel& b);
[[nodiscard]] std::unique_ptr<PairStructure> make_convex_parts(const InterferenceModel& a,
                                                               const InterferenceModel& b,
                                                               const HullTreeOptions& options);

}  // namespace trisect::hierarchies
