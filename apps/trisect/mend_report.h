// SPDX-License-Identifier: Apache-2.0
//
// The report of mending, as JSON and as text.
#pragma once

#include <trisect/brep/mend/mend.h>

#include <cstddef>
#include <string>

#include "outcome.h"

namespace trisect::app {

/// Counts, largest moves, and of each list the first `places` entries.
[[nodiscard]] Json mend_json(const MendReport& report, std::size_t places);

/// A line for each kind of thing that was done or left.
[[nodiscard]] std::string mend_text(const MendReport& report);

}  // namespace trisect::app
