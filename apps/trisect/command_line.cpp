// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <trisect/kernel/stop_scope.h>

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

#include "choice.h"
#include "failure.h"
#include "limits.h"
#include "outcome.h"
#include "session.h"
#include "values.h"

namespace trisect::app {
namespace {

/// Which sub-command has a name that the user may type.
using NamedCommands = std::map<std::string, const SubCommand*>;

constexpr const char* what_it_is =
    "Exact solid modelling: booleans, measures and checks of polygon meshes.";
constexpr const char* exit_code_help =
    "Exit codes: 0 done, yes, none found; 1 done, no, something found; 2 usage; 3 unreadable or\n"
    "malformed input; 4 not a valid solid; 5 a limit was hit; 6 cancelled; 7 unsupported;\n"
    "8 a program that it takes is not there; 70 internal error.\n"
    "Formats: obj, stl, off, ply, 3mf, glb, amf, step, dxf (in). '-': standard input or output.";

MeshFormat format_named(const std::string& name) {
    const auto format = mesh_format_from_name(name);
    if (format) return *format;
    throw UsageError(
        "--format: '" + name +
        "' is none of obj, stl, stl-ascii, stl-binary, off, ply, 3mf, glb, amf, step, dxf");
}

int lattice_exponent(const std::string& text) {
    const std::int64_t e = parse_integer(text, "--lattice");
    if (e % 8 != 0 || e < -1200 || e > 1016) {
        throw UsageError("--lattice: the exponent must be a multiple of 8 from -1200 to 1016");
    }
    return static_cast<int>(e);
}

double positive_number(const std::string& text, const char* what) {
    const double value = parse_number(text, what);
    if (!(value > 0)) throw UsageError(std::string(what) + ": must be positive");
    return value;
}

int thread_count(const std::string& text) {
    const std::int64_t n = parse_integer(text, "--threads");
    if (n < 1 || n > 4096) throw UsageError("--threads: must be from 1 to 4096");
    return static_cast<int>(n);
}

std::uint64_t work_budget(const std::string& text) {
    const std::int64_t n = parse_integer(text, "--max-work");
    if (n < 1) throw UsageError("--max-work: must be positive");
    return static_cast<std::uint64_t>(n);
}

using TextOption = std::function<void(const std::string&)>;

void add_text_option(CLI::App& app, const char* name, const TextOption& set, const char* help,
                     const char* type) {
    app.add_option_function<std::string>(name, set, help)->type_name(type);
}

void add_limit_options(CLI::App& app, CommonOptions& o) {
    add_text_option(
        app, "--threads", [&o](const auto& s) { o.threads = thread_count(s); },
        "use at most so many threads; the result does not depend on it", "N");
    add_text_option(
        app, "--max-memory", [&o](const auto& s) { o.max_memory = parse_bytes(s, "--max-memory"); },
        "stop with exit code 5 instead of using more", "BYTES[KMGT]");
    add_text_option(
        app, "--max-seconds",
        [&o](const auto& s) { o.max_seconds = positive_number(s, "--max-seconds"); },
        "stop with exit code 5 when not finished by then", "S");
    add_text_option(
        app, "--max-work", [&o](const auto& s) { o.max_work = work_budget(s); },
        "stop with exit code 5 after so many steps (facets, edges, cells and pairs of polygons "
        "that "
        "are looked at); the same on every machine",
        "N");
}

void add_import_options(CLI::App& app, CommonOptions& o) {
    add_text_option(
        app, "--lattice", [&o](const auto& s) { o.lattice = lattice_exponent(s); },
        "unit 2^E of the lattice of every input (default: without loss if possible)", "E");
    add_choice_option<NonplanarPolicy>(app, "--nonplanar", o.nonplanar,
                                       {{"triangulate", NonplanarPolicy::Triangulate},
                                        {"refuse", NonplanarPolicy::Refuse},
                                        {"refit", NonplanarPolicy::Refit}},
                                       "faces whose corners are not in one plane");
    add_text_option(
        app, "--refit-move",
        [&o](const auto& s) { o.refit_move = positive_number(s, "--refit-move"); },
        "how far refit may move a coordinate", "D");
    add_text_option(
        app, "--format", [&o](const auto& s) { o.format = format_named(s); },
        "format of the output, and of the standard input", "FORMAT");
    add_text_option(
        app, "--input-format", [&o](const auto& s) { o.input_format = format_named(s); },
        "format of the inputs, whatever their names", "FORMAT");
}

void add_common_options(CLI::App& app, CommonOptions& o) {
    app.add_flag("--json", o.json, "print exactly one JSON document on the standard output");
    app.add_flag("-q,--quiet", o.quiet, "no remarks");
    app.add_flag("-v,--verbose", o.verbose, "more remarks");
    add_choice_option<Progress>(
        app, "--progress", o.progress,
        {{"auto", Progress::Auto}, {"bar", Progress::Bar}, {"none", Progress::None}},
        "a bar, on a terminal and after half a second");
    add_import_options(app, o);
    add_limit_options(app, o);
}

/// The value of an option is no option: `--boundary --json` lacks the name of a file.
std::string refuse_option(const std::string& value) {
    if (!value.starts_with("--") || value.size() == 2) return {};
    return fmt::format("'{}' stands where a value is needed", value);
}

void refuse_options_as_values(CLI::App& app) {
    for (CLI::Option* option : app.get_options())
        if (!option->get_positional() && option->get_items_expected_max() > 0)
            option->check(refuse_option, "");
}

/// Adds a sub-command, and what names it has.
void declare(CLI::App& app, SubCommand& command, NamedCommands& named) {
    const std::size_t before = app.get_subcommands({}).size();
    command.declare(app);
    const std::vector<CLI::App*> all = app.get_subcommands({});
    for (std::size_t i = before; i < all.size(); ++i) named[all[i]->get_name()] = &command;
}

NamedCommands declare(CLI::App& app, CommonOptions& common, const SubCommands& commands) {
    app.set_version_flag("--version", "trisect " TRISECT_VERSION);
    app.require_subcommand(1);
    app.footer(exit_code_help);
    app.fallthrough();  // common options may stand after the sub-command too
    add_common_options(app, common);
    NamedCommands named;
    for (const auto& command : commands) declare(app, *command, named);
    for (CLI::App* command : app.get_subcommands({})) {
        command->footer("Common options: trisect --help");
        refuse_options_as_values(*command);
    }
    refuse_options_as_values(app);
    return named;
}

/// The arguments, in the reverse order that CLI11 wants. A value that begins with a minus sign
/// ("--translate -.5,0,0") is tied to its option, or it would be taken for an option itself.
std::vector<std::string> prepared_arguments(int argc, char** argv) {
    static constexpr std::string_view numeric[] = {
        "--translate", "--rotate", "--scale", "--lattice", "--plane",   "--section", "--view",
        "--point",     "--grid",   "--from",  "--to",      "--heights", "--step"};
    std::vector<std::string> arguments;
    for (int i = 1; i < argc; ++i) {
        std::string argument = argv[i];
        const bool joins =
            std::find(std::begin(numeric), std::end(numeric), argument) != std::end(numeric) &&
            i + 1 < argc && argv[i + 1][0] == '-';
        if (joins) argument += std::string("=") + argv[++i];
        arguments.push_back(std::move(argument));
    }
    std::reverse(arguments.begin(), arguments.end());
    return arguments;
}

/// Known before anything is parsed, since mistakes in the arguments are reported in JSON too.
bool asks_for_json(int argc, char** argv) {
    for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
        if (std::string_view(argv[i]) == "--json") return true;
    }
    return false;
}

int print_text(Console& console, bool json, const char* schema, const std::string& text) {
    Json document;
    document["schema"] = schema;
    document["text"] = text;
    console.print(json ? document_text(document) : text);
    return exit_done;
}

/// The other thread has claimed the end and is about to leave.
[[noreturn]] void wait_for_end() {
    for (;;) ::pause();
}

[[noreturn]] void leave(Console& console, bool json, int code, const std::string& message) {
    report_failure(console, json, {code, message, {}, {}});
    ::_exit(code);
}

/// An evaluation that was asked to stop fails for the reason for which it was asked.
Failure failure_of(Supervisor& supervisor) {
    Failure failure = current_failure();
    if (failure.code != static_cast<int>(ErrorCode::Cancelled)) return failure;
    return supervisor.reason_to_stop().value_or(std::move(failure));
}

/// Runs the sub-command under the limits; in the end whoever claims it first speaks.
int run_command(Console& console, const CommonOptions& common, const SubCommand& command,
                const std::string& name) {
    const bool json = common.json;
    console.set_quiet(common.quiet);
    Supervisor supervisor(console, common, leave);
    Outcome outcome;
    try {
        const Limits limits(common);
        Session session(common, console, supervisor);
        const StopScope scope(session.limits());
        outcome = command.run(session, name);
    } catch (...) {
        const Failure failure = failure_of(supervisor);
        if (!console.claim_end()) wait_for_end();
        report_failure(console, json, failure);
        return failure.code;
    }
    if (!console.claim_end()) wait_for_end();
    console.print(json ? document_text(outcome.document) : outcome.answer);
    console.note(outcome.remarks);
    return outcome.code;
}

/// Parses, answers --help and --version, or runs.
int parse_and_run(Console& console, bool json, int argc, char** argv, const SubCommands& commands) {
    CLI::App app(what_it_is, "trisect");
    CommonOptions common;
    const NamedCommands named = declare(app, common, commands);
    try {
        app.parse(prepared_arguments(argc, argv));
    } catch (const CLI::CallForHelp&) {
        return print_text(console, json, "trisect.help/1", app.help());
    } catch (const CLI::CallForVersion&) {
        return print_text(console, json, "trisect.version/1", app.version() + "\n");
    } catch (const CLI::ParseError& e) {
        throw UsageError(std::string(e.what()) + " (see trisect --help)");
    }
    const std::string name = app.get_subcommands().front()->get_name();
    return run_command(console, common, *named.at(name), name);
}

}  // namespace

int run(int argc, char** argv, const SubCommands& commands) {
    std::signal(SIGPIPE, SIG_IGN);
    Console console;
    const bool json = asks_for_json(argc, argv);
    install_terminate_handler(console, json);
    try {
        return parse_and_run(console, json, argc, argv, commands);
    } catch (...) {
        const Failure failure = current_failure();
        report_failure(console, json, failure);
        return failure.code;
    }
}

CommandTable command_table(const SubCommands& commands) {
    CLI::App app(what_it_is, "trisect");
    CommonOptions common;
    declare(app, common, commands);
    return table_of(app);
}

}  // namespace trisect::app
