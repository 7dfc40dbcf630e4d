// SPDX-License-Identifier: Apache-2.0
//
// Command line of trisect, from arguments to an exit code.
#pragma once

#include "command_table.h"
#include "sub_command.h"

namespace trisect::app {

/// Parses the arguments, runs the sub-command, prints what it has to say and returns the exit code.
[[nodiscard]] int run(int argc, char** argv, const SubCommands& commands);

/// All that the arguments may be.
[[nodiscard]] CommandTable command_table(const SubCommands& commands);

}  // namespace trisect::app
