// SPDX-License-Identifier: Apache-2.0
//
// Scene: first hits of rays, and the look of what they hit.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <vector>

#include "render_camera.h"

namespace trisect::app {

/// The first point of the boundary on a ray.
struct SurfaceHit {
    static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t look = nothing;  ///< index into Scene::looks()
    double t = 0;                  ///< at origin + t * direction
};

/// How a part of the boundary looks that lies in one plane.
struct Look {
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< outward, of length 1
    std::uint32_t plane = 0;  ///< the same number for coplanar parts: no edge is between them
    std::uint16_t color = 0;  ///< number in the palette
    bool is_section = false;  ///< made by cutting the solid open: hatched

    /// Whether nothing is to be seen where the two meet.
    [[nodiscard]] bool continues(const Look& other) const {
        return plane == other.plane && color == other.color && is_section == other.is_section;
    }
};

class Scene {
public:
    Scene() = default;
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;
    virtual ~Scene() = default;

    /// Called from many threads at once.
    [[nodiscard]] virtual SurfaceHit first_hit(const ViewRay& ray) const = 0;
    /// Of everything that was hit until now. Numbers of looks stay; those of planes need not.
    [[nodiscard]] virtual std::vector<Look> looks() const = 0;
    /// What counts as far behind.
    [[nodiscard]] virtual double diameter() const = 0;
};

}  // namespace trisect::app
