// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/mirrored.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/error.h>

namespace trisect {

AffineMap mirror_map(const std::array<double, 4>& plane) {
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) size = std::max(size, std::fabs(plane[k]));
    if (!std::isfinite(size) || !(size > 0) || !std::isfinite(plane[3]))
        throw UsageError("the normal of a mirror must be finite and not 0");
    // A power of two keeps all digits, and squares in range.
    const int exponent = -std::ilogb(size);
    std::array<double, 3> n{};
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        n[k] = std::ldexp(plane[k], exponent);
        squared += n[k] * n[k];
    }
    const double distance = std::ldexp(plane[3], exponent);
    if (!std::isfinite(distance))
        throw UsageError("the plane of a mirror is too far from the origin");
    AffineMap out;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) out.rows[i][j] -= 2 * n[i] * n[j] / squared;
        out.rows[i][3] = -2 * n[i] * distance / squared + 0.0;
    }
    return out;
}

Solid mirrored(const Solid& solid, const std::array<double, 4>& plane, LatticeReport* report) {
    return transformed(solid, mirror_map(plane), report);
}

Solid mirrored(const Solid& solid, const Point3d& normal, LatticeReport* report) {
    return mirrored(solid, std::array<double, 4>{normal[0], normal[1], normal[2], 0}, report);
}

Solid mirrored(const Solid& solid, int axis) {
    if (axis < 0 || axis > 2) throw UsageError("the axis of a mirror is 0, 1 or 2");
    return transformed(solid, AffineMap::mirror(axis));
}

}  // namespace trisect
