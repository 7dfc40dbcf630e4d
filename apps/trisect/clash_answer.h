// SPDX-License-Identifier: Apache-2.0
//
// Answers about pairs of parts, as records of a report.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/kernel/pose.h>

#include "clash_manifest.h"
#include "outcome.h"

namespace trisect::app {

/// What is requested beside the relation.
struct ClashQuestions {
    bool regions = false;
    bool volumes = false;
};

/// A part as questions need it.
struct PlacedPart {
    InterferenceModel model;  ///< shared by all parts of one file
    Pose pose;
    Bounds box;  ///< in the world
    std::string id;
    std::uint32_t group = 0;
};

/// A record for each set in which the pair is a clash, in the order of the sets:
///
///     id       of set and parts, a UUID, the same in every run
///     set, a, b, relation
///     point    in the middle of where the boxes meet
///     size     of that, its diagonal
///     distance lower, upper, on_a, on_b: for clearances of parts that are apart
///     volume   value, exact (a fraction), is_exact: of overlaps, on demand
///     regions  dimension and loops of points: of boundaries that meet, on demand
[[nodiscard]] std::vector<Json> clash_records(std::span<const ClashSet> sets, const PlacedPart& a,
                                              const PlacedPart& b, const ClashQuestions& questions);

/// The same; a pair without an answer has one record, of a, b and error.
[[nodiscard]] std::vector<Json> clash_records_or_error(std::span<const ClashSet> sets,
                                                       const PlacedPart& a, const PlacedPart& b,
                                                       const ClashQuestions& questions);

}  // namespace trisect::app
