// SPDX-License-Identifier: Apache-2.0
//
// Completion of the command's arguments in shells.
#pragma once

#include <string>

#include "trisect/command_table.h"

namespace trisect::app {

[[nodiscard]] std::string bash_completion(const CommandTable& table);
[[nodiscard]] std::string zsh_completion(const CommandTable& table);
[[nodiscard]] std::string fish_completion(const CommandTable& table);

}  // namespace trisect::app
