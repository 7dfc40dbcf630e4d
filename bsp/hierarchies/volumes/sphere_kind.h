// SPDX-License-Identifier: Apache-2.0
//
// SphereKind: spheres as volumes of a hierarchy (volume_hierarchy.h).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include <trisect/bsp/hierarchies/pairs/tree_frame.h>
#include <trisect/bsp/hierarchies/pairs/volume_outline.h>
#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::hierarchies {

struct Sphere {
    std::array<float, 3> center{};
    float radius = 0;

    [[nodiscard]] detail::Vector3 middle() const { return {center[0], center[1], center[2]}; }
};

[[nodiscard]] inline double squared_distance(const detail::Vector3& a, const detail::Vector3& b) {
    const detail::Vector3 d = detail::minus(a, b);
    return detail::dot(d, d);
}

struct SphereKind {
    using Volume = Sphere;
    using Moved = Sphere;
    class Pose {
    public:
        explicit Pose(const FrameMap& map)
            : map_(map), error_(1.7321 * map.error() + 0x1p-40), stretch_(map.stretch) {}
        [[nodiscard]] Moved moved(const Volume& v) const;
        [[nodiscard]] static bool meet(const Volume& a, const Moved& b) {
            const double reach = static_cast<double>(a.radius) + static_cast<double>(b.radius);
            return squared_distance(a.middle(), b.middle()) <= reach * reach * detail::surely_more;
        }
        [[nodiscard]] static double gap(const Volume& a, const Moved& b) {
            const double reach = static_cast<double>(a.radius) + static_cast<double>(b.radius);
            return std::max(
                0.0,
                std::sqrt(squared_distance(a.middle(), b.middle())) * detail::surely_less - reach);
        }

    private:
        FrameMap map_;
        double error_;
        double stretch_;
    };
    static constexpr bool has_unite = false;
    /// Around points that are known within `error`, as small as is found.
    static Volume fit(std::span<const detail::Vector3> corners, double error);
    /// The same about a given centre.
    static Volume fit_about(const detail::Vector3& center, std::span<const detail::Vector3> corners,
                            double error);
    static float size(const Volume& v) { return v.radius; }
    static VolumeOutline outline(const Volume& v) {
        VolumeOutline out;
        out.center = v.middle();
        out.radius = v.radius;
        return out;
    }
};

}  // namespace trisect::hierarchies
