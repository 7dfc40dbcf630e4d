// SPDX-License-Identifier: Apache-2.0
//
// Outcome: the report of a finished sub-command, for programs and people.
// The exit codes are here, too.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace trisect::app {

using Json = nlohmann::ordered_json;

/// Codes of a finished command; those of failures are the values of ErrorCode.
inline constexpr int exit_done = 0;      ///< done, the answer is yes, nothing was found
inline constexpr int exit_findings = 1;  ///< done, the answer is no, something was found

struct Outcome {
    int code = exit_done;
    Json document;        ///< printed with --json; starts with "schema"
    std::string answer;   ///< otherwise this, to the standard output
    std::string remarks;  ///< and this to the standard error, unless --quiet
};

}  // namespace trisect::app
