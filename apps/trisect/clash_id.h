// SPDX-License-Identifier: Apache-2.0
//
// Identities made of texts.
#pragma once

#include <initializer_list>
#include <string>

namespace trisect::app {

/// A name-based UUID of version 8 of some texts.
[[nodiscard]] std::string clash_id(std::initializer_list<std::string> texts);

}  // namespace trisect::app
