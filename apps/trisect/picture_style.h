// SPDX-License-Identifier: Apache-2.0
//
// PictureStyle: the drawing options of `render`.
#pragma once

#include <cstdint>

#include "png_file.h"

namespace trisect::app {

enum class EdgeStyle : std::uint8_t {
    All,   ///< every edge between two planes, as dark as the others
    Auto,  ///< edges fade where they are shallow and crowded
    None   ///< outlines too are left out
};

enum class Background : std::uint8_t { Light, White, Dark, Transparent };

struct PictureStyle {
    PixelSize size{800, 600};
    std::uint32_t samples = 3;  ///< along a side of a pixel where there is detail
    EdgeStyle edges = EdgeStyle::Auto;
    double line_width = 1.2;  ///< pixels
    Background background = Background::Light;
};

}  // namespace trisect::app
