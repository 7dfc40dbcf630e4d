// SPDX-License-Identifier: Apache-2.0
#include "command_table.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string_view>

namespace trisect::app {
namespace {

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(separator), text.size());
        parts.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return parts;
}

/// "z" is a word that a user types, "X,Y,Z" and "z=NUMBER" stand for others.
bool is_word(std::string_view text) {
    return std::ranges::all_of(text, [](char c) { return (c >= 'a' && c <= 'z') || c == '-'; });
}

/// The option library shows what may be chosen behind the type: "TEXT:{cubes,prisms}".
void read_type(const std::string& type, OptionEntry& entry) {
    const std::size_t list = type.find(":{");
    if (list != std::string::npos) {
        entry.value = "NAME";
        entry.words = split(std::string_view(type).substr(list + 2, type.size() - list - 3), ',');
        return;
    }
    entry.value = type == "TEXT" ? "FILE" : type;
    entry.takes_file = entry.value == "FILE";
    if (type == "FORMAT") entry.words = {"obj", "stl", "stl-ascii", "stl-binary", "off", "ply"};
    if (type.find('|') == std::string::npos) return;
    entry.words = split(type, '|');
    std::erase_if(entry.words, [](const std::string& word) { return !is_word(word); });
}

OptionEntry entry_of(const CLI::Option& option) {
    OptionEntry entry;
    entry.help = option.get_description();
    entry.is_required = option.get_required();
    if (option.get_items_expected_max() > 0) read_type(option.get_type_name(), entry);
    if (option.get_positional()) {
        const bool is_file = entry.words.empty();
        entry.value = option.get_name(true);
        entry.takes_file = is_file;
        return entry;
    }
    for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
    return entry;
}

CommandEntry entry_of(const CLI::App& app) {
    CommandEntry entry{app.get_name(), app.get_description(), {}};
    for (const CLI::Option* option : app.get_options()) entry.options.push_back(entry_of(*option));
    return entry;
}

}  // namespace

CommandTable table_of(const CLI::App& app) {
    CommandTable table;
    table.program = entry_of(app);
    table.version = app.version();
    table.footer = app.get_footer();
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        table.commands.push_back(entry_of(*command));
    return table;
}

}  // namespace trisect::app
