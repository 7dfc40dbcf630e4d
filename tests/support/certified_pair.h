// SPDX-License-Identifier: Apache-2.0
//
// Pairs of moving solids with what proves their first contact, or their first overlap.
#pragma once

#include <string>

#include <trisect/bsp/interference/contact_certificate.h>
#include <trisect/bsp/interference/overlap_certificate.h>

#include "moving_pair.h"
#include "support/reason.h"

namespace moving {

struct ContactPair : Pair {
    [[nodiscard]] trisect::ContactCertificate certificate() const {
        return certify_first_contact(a, motion_a, b, motion_b);
    }
    [[nodiscard]] std::string check(const trisect::ContactCertificate& c) const {
        return refusals::reason(trisect::check(c, a.brep(), motion_a, b.brep(), motion_b));
    }
};

struct OverlapPair : Pair {
    [[nodiscard]] trisect::OverlapCertificate certificate() const {
        return certify_first_overlap(a, motion_a, b, motion_b);
    }
    [[nodiscard]] std::string check(const trisect::OverlapCertificate& c) const {
        return refusals::reason(trisect::check(c, a.brep(), motion_a, b.brep(), motion_b));
    }
};

}  // namespace moving
