// SPDX-License-Identifier: Apache-2.0
//
// Names of outputs: formats, and tests for equal files.
// Some outputs have one format only, and several must not be one file.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "session.h"

namespace trisect::app {

/// The name must be empty (no output), "-" (the standard output, unless --json wants it) or have
/// the extension, such as ".png", or none; checked before the work begins. \throw UsageError
void check_output_name(const Session& session, const std::string& name, std::string_view extension);

/// What a command does with the standard output where no output is written to it; with --json there
/// is a document in any case.
enum class Answer : std::uint8_t { None, Printed };

/// No two outputs, the standard output among them if it is used, may be the same file: the last one
/// would be all that is left. By whatever names, also through links; whether the files are there or
/// not. Empty names are none. An output may be an input, which is read before. \throw UsageError
void check_outputs(const Session& session, std::initializer_list<std::string> names,
                   Answer answer = Answer::None);

}  // namespace trisect::app
