// SPDX-License-Identifier: Apache-2.0
//
// What the checkers of certificates share with each other, and with nothing else.
#pragma once

#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/bsp/interference_certificate.h>

namespace trisect::detail {

/// Whether triangles fill all faces of a boundary, each once. In check_certificate.cpp.
[[nodiscard]] bool triangles_fill_faces(const std::vector<CertifiedTriangle>& triangles,
                                        const Brep& brep);

}  // namespace trisect::detail
