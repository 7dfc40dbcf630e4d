// SPDX-License-Identifier: Apache-2.0
//
// Partitions of space as proofs, for the checkers of certificates.
#pragma once

#include <string>
#include <vector>

#include <trisect/bsp/interference/certificate/certified_boundary.h>
#include <trisect/bsp/interference/interference_certificate.h>

namespace trisect::detail::certified {

/// Why the cells of a certificate do not prove its relation, or "": one boundary misses each open
/// cell, which is then on that side of its solid that says enough. The triangles must fill both
/// boundaries. Clips them by the planes of the cells.
[[nodiscard]] std::string wrong_cells(const InterferenceCertificate& certificate, const Boundary& a,
                                      const Boundary& b);

}  // namespace trisect::detail::certified
