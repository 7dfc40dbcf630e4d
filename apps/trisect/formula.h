// SPDX-License-Identifier: Apache-2.0
//
// Formula: the set that operands and an operation make.
#pragma once

#include <trisect/bsp/expression.h>

#include <string>
#include <vector>

#include "operand.h"

namespace trisect::app {

/// \pre operation is union, intersection, difference or xor, or there is one operand, which is then
/// the formula. difference takes all the others from the first one.
[[nodiscard]] Expression formula(const std::string& operation,
                                 const std::vector<Operand>& operands);

}  // namespace trisect::app
