// SPDX-License-Identifier: Apache-2.0
//
// Membership in the result of a boolean, by its definition.
#pragma once

#include <trisect/bsp/verify.h>

namespace verify_test {

/// Of a point that is in the operands or not.
[[nodiscard]] inline bool is_member(trisect::BooleanOperation operation, bool in_a, bool in_b) {
    switch (operation) {
        case trisect::BooleanOperation::Union:
            return in_a || in_b;
        case trisect::BooleanOperation::Intersection:
            return in_a && in_b;
        case trisect::BooleanOperation::Difference:
            return in_a && !in_b;
        default:
            return in_a != in_b;
    }
}

}  // namespace verify_test
