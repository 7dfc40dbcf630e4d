// SPDX-License-Identifier: Apache-2.0
//
// Programs of `eval`, and their files.
// They are in the evaluated form, in JSON, or in OpenSCAD's language.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/csg/csg_tree.h>

#include "options.h"
#include "session.h"

namespace trisect::app {

/// A file as it was when this was made.
class WatchedFile {
public:
    explicit WatchedFile(std::filesystem::path name);
    [[nodiscard]] bool has_changed() const { return state() != was_; }
    /// From now on it is watched as it is.
    void look_again() { was_ = state(); }
    [[nodiscard]] std::filesystem::file_time_type written() const { return was_.first; }

private:
    using State = std::pair<std::filesystem::file_time_type, std::uintmax_t>;
    [[nodiscard]] State state() const;
    std::filesystem::path name_;
    State was_;
};

/// A program that may be read again after an edit.
class ProgramSource {
public:
    /// \throw UsageError for a form that the standard input does not have, and for options of
    /// OpenSCAD with another form
    ProgramSource(Session& session, const EvalOptions& options);

    /// In stages of the session, of which there is one, or two where OpenSCAD runs. \throw as
    /// parse_csg(), parse_csg_json() and run_openscad()
    [[nodiscard]] CsgTree read();
    /// How many stages read() has.
    [[nodiscard]] int stages() const { return form_ == ProgramForm::Scad ? 2 : 1; }
    /// Where names of files start that the program has, where it is not the folder of the tree.
    [[nodiscard]] const std::optional<std::filesystem::path>& folder() const { return folder_; }
    /// Whether what the last call of read() took has changed since.
    [[nodiscard]] bool has_changed() const;

private:
    [[nodiscard]] CsgTree read_scad();

    Session& session_;
    const EvalOptions& options_;
    ProgramForm form_;
    std::optional<std::filesystem::path> folder_;
    std::vector<WatchedFile> files_;
    bool is_stale_ = false;  ///< one was written while it was read
};

/// Writes a program as JSON; names of its files start where they did.
void write_program(Session& session, const EvalOptions& options, CsgTree tree);

/// Whether the output is the program itself.
[[nodiscard]] bool has_program_name(const std::string& output);

}  // namespace trisect::app
