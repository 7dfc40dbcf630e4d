// SPDX-License-Identifier: Apache-2.0
//
// Areas of formulas over regions of the plane, in rationals: slabs between all places where
// something begins, ends or crosses, each cut into trapezoids. Nothing is joined or named.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "rational.h"

namespace reference {

struct FlatOperand {
    std::vector<std::vector<Point2>> outlines;
    bool odd = false;  // inside where an odd number goes around; else where a positive one does
};

using FlatFormula = std::function<bool(const std::vector<bool>& inside)>;

// Of where the formula holds. \pre it does not far away
Rational flat_area(const std::vector<FlatOperand>& operands, const FlatFormula& formula);

}  // namespace reference
