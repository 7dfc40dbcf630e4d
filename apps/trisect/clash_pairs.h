// SPDX-License-Identifier: Apache-2.0
//
// Candidates of clashes: pairs of parts whose boxes meet.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/measure.h>

#include "clash_manifest.h"

namespace trisect::app {

/// Contains what it is of, whatever was rounded.
[[nodiscard]] Bounds posed_box(const Bounds& box, const std::array<double, 12>& pose);

struct ClashCandidate {
    std::uint32_t a = 0;  ///< parts, a < b
    std::uint32_t b = 0;
    friend auto operator<=>(const ClashCandidate&, const ClashCandidate&) = default;
};

/// All pairs of a set whose boxes meet, grown by what a clearance needs; in order. Parts without a
/// box meet nothing.
[[nodiscard]] std::vector<ClashCandidate> clash_candidates(
    const ClashManifest& manifest, std::span<const std::optional<Bounds>> boxes);

}  // namespace trisect::app
