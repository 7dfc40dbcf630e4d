// SPDX-License-Identifier: Apache-2.0
//
// Command line of trisect, from arguments to an exit code.
#pragma once

#include "command_table.h"

namespace trisect::app {

class FurtherCommand;

/// Parses the arguments, runs the sub-command, prints what it has to say and returns the exit code.
/// `further` may be null.
[[nodiscard]] int run(int argc, char** argv, FurtherCommand* further = nullptr);

/// All that the arguments may be.
[[nodiscard]] CommandTable command_table(FurtherCommand* further = nullptr);

}  // namespace trisect::app
