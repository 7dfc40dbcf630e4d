// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/hierarchies/pairs/volume_outline.h>

#include <cmath>

namespace trisect::hierarchies {

void VolumeOutline::to_user(const TreeFrame& frame, Lattice lattice) {
    const double scale = std::ldexp(frame.unit, lattice.exponent);
    Point3d origin = frame.origin;
    for (double& x : origin) x = std::ldexp(x, lattice.exponent);
    for (Slab& s : slabs) {
        const double shift =
            s.direction[0] * origin[0] + s.direction[1] * origin[1] + s.direction[2] * origin[2];
        s.lower = scale * s.lower + shift;
        s.upper = scale * s.upper + shift;
    }
    for (std::size_t k = 0; k < 3; ++k) center[k] = scale * center[k] + origin[k];
    radius *= scale;
}

}  // namespace trisect::hierarchies
