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
    Linear,
    Revolved,
    Solid,  ///< a shape
    Flat,   ///< a shape of the plane
    Unknown
};

[[nodiscard]] CsgKind csg_kind(std::string_view name);

}  // namespace trisect::detail
