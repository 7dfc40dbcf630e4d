// SPDX-License-Identifier: Apache-2.0
//
// Overlapping tetrahedra, for the checkers of certificates.
// The search for such certificates may use them, too.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include <trisect/bsp/interference/certificate/certified_boundary.h>
#include <trisect/bsp/interference/certificate/certified_motion.h>

namespace trisect::detail::certified {

using Tetrahedron = std::array<ExactPoint, 4>;

/// Whether the interior is there, and inside of a solid: no triangle reaches into it, and a point
/// of it is inside. The triangles must fill the solid's faces.
[[nodiscard]] bool is_within(const Tetrahedron& t, const Boundary& boundary,
                             const std::vector<CertifiedTriangle>& triangles);

/// Whether the interiors of two tetrahedra meet all over a range of time in which `is_positive`
/// judges polynomials. If they did not, a plane along a face of one or along an edge of each would
/// separate them; so for each of these directions, either way, it is enough that some corner of A
/// is beyond some corner of B. `to_a` is how A sees B, with a positive weight.
[[nodiscard]] bool keep_overlapping(const Tetrahedron& a, const Tetrahedron& b, const Piece& to_a,
                                    const std::function<bool(const Polynomial&)>& is_positive);

}  // namespace trisect::detail::certified
