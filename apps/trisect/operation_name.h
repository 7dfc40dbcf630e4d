// SPDX-License-Identifier: Apache-2.0
//
// Operations by their names in files and on the command line.
#pragma once

#include <string>

#include <trisect/bsp/verify.h>

namespace trisect::app {

/// Of the names of to_string(BooleanOperation); another name is the symmetric difference.
[[nodiscard]] inline BooleanOperation operation_named(const std::string& name) {
    for (const BooleanOperation op :
         {BooleanOperation::Union, BooleanOperation::Intersection, BooleanOperation::Difference})
        if (name == to_string(op)) return op;
    return BooleanOperation::SymmetricDifference;
}

}  // namespace trisect::app
