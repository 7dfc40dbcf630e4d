// SPDX-License-Identifier: Apache-2.0
#include "command_with.h"
#include "commands.h"
#include "slice_command.h"

namespace trisect::app {

SubCommands all_commands() {
    SubCommands out;
    out.push_back(std::make_unique<BooleanCommands>());
    out.push_back(command_with(add_split_command, run_split));
    out.push_back(command_with(add_info_command, run_info));
    out.push_back(command_with(add_check_command, run_check));
    out.push_back(command_with(add_mend_command, run_mend));
    out.push_back(command_with(add_diff_command, run_diff));
    out.push_back(command_with(add_verify_command, run_verify));
    out.push_back(command_with(add_corpus_command, run_corpus));
    out.push_back(command_with(add_convert_command, run_convert));
    out.push_back(command_with(add_tessellate_command, run_tessellate));
    out.push_back(command_with(add_eval_command, run_eval));
    out.push_back(command_with(add_locate_command, run_locate));
    out.push_back(command_with(add_sweep_command, run_sweep));
    out.push_back(command_with(add_section_command, run_section));
    out.push_back(command_with(add_slice_command, run_slice));
    out.push_back(command_with(add_view_command, run_view));
    out.push_back(command_with(add_render_command, run_render));
    out.push_back(command_with(add_tree_command, run_tree));
    out.push_back(command_with(add_interfere_command, run_interfere));
    out.push_back(command_with(add_clash_command, run_clash));
    out.push_back(command_with(add_mill_command, run_mill));
    return out;
}

}  // namespace trisect::app
