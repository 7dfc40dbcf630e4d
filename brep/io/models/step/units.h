// SPDX-License-Identifier: Apache-2.0
//
// Units and uncertainties of the contexts of STEP representations.
#pragma once

#include <trisect/brep/io/models/step/text.h>

#include <string>

namespace trisect::detail {

struct StepContext {
    std::string unit;        ///< "millimeter", "inch"; empty where there is none
    double uncertainty = 0;  ///< of lengths, as stated; 0 where there is none
};

/// Of a context entity. An unknown conversion is named by its factor: "0.5 meter".
/// \throw InputError for malformed ones
[[nodiscard]] StepContext step_context(const StepText& text, const StepEntity& context);

}  // namespace trisect::detail
