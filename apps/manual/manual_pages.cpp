// SPDX-License-Identifier: Apache-2.0
#include "manual_pages.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace trisect::app {
namespace {

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Text as roff: a minus sign is no hyphen, apostrophes stay straight, and what begins a line is no
/// request. A hyphen stands between letters of a word that does not begin with a minus sign.
std::string roff(std::string_view text) {
    std::string out;
    bool is_option = false;  // within a word that begins with a minus sign
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool after_letter = i > 0 && is_letter(text[i - 1]);
        const bool before_letter = i + 1 < text.size() && is_letter(text[i + 1]);
        if (c == '-') {
            const bool is_hyphen = after_letter && before_letter && !is_option;
            is_option = !is_hyphen;
            out += is_hyphen ? "-" : "\\-";
            continue;
        }
        if (!is_letter(c)) is_option = false;
        if (c == '\\') {
            out += "\\e";
        } else if (c == '\'') {
            out += "\\(aq";
        } else if (c == '.' && i == 0) {
            out += "\\&.";
        } else {
            out += c;
        }
    }
    return out;
}

std::string minus_signs(std::string_view name) {
    std::string out;
    for (const char c : name) out += c == '-' ? std::string("\\-") : std::string(1, c);
    return out;
}

std::string bold(std::string_view name) { return "\\fB" + minus_signs(name) + "\\fR"; }
std::string italic(std::string_view value) { return "\\fI" + roff(value) + "\\fR"; }

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

std::string header(const CommandTable& table, const std::string& page) {
    return ".\\\" SPDX-License-Identifier: Apache-2.0\n.TH " + minus_signs(upper(page)) +
           " 1 \"\" \"" + table.version + "\" \"Trisect\"\n.nh\n.ad l\n";
}

std::string entry_text(const OptionEntry& option) {
    std::string tag;
    for (const std::string& name : option.names) {
        if (!tag.empty()) tag += ", ";
        tag += bold(name);
    }
    if (!option.value.empty()) tag += (tag.empty() ? "" : " ") + italic(option.value);
    std::string text = roff(option.help);
    if (!option.names.empty() && option.is_required) text += " (needed)";
    if (option.names.empty() && !option.words.empty()) {
        std::string words;
        for (const std::string& word : option.words) words += (words.empty() ? "" : ", ") + word;
        text += ": " + roff(words);
    }
    return ".TP\n" + tag + "\n" + text + "\n";
}

std::string entries(const CommandEntry& command, bool arguments) {
    std::string out;
    for (const OptionEntry& option : command.options)
        if (option.names.empty() == arguments) out += entry_text(option);
    return out;
}

std::string synopsis(const CommandEntry& command) {
    std::string out = ".B trisect " + minus_signs(command.name) + "\n";
    for (const OptionEntry& option : command.options)
        if (option.names.empty()) out += italic(option.value) + "\n";
    for (const OptionEntry& option : command.options)
        if (!option.names.empty() && option.is_required)
            out += bold(option.names.front()) + " " + italic(option.value) + "\n";
    return out + "[\\fIOPTION\\fR]...\n";
}

/// A paragraph for each sentence of the footer that begins with a heading: "Exit codes: ...".
std::string footer_text(const std::string& footer) {
    std::string out;
    bool at_begin = true;
    std::size_t begin = 0;
    while (begin < footer.size()) {
        const std::size_t end = std::min(footer.find('\n', begin), footer.size());
        const std::string_view line(footer.data() + begin, end - begin);
        const bool is_heading = line.find(':') < 16;
        if (is_heading && !at_begin) out += ".PP\n";
        out += roff(line) + "\n";
        at_begin = false;
        begin = end + 1;
    }
    return out;
}

}  // namespace

