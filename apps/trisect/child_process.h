// SPDX-License-Identifier: Apache-2.0
//
// Other programs that a command runs.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "session.h"

namespace trisect::app {

/// The exit code of a command that takes another program which is not there.
inline constexpr int exit_missing_program = 8;

class MissingProgram : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

struct ChildOutcome {
    int code = -1;     ///< exit code; -1 when a signal ended it
    std::string said;  ///< on both its streams, the first million bytes
};

/// Runs a program, found on PATH unless its name has a slash, without a shell, and waits for it.
/// Its standard input is empty. Within Session::interruptible_stage() it is killed, with all that
/// it started, when the command is to stop; \throw CancelledError then. MissingProgram when there
/// is no such program, Error (Input) when it cannot be run.
[[nodiscard]] ChildOutcome run_child(Session& session, const std::vector<std::string>& words);

}  // namespace trisect::app
