// SPDX-License-Identifier: Apache-2.0
//
// Separation of triangles with corners near planes.
#pragma once

#include <trisect/bsp/leaf/doubles/triangle_relation.h>

namespace trisect::detail {

/// Whether the part that one triangle has in the other one's plane is beside that other one, with
/// some distance between them: then they have no point in common, and none if they are moved by
/// less than any number. For pairs with corners that are so near a plane that doubles do not decide
/// their side. False where all three are, or one is neither near nor far; says nothing then.
[[nodiscard]] bool are_apart_near_planes(const TriangleAndPlane& first,
                                         const TriangleAndPlane& second);

}  // namespace trisect::detail
