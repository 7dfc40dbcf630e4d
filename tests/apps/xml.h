// SPDX-License-Identifier: Apache-2.0
//
// As much of XML as drawings use.
#pragma once

#include <string_view>

namespace trisect::test {

/// One element with properly nested ones inside, attributes in quotes, no stray '<', '>' or '&'.
[[nodiscard]] bool is_well_formed_xml(std::string_view text);

}  // namespace trisect::test
