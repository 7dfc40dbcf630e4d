// SPDX-License-Identifier: Apache-2.0
#include "eval_program.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/bsp/csg/json/csg_json.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <cctype>
#include <system_error>

#include "openscad_run.h"

namespace trisect::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_program_bytes = std::uint64_t{1} << 28;

std::string extension_of(const std::string& name) {
    std::string out = fs::path(name).extension().string();
    std::ranges::transform(out, out.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

ProgramForm form_of(const EvalOptions& options) {
    if (options.form != ProgramForm::ByName) return options.form;
    const std::string extension = extension_of(options.input);
    if (extension == ".json") return ProgramForm::JsonText;
    return extension == ".scad" ? ProgramForm::Scad : ProgramForm::CsgText;
}

}  // namespace

WatchedFile::WatchedFile(fs::path name) : name_(std::move(name)), was_(state()) {}

WatchedFile::State WatchedFile::state() const {
    std::error_code none;
    return {fs::last_write_time(name_, none), fs::file_size(name_, none)};
}

ProgramSource::ProgramSource(Session& session, const EvalOptions& options)
    : session_(session), options_(options), form_(form_of(options)) {
    if (form_ == ProgramForm::Scad && options.input == "-")
        throw UsageError("OpenSCAD evaluates .scad files, not the standard input");
    if (form_ != ProgramForm::Scad && (!options.definitions.empty() || !options.openscad.empty()))
        throw UsageError("-D and --openscad are for .scad files, which OpenSCAD evaluates");
    if (form_ == ProgramForm::Scad) folder_ = fs::path(options.input).parent_path();
}

CsgTree ProgramSource::read() {
    if (form_ == ProgramForm::Scad) return read_scad();
    return session_.stage("read", [&] {
        const bool is_stream = options_.input == "-";
        if (!is_stream) files_.assign(1, WatchedFile(options_.input));
        const FileBytes bytes = is_stream ? read_descriptor(0, "standard input", most_program_bytes)
                                          : read_file(options_.input, most_program_bytes);
        const std::string name = is_stream ? "standard input" : options_.input;
        return form_ == ProgramForm::JsonText ? parse_csg_json(bytes.view(), name)
                                              : parse_csg(bytes.view(), name);
    });
}

CsgTree ProgramSource::read_scad() {
    const OpenScadForm made = session_.interruptible_stage("openscad", [&] {
        // What is wrong with a program may be in any of its files: those of before are watched.
        for (WatchedFile& file : files_) file.look_again();
        if (files_.empty()) files_.emplace_back(options_.input);
        is_stale_ = false;
        const fs::file_time_type start = fs::file_time_type::clock::now();
        OpenScadForm form =
            run_openscad(session_, {options_.openscad, options_.input, options_.definitions});
        const fs::file_time_type end = fs::file_time_type::clock::now();
        files_.clear();
        files_.emplace_back(options_.input);
        for (const fs::path& file : form.files) files_.emplace_back(file);
        for (const WatchedFile& file : files_)
            is_stale_ = is_stale_ || (file.written() >= start && file.written() <= end);
        return form;
    });
    return session_.stage("read", [&] {
        return parse_csg(made.text, options_.input + " (as OpenSCAD evaluates it)");
    });
}

bool ProgramSource::has_changed() const {
    return is_stale_ ||
           std::ranges::any_of(files_, [](const WatchedFile& f) { return f.has_changed(); });
}

bool has_program_name(const std::string& output) { return extension_of(output) == ".json"; }

void write_program(Session& session, const EvalOptions& options, CsgTree tree) {
    const fs::path folder = fs::absolute(options.output).parent_path();
    tree.file = fs::absolute(tree.file).lexically_relative(folder).string();
    session.write_output(options.output, csg_json_text(tree));
}

}  // namespace trisect::app