std::string program_page(const CommandTable& table) {
    std::string out = header(table, "trisect");
    out += ".SH NAME\ntrisect \\- exact booleans, queries and measures of polygon meshes\n";
    out +=
        ".SH SYNOPSIS\n.B trisect\n\\fICOMMAND\\fR\n[\\fIARGUMENT\\fR]...\n[\\fIOPTION\\fR]...\n";
    out += ".SH DESCRIPTION\n" + roff(table.program.help) +
           "\nEvery decision is exact about the coordinates of the files; what is rounded when a "
           "mesh is written is checked and reported.\n";
    out += ".SH COMMANDS\nEach has a page of its own, such as\n.BR trisect\\-union (1).\n";
    for (const CommandEntry& command : table.commands)
        out += ".TP\n" + bold(command.name) + "\n" + roff(command.help) + "\n";
    out += ".SH OPTIONS\nThey may stand before or after the command.\n";
    out += entries(table.program, false);
    out += ".SH EXIT STATUS\n" + footer_text(table.footer);
    out +=
        ".SH EXAMPLES\n.EX\n"
        "trisect difference part.stl tool.off drill.ply \\-o result.obj\n"
        "trisect info result.obj \\-\\-exact\n"
        "trisect check scan.stl\n"
        "trisect split part.stl \\-\\-plane z=12.5 \\-o below.stl above.stl\n"
        "trisect section result.obj \\-\\-plane z=12.5 \\-o slice.svg\n"
        ".EE\n.SH SEE ALSO\n";
    for (const CommandEntry& command : table.commands)
        out += ".BR trisect\\-" + minus_signs(command.name) +
               (&command == &table.commands.back() ? " (1)\n" : " (1),\n");
    return out;
}

std::string command_page(const CommandTable& table, const CommandEntry& command) {
    std::string out = header(table, "trisect-" + command.name);
    out += ".SH NAME\ntrisect\\-" + minus_signs(command.name) + " \\- " + roff(command.help) + "\n";
    out += ".SH SYNOPSIS\n" + synopsis(command);
    const std::string arguments = entries(command, true);
    if (!arguments.empty()) out += ".SH ARGUMENTS\n" + arguments;
    out += ".SH OPTIONS\nThose that all commands have are in\n.BR trisect (1).\n";
    out += entries(command, false);
    out += ".SH EXIT STATUS\n" + footer_text(table.footer);
    return out + ".SH SEE ALSO\n.BR trisect (1)\n";
}

std::string ranks_page(const CommandTable& table) {
    std::string out = header(table, "trisect-mpi");
    out += ".SH NAME\ntrisect\\-mpi \\- clashes and booleans of trisect on many processes\n";
    out +=
        ".SH SYNOPSIS\n.B mpirun\n[\\fIOPTION\\fR]... \\fBtrisect\\-mpi\\fR \\fICOMMAND\\fR\n"
        "[\\fIARGUMENT\\fR]...\n[\\fIOPTION\\fR]...\n";
    out +=
        ".SH DESCRIPTION\nThe commands take the arguments and options of those of\n.BR trisect "
        "(1)\n"
        "with the same names, and write the same bytes, on any number of processes. Each "
        "process has one thread unless \\fB\\-\\-threads\\fR says otherwise. Booleans go in "
        "slabs, which the processes share; the operands are binary STL or PLY.\n";
    out += ".SH COMMANDS\n";
    for (const std::string_view name : {"clash", "union", "intersection", "difference"}) {
        const auto at = std::ranges::find(table.commands, name, &CommandEntry::name);
        if (at == table.commands.end()) continue;
        out += ".TP\n" + bold(name) + "\n" + roff(at->help) + "; see\n.BR trisect\\-" +
               minus_signs(name) + " (1)\n";
    }
    out += ".SH EXIT STATUS\n" + footer_text(table.footer);
    out +=
        ".SH EXAMPLES\n.EX\n"
        "mpirun \\-n 8 trisect\\-mpi clash plant.json \\-o report.json\n"
        "mpirun \\-n 8 trisect\\-mpi union a.stl b.stl \\-o c.ply \\-\\-max\\-memory 2G\n"
        ".EE\n.SH SEE ALSO\n.BR trisect (1),\n.BR mpirun (1)\n";
    return out;
}

}  // namespace trisect::app
