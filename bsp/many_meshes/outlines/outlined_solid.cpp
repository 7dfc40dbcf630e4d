// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>

#include <limits>

namespace trisect::detail {

OutlineBox OutlineBox::none() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

}  // namespace trisect::detail
