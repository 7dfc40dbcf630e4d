// SPDX-License-Identifier: Apache-2.0
//
// Colours of corners as a format has them.
// Between corners a colour is interpolated in the numbers that the corners have, so operands are
// brought to the numbers of the output before a boolean interpolates.
#pragma once

#include <trisect/brep/corner_properties.h>
#include <trisect/brep/io/mesh_format.h>

namespace trisect {

/// Whether colours of corners are amounts of light (GLB); in others they are sRGB.
[[nodiscard]] bool has_linear_colors(MeshFormat format) noexcept;

/// Turns each colour into the other kind of numbers, where it is not of that kind; opacity stays.
void convert_colors(CornerProperties& properties, bool to_linear);

}  // namespace trisect
