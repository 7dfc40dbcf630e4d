// SPDX-License-Identifier: Apache-2.0
//
// Lines of fish's own `complete`.
#include "completion.h"
#include "words.h"

namespace trisect::app {
namespace {

/// fish knows \\ and \' within single quotes.
std::string fish_quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') out += '\\';
        out += c;
    }
    return out + "'";
}

std::string option_lines(const CommandEntry& command, const std::string& condition) {
    std::string out;
    for (const OptionEntry& option : command.options) {
        std::string line = "complete -c trisect" + condition;
        for (const std::string& name : option.names)
            line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
        if (option.names.empty()) {
            if (option.words.empty()) continue;
        } else if (option.takes_file) {
            line += " -r -F";
        } else if (!option.value.empty()) {
            line += " -x";
        }
        if (!option.words.empty()) line += " -a " + fish_quoted(joined(option.words, " "));
        out += line + " -d " + fish_quoted(option.help) + "\n";
    }
    return out;
}

}  // namespace

std::string fish_completion(const CommandTable& table) {
    std::string out =
        "# SPDX-License-Identifier: Apache-2.0\n"
        "# fish completion for trisect\n\n"
        "complete -c trisect -n __fish_use_subcommand -f\n";
    for (const CommandEntry& command : table.commands)
        out += "complete -c trisect -n __fish_use_subcommand -a " + command.name + " -d " +
               fish_quoted(command.help) + "\n";
    out += option_lines(table.program, "");
    for (const CommandEntry& command : table.commands)
        out += option_lines(command, " -n '__fish_seen_subcommand_from " + command.name + "'");
    return out;
}

}  // namespace trisect::app
