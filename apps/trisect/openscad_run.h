// SPDX-License-Identifier: Apache-2.0
//
// Programs of OpenSCAD's language, evaluated by an OpenSCAD that is installed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "session.h"

namespace trisect::app {

struct OpenScadRequest {
    std::string program;  ///< empty: that of TRISECT_OPENSCAD, or `openscad` on PATH
    std::string model;    ///< the .scad file
    std::vector<std::string> definitions;  ///< NAME=VALUE, VALUE in OpenSCAD's language
};

struct OpenScadForm {
    std::string text;                          ///< the evaluated form, .csg
    std::vector<std::filesystem::path> files;  ///< that it is made of, as far as OpenSCAD says
};

/// What OpenSCAD says is noted. Its files are in a temporary folder, which is gone afterwards.
/// Within Session::interruptible_stage(). \throw MissingProgram; Error (Input), with what
/// OpenSCAD says, when it ends with an error; UsageError for a definition without a name;
/// CancelledError
[[nodiscard]] OpenScadForm run_openscad(Session& session, const OpenScadRequest& request);

/// The names behind the colon of a rule for make, blanks in them behind a backslash.
[[nodiscard]] std::vector<std::filesystem::path> files_of_rule(const std::string& text);

}  // namespace trisect::app
