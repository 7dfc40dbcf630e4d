// SPDX-License-Identifier: Apache-2.0
//
// CsgFrame: the place of shapes.
#pragma once

#include <cstdint>

#include <trisect/brep/transform.h>

#include <trisect/bsp/csg/csg_arguments.h>

namespace trisect::detail {

/// Shapes of the plane become prisms between two heights first.
struct CsgFrame {
    /// Within what has a colour, or is made of its children as a whole, color() changes nothing.
    static constexpr std::int32_t fixed_color = -2;
    static constexpr std::int32_t no_color = -1;

    AffineMap map;
    double low = 0;
    double high = 1;
    std::int32_t color = fixed_color;  ///< or one of CsgKept::colors()
};

/// The matrix of multmatrix(); `flat`: of the plane alone.
/// \throw CsgError (Unsupported) unless the last row is 0, 0, 0, 1
[[nodiscard]] AffineMap csg_matrix(const CsgArguments& arguments, bool flat);

/// Whether each new axis is one of the old ones.
[[nodiscard]] bool changes_axes(const AffineMap& map);

}  // namespace trisect::detail
