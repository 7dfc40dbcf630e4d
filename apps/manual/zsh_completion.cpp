// SPDX-License-Identifier: Apache-2.0
//
// One function of zsh, by its own _arguments.
#include "completion.h"
#include "words.h"

namespace trisect::app {
namespace {

/// Within a specification of _arguments colons and brackets have a meaning.
std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == ':' || c == '[' || c == ']' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

std::string action(const OptionEntry& option) {
    if (option.takes_file) return "_files";
    return option.words.empty() ? " " : "(" + joined(option.words, " ") + ")";
}

std::string specification(const OptionEntry& option) {
    const std::string value =
        option.value.empty() ? "" : ":" + escaped(option.value) + ":" + action(option);
    std::string out;
    for (const std::string& name : option.names)
        out += " \\\n        " + quoted("*" + name + "[" + escaped(option.help) + "]" + value);
    return out;
}

std::string specifications(const CommandEntry& command) {
    std::string out;
    for (const OptionEntry& option : command.options) out += specification(option);
    return out;
}

/// The first argument has words, or all are files.
std::string arguments(const CommandEntry& command) {
    std::string out;
    for (const OptionEntry& option : command.options)
        if (option.names.empty() && !option.words.empty())
            out += " \\\n        " + quoted("1:" + option.value + ":" + action(option));
    return out + " \\\n        '*:file:_files'";
}

}  // namespace

std::string zsh_completion(const CommandTable& table) {
    std::string names;
    std::string cases;
    for (const CommandEntry& command : table.commands) {
        names += "        " + quoted(command.name + ":" + escaped(command.help)) + "\n";
        cases += "    " + command.name + ")\n        _arguments -S $common" +
                 specifications(command) + arguments(command) + "\n        ;;\n";
    }
    return "#compdef trisect\n"
           "# SPDX-License-Identifier: Apache-2.0\n\n"
           "_trisect() {\n"
           "    local context state state_descr line\n"
           "    typeset -A opt_args\n"
           "    local -a commands common\n"
           "    commands=(\n" +
           names + "    )\n    common=(" + specifications(table.program) +
           "\n    )\n"
           "    _arguments -C $common '1:command:->command' '*::argument:->argument'\n"
           "    case $state in\n"
           "    command)\n"
           "        _describe command commands\n"
           "        return\n"
           "        ;;\n"
           "    esac\n"
           "    [[ $state = argument ]] || return\n"
           "    case $words[1] in\n" +
           cases + "    esac\n}\n\n_trisect \"$@\"\n";
}

}  // namespace trisect::app
