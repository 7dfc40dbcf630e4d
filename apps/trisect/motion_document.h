// SPDX-License-Identifier: Apache-2.0
//
// Motions as JSON: those that no rational formula describes.
#pragma once

#include <trisect/bsp/interference/enclosed_motion.h>

#include <string>
#include <string_view>

namespace trisect::app {

/// One of
///
///     {"keyframes": [{"time": 0, "rotation": [w, x, y, z], "position": [x, y, z]}, ...]}
///     {"turn": {"axis": [x, y, z], "angle": A, "center": [x, y, z], "shift": [x, y, z],
///               "duration": D, "pose": [m0, ..., m11]}}
///
/// Key frames: constant angular speed from one rotation (a quaternion of any length) to the next,
/// positions on straight lines. A turn: by A radians in all, at constant speed, with a straight
/// shift; from a pose. Times ascend from 0. What is left out is no rotation, 0 or, the duration, 1.
/// \throw InputError that names the member.
[[nodiscard]] EnclosedMotion parse_motion_document(std::string_view text, const std::string& name);

}  // namespace trisect::app
