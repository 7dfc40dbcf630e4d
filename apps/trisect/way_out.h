// SPDX-License-Identifier: Apache-2.0
//
// Advice on each kind of defect.
// docs/invalid_solid.md has more on each.
#pragma once

#include <trisect/brep/validate/defect.h>

#include <string>
#include <string_view>

namespace trisect::app {

/// Commands that help, or that nothing is needed. A part of a sentence.
[[nodiscard]] std::string_view way_out(DefectKind kind);

/// A line for each kind that was found: "way out of open_edge: ...".
[[nodiscard]] std::string ways_out_text(const ValidationReport& report);

/// The same of errors alone, in one line; empty where there are none.
[[nodiscard]] std::string way_out_hint(const ValidationReport& report);

}  // namespace trisect::app
