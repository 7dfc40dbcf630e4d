// SPDX-License-Identifier: Apache-2.0
//
// Reports of the library as JSON.
#pragma once

#include <trisect/brep/io/file_remarks.h>
#include <trisect/brep/io/model.h>
#include <trisect/brep/validate/defect.h>

#include <span>

#include "outcome.h"

namespace trisect::app {

/// The listed defects in the order of the report: kind, severity, vertices, faces, place, sentence.
[[nodiscard]] Json defects_json(const ValidationReport& report);
/// Number of defects of each kind that occurs.
[[nodiscard]] Json defect_counts_json(const ValidationReport& report);
/// kind, count, of, line and column or offset, sentence.
[[nodiscard]] Json remarks_json(std::span<const FileRemark> remarks);
/// unit, and of each part name, vertices and faces.
[[nodiscard]] Json model_json(const Model& model);
/// exponent, lossless, moved, max_move.
[[nodiscard]] Json lattice_json(const LatticeReport& report);

}  // namespace trisect::app
