// SPDX-License-Identifier: Apache-2.0
//
// CommandTable: sub-commands and options of the command, as plain data.
// Manual pages and shell completion are made from it, so they have what the command has.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace trisect::app {

/// An option, or an argument without a name of its own.
struct OptionEntry {
    std::vector<std::string> names;  ///< "-o", "--output"; empty: an argument
    std::string value;               ///< what stands for the value; empty: a flag
    std::vector<std::string> words;  ///< values of which one is to be chosen, if there are such
    std::string help;
    bool takes_file = false;
    bool is_required = false;
};

struct CommandEntry {
    std::string name;
    std::string help;
    std::vector<OptionEntry> options;
};

struct CommandTable {
    CommandEntry program;  ///< with the options that all commands have
    std::string version;
    std::string footer;  ///< exit codes and formats
    std::vector<CommandEntry> commands;
};

[[nodiscard]] CommandTable table_of(const CLI::App& app);

}  // namespace trisect::app
