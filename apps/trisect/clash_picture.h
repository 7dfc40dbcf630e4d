// SPDX-License-Identifier: Apache-2.0
//
// Pictures of clashes.
#pragma once

#include <string>

#include "clash_answer.h"

namespace trisect::app {

/// Both parts around the clash, each in its colour, cut open through its middle; a PNG file.
[[nodiscard]] std::string clash_picture(const Json& clash, const PlacedPart& a,
                                        const PlacedPart& b);

}  // namespace trisect::app
