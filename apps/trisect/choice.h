// SPDX-License-Identifier: Apache-2.0
//
// Options with a few words as values.
// The option library prints the enumerators behind the words too, and those of one byte as
// characters, zero bytes among them; here help and errors show the words and nothing else.
#pragma once

#include <trisect/kernel/error.h>

#include <CLI/CLI.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "failure.h"

namespace trisect::app {

template <class Value>
using Choices = std::vector<std::pair<std::string_view, Value>>;

/// The words, with `separator` between them.
template <class Value>
[[nodiscard]] std::string joined_words(const Choices<Value>& choices, std::string_view separator) {
    std::string out;
    for (const auto& [word, value] : choices) {
        if (!out.empty()) out += separator;
        out += word;
    }
    return out;
}

/// `value` keeps what it has unless the option is given. The parse throws UsageError for any other
/// word.
template <class Value>
CLI::Option* add_choice_option(CLI::App& command, const std::string& name, Value& value,
                               const Choices<Value>& choices, const std::string& help) {
    const auto choose = [&value, choices, name](const std::string& text) {
        for (const auto& [word, meaning] : choices) {
            if (word != text) continue;
            value = meaning;
            return;
        }
        throw UsageError(name + ": '" + text + "' is none of " + joined_words(choices, ", "));
    };
    return command.add_option_function<std::string>(name, choose, help)
        ->type_name(joined_words(choices, "|"));
}

/// The same for options whose value is the word itself.
inline CLI::Option* add_word_option(CLI::App& command, const std::string& name, std::string& value,
                                    const std::vector<std::string_view>& words,
                                    const std::string& help) {
    Choices<std::string> choices;
    for (const std::string_view word : words) choices.emplace_back(word, word);
    return add_choice_option(command, name, value, choices, help);
}

}  // namespace trisect::app
