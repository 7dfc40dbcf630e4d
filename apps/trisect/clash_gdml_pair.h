// SPDX-License-Identifier: Apache-2.0
//
// Two volumes of a GDML geometry, compared.
#pragma once

#include <optional>

#include "clash_answer.h"
#include "outcome.h"

namespace trisect::app {

/// A volume in the frame of its mother, in steps of 1e-9 mm.
struct GdmlPart {
    PlacedPart placed;
    /// How far its boundary is from the one that is meant, at most: facets of round surfaces,
    /// rounded corners, rounded turns.
    double deviation = 0;
};

enum class GdmlRule : std::uint8_t { Apart, Within };

struct GdmlFinding {
    /// A record as clash_records has them, without `id` and `set`, in millimetres, with
    ///
    ///     deviation         of both from what is meant
    ///     within_deviation  whether a move by no more than that removes the clash
    ///     volume            of the overlap, or of what protrudes
    std::optional<Json> clash;
    /// What is proved of a pair that does not clash.
    enum class Proof : std::uint8_t {
        Exact,   ///< nothing was rounded
        Beyond,  ///< boundaries are farther apart than what was
        Facets   ///< it is so of the facets
    } proof = Proof::Exact;
};

/// Whether a and b are apart, or a is within b.
[[nodiscard]] GdmlFinding compare_gdml_parts(GdmlRule rule, const GdmlPart& a, const GdmlPart& b,
                                             bool volumes);

}  // namespace trisect::app
