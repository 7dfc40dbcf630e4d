// SPDX-License-Identifier: Apache-2.0
//
// Options of Solid as Python spells them.
#pragma once

#include <string>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

namespace trisect::python {

/// \throw UsageError for another word
[[nodiscard]] inline Embedding embedding_of(const std::string& word) {
    if (word == "assume") return Embedding::Assume;
    if (word == "resolve") return Embedding::Resolve;
    if (word == "check") return Embedding::Check;
    throw UsageError("embedding: must be 'assume', 'check' or 'resolve', not '" + word + "'");
}

/// \throw UsageError for another word
[[nodiscard]] inline EvaluateOptions::Winding winding_of(const std::string& word) {
    if (word == "positive") return EvaluateOptions::Winding::Positive;
    if (word == "nonzero") return EvaluateOptions::Winding::NonZero;
    throw UsageError("winding: must be 'positive' or 'nonzero', not '" + word + "'");
}

}  // namespace trisect::python
