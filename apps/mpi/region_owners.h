// SPDX-License-Identifier: Apache-2.0
//
// region_owners: ranks of the regions of space.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "part_messages.h"

namespace trisect::app {

/// The rank of each region; all have as many, or one less. Where parts that follow each other in
/// the manifest are near each other, each rank has the regions of which it has read most, so that
/// few parts change ranks; otherwise regions that are beside each other, so that few parts are of
/// two ranks. Reports do not depend on it.
/// \param surveys of all ranks, with their samples
[[nodiscard]] std::vector<std::uint32_t> region_owners(const ClashDivision& regions,
                                                       std::span<const PartSurvey> surveys);

}  // namespace trisect::app
