// SPDX-License-Identifier: Apache-2.0
//
// One function of bash. It needs no library of completion functions: bash splits `--option=value`
// into three words, which is undone here.
#include "completion.h"
#include "words.h"

namespace trisect::app {
namespace {

std::string option_names(const CommandEntry& command) {
    std::vector<std::string> names;
    for (const OptionEntry& option : command.options)
        names.insert(names.end(), option.names.begin(), option.names.end());
    return joined(names, " ");
}

/// Patterns of a case over "command option", with the words for its value or the mark of files.
std::string value_cases(const CommandEntry& command, const std::string& pattern) {
    std::string out;
    for (const OptionEntry& option : command.options) {
        if (option.value.empty()) continue;
        const std::string value = option.takes_file ? "@files" : joined(option.words, " ");
        std::vector<std::string> patterns;
        for (const std::string& name : option.names) patterns.push_back(pattern + name);
        if (!patterns.empty())
            out += "    " + joined(patterns, " | ") + ") echo " + quoted(value) + " ;;\n";
    }
    return out;
}

std::string argument_words(const CommandEntry& command) {
    for (const OptionEntry& option : command.options)
        if (option.names.empty() && !option.words.empty()) return joined(option.words, " ");
    return {};
}

constexpr const char* last_function = R"sh(
_trisect() {
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} command= word i
    COMPREPLY=()
    if [ "$cur" = = ]; then
        cur=
    elif [ "$prev" = = ] && [ "$COMP_CWORD" -gt 1 ]; then
        prev=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    for ((i = 1; i < COMP_CWORD; ++i)); do
        word=${COMP_WORDS[i]}
        case $word in
        -*)
            _trisect_value "$command" "$word" >/dev/null && ((++i))
            [ "${COMP_WORDS[i]}" != = ] || ((++i))
            ;;
        *)
            command=$word
            break
            ;;
        esac
    done
    local values
    if values=$(_trisect_value "$command" "$prev"); then
        [ "$values" = @files ] || {
            COMPREPLY=($(compgen -W "$values" -- "$cur"))
            return
        }
    elif [ "${cur:0:1}" = - ]; then
        COMPREPLY=($(compgen -W "$(_trisect_options "$command")" -- "$cur"))
        return
    elif [ -z "$command" ]; then
        COMPREPLY=($(compgen -W "$(_trisect_commands)" -- "$cur"))
        return
    elif [ "$command" = "$prev" ] && values=$(_trisect_arguments "$command"); then
        COMPREPLY=($(compgen -W "$values" -- "$cur"))
        return
    fi
    local IFS=$'\n'
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$cur"))
}
complete -F _trisect trisect
)sh";

}  // namespace

std::string bash_completion(const CommandTable& table) {
    std::vector<std::string> names;
    std::string options;
    std::string values;
    std::string arguments;
    for (const CommandEntry& command : table.commands) {
        names.push_back(command.name);
        options += "    " + command.name + ") echo " + quoted(option_names(command)) + " ;;\n";
        values += value_cases(command, command.name + "\\ ");
        const std::string words = argument_words(command);
        if (!words.empty())
            arguments += "    " + command.name + ") echo " + quoted(words) + " ;;\n";
    }
    values += value_cases(table.program, "*\\ ");
    return "# SPDX-License-Identifier: Apache-2.0\n"
           "# bash completion for trisect\n\n"
           "_trisect_commands() { echo " +
           quoted(joined(names, " ")) +
           "; }\n"
           "_trisect_options() { # command\n    echo " +
           quoted(option_names(table.program)) + "\n    case $1 in\n" + options +
           "    esac\n}\n"
           "# Words for the value of an option, or @files; fails where it takes none.\n"
           "_trisect_value() { # command option\n    case \"$1 $2\" in\n" +
           values +
           "    *) return 1 ;;\n    esac\n}\n"
           "# Words for the first argument; fails where that is a file.\n"
           "_trisect_arguments() { # command\n    case $1 in\n" +
           arguments + "    *) return 1 ;;\n    esac\n}\n" + last_function;
}

}  // namespace trisect::app
