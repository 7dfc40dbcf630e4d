// SPDX-License-Identifier: Apache-2.0
//
// Search for points inside and outside of placed solids, for certificates.
#pragma once

#include <vector>

#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/bsp/interference/relation/meeting_pairs.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// Tries to find `in_both`, `only_in_a` and `only_in_b` of a certificate, as far as its relation
/// has such points: beside crossings and contacts first, then anywhere. `pairs` are those that
/// meet.
void find_inside_points(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                        const Pose& pose_a, InterferenceCertificate& certificate);

}  // namespace trisect::detail
