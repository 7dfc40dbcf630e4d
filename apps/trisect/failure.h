// SPDX-License-Identifier: Apache-2.0
//
// Failures as an exit code, a line of text and a document.
// The document is {"schema": "trisect.error/1", "error": {code, kind, message, file, line,
// column}}.
#pragma once

#include <trisect/kernel/error.h>

#include <exception>
#include <string>

#include "console.h"
#include "outcome.h"

namespace trisect::app {

struct Failure {
    int code = static_cast<int>(ErrorCode::Internal);
    std::string message;
    FilePlace place;          ///< an empty file name when there is none
    Json defects;             ///< of an input that is no solid; otherwise null
    bool has_offset = false;  ///< the place is a byte of a binary file
    std::string hint = {};    ///< what may help; empty: nothing to say
};

/// \pre called while an exception is being handled.
[[nodiscard]] Failure current_failure();

/// The one document, or the one line. Never throws.
void report_failure(Console& console, bool json, const Failure& failure) noexcept;

/// Text in any encoding as JSON text; what is not UTF-8 is replaced.
[[nodiscard]] std::string document_text(const Json& document);

}  // namespace trisect::app
