// SPDX-License-Identifier: Apache-2.0
//
// Picture: a scene seen by a camera, as pixels.
#pragma once

#include <cstdint>

#include "picture_style.h"
#include "png_file.h"
#include "render_camera.h"
#include "render_scene.h"

namespace trisect::app {

struct Picture {
    Image image;
    std::uint64_t rays = 0;     ///< that were cast
    std::uint64_t covered = 0;  ///< pixels whose middle ray hit
};

[[nodiscard]] Picture draw_picture(const Scene& scene, const Camera& camera,
                                   const PictureStyle& style);

}  // namespace trisect::app
