// SPDX-License-Identifier: Apache-2.0
//
// Text in XML documents.
#pragma once

#include <string>
#include <string_view>

namespace trisect::app {

/// As content of an element or value of an attribute; control characters become blanks.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace trisect::app
