// SPDX-License-Identifier: Apache-2.0
//
// Page of an assembly with its clashes.
#pragma once

#include <functional>
#include <string>

#include "clash_answer.h"
#include "clash_report.h"

namespace trisect::app {

/// Parts of clashes in full, and as many of the others as a page can hold: up to some triangles
/// altogether.
[[nodiscard]] std::string clash_page(const ClashManifest& manifest, const ClashReport& report,
                                     const std::function<PlacedPart(std::uint32_t)>& part);

}  // namespace trisect::app
