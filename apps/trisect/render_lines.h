// SPDX-License-Identifier: Apache-2.0
//
// The lines of a picture: outlines and the edges of faces.
#pragma once

#include <cstdint>
#include <vector>

#include "picture_style.h"
#include "render_samples.h"

namespace trisect::app {

/// How dark each sample of the grid is drawn over: 0 not at all, 255 the colour of lines. `width`
/// in pixels. Runs on all threads.
[[nodiscard]] std::vector<std::uint8_t> draw_lines(const Camera& camera, const SampleGrid& grid,
                                                   EdgeStyle style, double width);

}  // namespace trisect::app
