// SPDX-License-Identifier: Apache-2.0
//
// Texts of STEP files: UTF-8 as the alphabet of ISO 10303-21, and back.
#pragma once

#include <string>
#include <string_view>

namespace trisect::detail {

/// UTF-8 of what is between the quotes. The directives S, X, X2 and X4 are carried out; what is
/// malformed in them, and bytes beyond ASCII, stay as they are: texts are names, nothing more. Long
/// texts are cut.
[[nodiscard]] std::string step_string(std::string_view text);

/// With quotes. Bytes that are no UTF-8 become question marks, control characters blanks.
[[nodiscard]] std::string step_quoted(std::string_view utf8);

}  // namespace trisect::detail
