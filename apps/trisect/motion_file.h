// SPDX-License-Identifier: Apache-2.0
//
// Files of motions: the pose at the start, then the pieces.
// Each is a line.
#pragma once

#include <trisect/bsp/interference/enclosed_motion.h>
#include <trisect/bsp/interference/motion.h>

#include <string>
#include <string_view>
#include <variant>

namespace trisect::app {

/// A rational motion is answered exactly, any other one with certified bounds.
using FileMotion = std::variant<Motion, EnclosedMotion>;

/// A file that begins with '{' is JSON (motion_document.h). Of any other one a line is one of
///
///     m0 m1 ... m11                             a pose, the 3x4 matrix row by row; the first line
///                                               is the start, later ones are reached in straight
///                                               lines
///     screw a b c d  cx cy cz  sx sy sz         a turn by the quaternion (a, b, c, d), integers,
///                                               a > 0, about an axis through (cx, cy, cz), with a
///                                               shift by (sx, sy, sz), from where the motion is
///
/// '#' begins a comment. Numbers are apart by blanks, tabs or commas. A file that begins with a
/// screw starts at the identity; one pose alone stands still.
/// \throw InputError with the line and column.
[[nodiscard]] FileMotion read_motion(const std::string& file);

/// Lines alone, from text; `name` stands for the file in messages.
[[nodiscard]] Motion parse_motion(std::string_view text, const std::string& name);

}  // namespace trisect::app
