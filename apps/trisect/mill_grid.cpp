// SPDX-License-Identifier: Apache-2.0
#include "mill_grid.h"

#include <trisect/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trisect::app {

int MillGrid::exponent_for(double largest) {
    constexpr int bits = 28;
    int above = 0;
    std::frexp(std::max(largest, 0x1p-900), &above);
    const int finest = above - bits;
    return 8 * static_cast<int>(std::floor(finest / 8.0));
}

Point3d MillGrid::rounded(const Point3d& user) {
    Point3d out{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double steps = std::nearbyint(std::ldexp(user[k], -exponent_));
        out[k] = std::ldexp(steps, exponent_ - lattice_.exponent) + 0.0;
        // Two of these are added: a tool's corner and its position.
        if (!(std::abs(out[k]) < 0x1p51))
            throw LimitError("the tool path leaves the range of the stock's lattice");
        max_move_ = std::max(max_move_, std::abs(std::ldexp(steps, exponent_) - user[k]));
    }
    return out;
}

Point3d MillGrid::to_user(const Point3d& p) const {
    return {lattice_.to_double(p[0]), lattice_.to_double(p[1]), lattice_.to_double(p[2])};
}

}  // namespace trisect::app
