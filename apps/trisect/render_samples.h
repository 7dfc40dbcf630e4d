// SPDX-License-Identifier: Apache-2.0
//
// SampleGrid: hits of the rays of a picture, with local supersampling.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render_camera.h"
#include "render_scene.h"

namespace trisect::app {

/// A grid of `per_pixel` by `per_pixel` samples in each pixel, row by row from the top.
struct SampleGrid {
    SampleGrid(PixelSize pixels, std::uint32_t samples);

    PixelSize pixels;
    std::uint32_t per_pixel;
    PixelSize size;                   ///< of the grid
    std::vector<std::uint32_t> look;  ///< into looks, or SurfaceHit::nothing
    std::vector<float> depth;         ///< along the ray; 0 where nothing was hit
    std::vector<Look> looks;
    std::uint64_t rays = 0;  ///< that were really cast

    [[nodiscard]] std::size_t index(std::uint32_t x, std::uint32_t y) const {
        return std::size_t{y} * size.width + x;
    }
    /// The ray of a sample.
    [[nodiscard]] ViewRay ray(const Camera& camera, std::uint32_t x, std::uint32_t y) const {
        return camera.ray((x + 0.5) / per_pixel, (y + 0.5) / per_pixel);
    }
};

/// The plane that a ray hit as it is met by another ray: distance along that ray.
[[nodiscard]] double plane_distance(const ViewRay& hit_ray, double hit_depth,
                                    const Eigen::Vector3d& normal, const ViewRay& other);

/// One ray through each pixel, and all rays of a pixel where its neighbours hit something else.
/// Where they all hit one plane the remaining samples are that plane. Runs on all threads.
[[nodiscard]] SampleGrid cast_rays(const Scene& scene, const Camera& camera, PixelSize pixels,
                                   std::uint32_t per_pixel);

}  // namespace trisect::app
