// SPDX-License-Identifier: Apache-2.0
//
// Pictures of milled stocks, with tool and holder at a collision.
#pragma once

#include <string>

#include "mill_job.h"
#include "mill_run.h"

namespace trisect::app {

/// PNG: the stock as it is, what the tool cut in the second colour, and fixtures. After a collision
/// also tool and holder where they were at the last step.
[[nodiscard]] std::string picture_of_run(const MillJob& job, const MillRun& run);

}  // namespace trisect::app
