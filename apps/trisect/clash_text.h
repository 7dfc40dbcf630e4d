// SPDX-License-Identifier: Apache-2.0
//
// ClashText: a clash as a report writes it.
#pragma once

#include <string>

#include "outcome.h"

namespace trisect::app {

/// Whoever finds a clash writes it, and reports put texts together: a tenth of the memory of a
/// document, and no other process has to read what it says.
struct ClashText {
    std::string a;  ///< identities of parts
    std::string b;
    std::string set;
    std::string text;        ///< JSON, indented as in the list of a report
    bool is_answer = false;  ///< otherwise it says why the pair has none
};

[[nodiscard]] ClashText clash_text(const Json& record);

}  // namespace trisect::app
