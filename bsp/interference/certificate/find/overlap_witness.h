// SPDX-License-Identifier: Apache-2.0
//
// Search for tetrahedra that overlap right after an event.
#pragma once

#include <optional>

#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/motion.h>
#include <trisect/bsp/interference/overlap_certificate.h>

namespace trisect::detail {

/// For an event as `c` names it; the triangles of the certificate must be there. What is found
/// holds. Nothing where no tetrahedra of the kinds that are tried overlap.
[[nodiscard]] std::optional<OverlapWitness> find_overlap_witness(const OverlapCertificate& c,
                                                                 const InterferenceModel& a,
                                                                 const Motion& motion_a,
                                                                 const InterferenceModel& b,
                                                                 const Motion& motion_b);

}  // namespace trisect::detail
