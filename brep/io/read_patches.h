// SPDX-License-Identifier: Apache-2.0
//
// Reading and writing of Bézier patches as text (BPT).
// BPT is the format in which the Utah teapot is distributed: the number of patches; for each
// patch a line with its two degrees and then a line for each control point, row by row (Σ B_i(u)
// B_j(v) P_ij, j runs first). A control point has three numbers, or four in all lines of a
// rational patch: x y z w, where w is its weight and x y z the point itself. `#` begins a
// comment.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <trisect/brep/curved/bezier_patch.h>
#include <trisect/brep/io/read_mesh.h>

namespace trisect {

/// \throw InputError with line and column, LimitError. Numbers are the doubles nearest to their
/// text. Limits count control points as vertices and patches as faces.
[[nodiscard]] std::vector<BezierPatch> read_patches(const std::filesystem::path& path,
                                                    const ReadLimits& limits = {});
/// The same from text; `name` stands for the file in messages.
[[nodiscard]] std::vector<BezierPatch> read_patches(std::string_view text, const std::string& name,
                                                    const ReadLimits& limits = {});

/// Reads back as the same patches, bit for bit.
[[nodiscard]] std::string patches_text(std::span<const BezierPatch> patches);

}  // namespace trisect
