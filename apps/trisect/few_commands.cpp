// SPDX-License-Identifier: Apache-2.0
#include "command_with.h"
#include "commands.h"

namespace trisect::app {

SubCommands few_commands() {
    SubCommands out;
    out.push_back(std::make_unique<BooleanCommands>());
    out.push_back(command_with(add_info_command, run_info));
    out.push_back(command_with(add_convert_command, run_convert));
    out.push_back(command_with(add_render_command, run_render));
    return out;
}

}  // namespace trisect::app
