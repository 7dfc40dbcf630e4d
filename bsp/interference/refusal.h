// SPDX-License-Identifier: Apache-2.0
//
// Refusal: the reason for which a certificate does not hold.
#pragma once

#include <string>

namespace trisect {

/// What check() of a certificate returns unless the certificate holds:
///   if (const auto refusal = check(certificate, a, pose_a, b, pose_b)) report(refusal->reason);
struct Refusal {
    std::string reason;  ///< a sentence that names the part of the certificate
    friend bool operator==(const Refusal&, const Refusal&) = default;
};

}  // namespace trisect
