// SPDX-License-Identifier: Apache-2.0
//
// What check() of a certificate answers, as text.
#pragma once

#include <optional>
#include <string>

#include <trisect/bsp/interference/refusal.h>

namespace refusals {

/// Empty where there is no refusal.
inline std::string reason(const std::optional<trisect::Refusal>& refusal) {
    return refusal ? refusal->reason : std::string();
}

}  // namespace refusals
