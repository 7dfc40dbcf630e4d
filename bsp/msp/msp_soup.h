// SPDX-License-Identifier: Apache-2.0
//
// MspSoup: a boundary as convex polygons with identified edges and corners.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <trisect/bsp/msp/msp_geometry.h>

namespace trisect::detail::msp {

struct MspSoup {
    MspGeometry geometry;
    std::vector<Fragment> fragments;  ///< in the order of faces
    std::size_t face_count = 0;
};

/// Every face as one convex polygon if it is one, else divided. \throw as MspTree::from_brep.
[[nodiscard]] MspSoup soup_of(const Brep& brep);
[[nodiscard]] MspSoup soup_of(std::span<const MspPolygon> polygons);

}  // namespace trisect::detail::msp
