// SPDX-License-Identifier: Apache-2.0
//
// Manual pages of the command in roff.
#pragma once

#include <string>

#include "trisect/command_table.h"

namespace trisect::app {

/// trisect(1): the sub-commands, the common options, exit codes.
[[nodiscard]] std::string program_page(const CommandTable& table);
/// trisect-NAME(1).
[[nodiscard]] std::string command_page(const CommandTable& table, const CommandEntry& command);
/// trisect-mpi(1): the sub-commands that there are on many processes.
[[nodiscard]] std::string ranks_page(const CommandTable& table);

}  // namespace trisect::app
