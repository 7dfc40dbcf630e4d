// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/resized.h>

#include <cmath>
#include <cstddef>

#include <trisect/brep/transform.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/error.h>

namespace trisect {

Point3d resize_factors(const Bounds& box, const Point3d& sizes,
                       const std::array<bool, 3>& follows) {
    Point3d out{1, 1, 1};
    std::size_t largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!std::isfinite(sizes[k])) throw UsageError("a new size must be finite");
        if (sizes[k] > 0) out[k] = sizes[k] / (box.hi[k] - box.lo[k]);
        if (sizes[k] > sizes[largest]) largest = k;
    }
    for (std::size_t k = 0; k < 3; ++k)
        if (!(sizes[k] > 0) && follows[k]) out[k] = out[largest];
    return out;
}

Solid resized(const Solid& solid, const Point3d& sizes, const std::array<bool, 3>& follows,
              LatticeReport* report) {
    if (report != nullptr) *report = {};
    const auto box = bounds(solid);
    if (!box) return solid;
    const Point3d factors = resize_factors(*box, sizes, follows);
    if (factors == Point3d{1, 1, 1}) return solid;
    return transformed(solid, AffineMap::scaling(factors), report);
}

}  // namespace trisect
