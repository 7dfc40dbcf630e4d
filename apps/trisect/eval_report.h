// SPDX-License-Identifier: Apache-2.0
//
// Reports of `eval`: its document, its summary and its progress.
#pragma once

#include <string>

#include <trisect/bsp/csg/csg_evaluate.h>

#include "options.h"
#include "outcome.h"

namespace trisect::app {

[[nodiscard]] Json document_of(const EvalOptions& options, const CsgReport& report);
/// Of a program that is written and not evaluated.
[[nodiscard]] Json document_of(const EvalOptions& options, const CsgTree& tree);

/// Adds the most memory that the process had, in bytes.
void add_peak_memory(Json& document);

/// \pre the document has "triangles", "volume", "seconds" and "peak_memory"
[[nodiscard]] std::string summary_of(const CsgReport& report, const Json& document);

/// "difference, line 12 (3 of 40 nodes done)".
[[nodiscard]] std::string progress_text(const CsgProgress& progress);

}  // namespace trisect::app
