// SPDX-License-Identifier: Apache-2.0
//
// Sub-commands that the program is built with.
#pragma once

#include "trisect/sub_command.h"

#ifdef TRISECT_WITH_COMPARISON
#include "trisect/compare_hierarchies_command.h"
#endif

namespace trisect::app {

inline SubCommands program_commands() {
#ifdef TRISECT_FEW_COMMANDS
    return few_commands();
#else
    SubCommands commands = all_commands();
#ifdef TRISECT_WITH_COMPARISON
    commands.push_back(compare_hierarchies_command());
#endif
    return commands;
#endif
}

}  // namespace trisect::app
