// SPDX-License-Identifier: Apache-2.0
#include "rank_slab_command.h"

#include <CLI/CLI.hpp>

#include "rank_slabs.h"
#include "trisect/slab_command.h"

namespace trisect::app {

void RankSlabCommand::declare(CLI::App& app) {
    const auto add = [&](const char* name, const char* help) {
        CLI::App& command = *app.add_subcommand(name, help);
        command.add_option("A B", options_.inputs, "meshes or native files, two or more")
            ->required()
            ->expected(2, 1 << 20);
        command.add_option("-o,--output", options_.output, "result, .ply or .stl")->required();
        command.add_flag("--assume-embedded", options_.operands.assume_embedded,
                         "take inputs to be free of self-intersection: faster, wrong if they are "
                         "not");
        add_slab_options(command, options_);
    };
    add("union", "points in any of the inputs");
    add("intersection", "points in all of the inputs");
    add("difference", "points in the first input and in none of the others");
}

Outcome RankSlabCommand::run(Session& session, const std::string& name) const {
    BooleanOptions options = options_;
    options.operation = name;
    is_open_ = true;
    Outcome out;
    try {
        out = RankSlabs(session, options).run();
    } catch (...) {
        // All ranks end a step with the same failure.
        is_open_ = false;
        throw;
    }
    is_open_ = false;
    return out;
}

}  // namespace trisect::app
