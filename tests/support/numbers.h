// SPDX-License-Identifier: Apache-2.0
//
// Exact numbers as tests write them.
#pragma once

#include <string>

#include <trisect/brep/exact_rational.h>

namespace numbers {

/// The number that a text says, such as "-7/3".
inline trisect::ExactRational q(const std::string& text) {
    return trisect::ExactRational::from_string(text);
}

/// A double, exactly.
inline trisect::ExactRational exact(double value) {
    return trisect::ExactRational::from_double(value);
}

}  // namespace numbers
