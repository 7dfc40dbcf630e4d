// SPDX-License-Identifier: Apache-2.0
//
// CsgKind: kinds of nodes, by their names.
#pragma once

#include <cstdint>
#include <string_view>

namespace trisect::detail {

enum class CsgKind : std::uint8_t {
    Group,
    Difference,
    Intersection,
    Matrix,
    Hull,
    Minkowski,
    Resize,
    Offset,
    Projection,
    Import,
    Linear,
    Revolved,
    Solid,  ///< a shape
    Flat,   ///< a shape of the plane
    Unknown
};

[[nodiscard]] CsgKind csg_kind(std::string_view name);

/// Whether it is put into place as one shape, whatever it is made of.
[[nodiscard]] bool csg_is_whole(CsgKind kind);

/// 2 or 3; 0 where it is that of the children, or of the file that is read.
[[nodiscard]] int csg_dimension(CsgKind kind);

}  // namespace trisect::detail
