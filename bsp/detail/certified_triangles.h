// SPDX-License-Identifier: Apache-2.0
//
// What the checkers of certificates share with each other, and with nothing else. In
// check_certificate.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/bsp/interference_certificate.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// The corners of a boundary under a pose, in the user's units; by vertex.
[[nodiscard]] std::vector<RationalPoint> corners_in_world(const Brep& brep, const Pose& pose);

/// Whether triangles fill all faces of a boundary, each once.
[[nodiscard]] bool triangles_fill_faces(const std::vector<CertifiedTriangle>& triangles,
                                        const Brep& brep);

/// Whether a point is in a face or on its outline, under a pose; false when there is no such face.
[[nodiscard]] bool is_on_face(const RationalPoint& point, FaceId face, const Brep& brep,
                              const Pose& pose);

/// Whether a point is inside a solid under a pose, and farther than `radius` from all triangles.
/// They must fill the faces for that to mean anything.
[[nodiscard]] bool is_deep_inside(const RationalPoint& point, const ExactRational& radius,
                                  const std::vector<CertifiedTriangle>& triangles, const Brep& brep,
                                  const Pose& pose);

/// The vertices of a range of triangles, each once.
[[nodiscard]] std::vector<std::uint32_t> corners_of_range(
    const std::vector<CertifiedTriangle>& triangles, std::size_t from, std::size_t to);

}  // namespace trisect::detail
