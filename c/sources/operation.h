// SPDX-License-Identifier: Apache-2.0
//
// The operations of the C interface as those of the library.
#pragma once

#include <trisect-c/trisect.h>

#include <trisect/bsp/verify.h>
#include <trisect/kernel/error.h>

namespace trisect::c {

/// \throw UsageError for another number
[[nodiscard]] inline BooleanOperation operation_of(trisect_operation operation) {
    switch (static_cast<int>(operation)) {
        case TRISECT_UNION:
            return BooleanOperation::Union;
        case TRISECT_INTERSECTION:
            return BooleanOperation::Intersection;
        case TRISECT_DIFFERENCE:
            return BooleanOperation::Difference;
        case TRISECT_XOR:
            return BooleanOperation::SymmetricDifference;
        default:
            throw UsageError("operation: is none of trisect_operation");
    }
}

}  // namespace trisect::c
