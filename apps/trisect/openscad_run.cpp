// SPDX-License-Identifier: Apache-2.0
#include "openscad_run.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>

#include <unistd.h>

#include "child_process.h"

namespace trisect::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_form_bytes = std::uint64_t{1} << 28;
constexpr std::size_t most_errors = 5;  // lines of a message

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "trisect-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw Error(ErrorCode::Input, name + ": no temporary folder: " + std::strerror(errno));
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() { remove(); }
    void remove() const {
        std::error_code none;
        fs::remove_all(path_, none);
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

std::string program_of(const OpenScadRequest& request) {
    if (!request.program.empty()) return request.program;
    const char* const given = std::getenv("TRISECT_OPENSCAD");
    return given != nullptr && *given != '\0' ? given : "openscad";
}

void check_definition(const std::string& text) {
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
    };
    const auto is_name = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); };
    const std::size_t end = text.find('=');
    const std::string_view name = std::string_view(text).substr(0, end);
    if (end == std::string::npos || name.empty() || !is_letter(name[0]) ||
        !std::ranges::all_of(name.substr(1), is_name))
        throw UsageError("-D: '" + text + "' is no NAME=VALUE");
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        if (end > 0) out.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return out;
}

/// The lines that say why, or all of them.
std::string errors_in(const std::vector<std::string>& lines) {
    std::vector<std::string> out;
    for (const std::string& line : lines)
        if (line.starts_with("ERROR") || line.starts_with("Can't")) out.push_back(line);
    if (out.empty()) out = lines;
    out.resize(std::min(out.size(), most_errors));
    return fmt::format("{}", fmt::join(out, "; "));
}

ChildOutcome run_or_say(Session& session, const std::vector<std::string>& words) {
    try {
        return run_child(session, words);
    } catch (const MissingProgram& e) {
        throw MissingProgram(std::string(e.what()) +
                             "; .scad files take an installed OpenSCAD (--openscad PATH, or "
                             "TRISECT_OPENSCAD), .csg files do not");
    }
}

}  // namespace

std::vector<fs::path> files_of_rule(const std::string& text) {
    std::vector<fs::path> out;
    std::size_t i = std::min(text.find(": "), text.size());
    std::string name;
    for (i = std::min(i + 2, text.size()); i <= text.size(); ++i) {
        const char c = i < text.size() ? text[i] : '\n';
        if (c == '\\' && i + 1 < text.size() && text[i + 1] != '\n') {
            name += text[++i];
        } else if (c == ' ' || c == '\t' || c == '\n' || c == '\\') {
            if (!name.empty()) out.emplace_back(name);
            name.clear();
        } else {
            name += c;
        }
    }
    return out;
}

OpenScadForm run_openscad(Session& session, const OpenScadRequest& request) {
    for (const std::string& definition : request.definitions) check_definition(definition);
    const TemporaryFolder folder;
    const EndGuard guard(session.supervisor(), [&folder] { folder.remove(); });
    const std::string form = (folder.path() / "form.csg").string();
    const std::string rule = (folder.path() / "files").string();
    std::vector<std::string> words{program_of(request), "-o", form, "-d", rule};
    for (const std::string& definition : request.definitions) {
        words.emplace_back("-D");
        words.push_back(definition);
    }
    // A name is no option.
    words.push_back(request.model.starts_with("-") ? "./" + request.model : request.model);
    const ChildOutcome child = run_or_say(session, words);
    const std::vector<std::string> lines = lines_of(child.said);
    for (const std::string& line : lines) session.note("openscad: " + line);
    std::error_code none;
    if (child.code != 0 || !fs::exists(form, none)) {
        const std::string how = child.code < 0 ? "was ended by a signal"
                                               : fmt::format("ended with code {}", child.code);
        throw Error(ErrorCode::Input,
                    fmt::format("{}: {} {}: {}", request.model, words[0], how, errors_in(lines)));
    }
    OpenScadForm out;
    out.text = read_file(form, most_form_bytes).view();
    if (fs::exists(rule, none))
        out.files = files_of_rule(std::string(read_file(rule, most_form_bytes).view()));
    return out;
}

}  // namespace trisect::app
