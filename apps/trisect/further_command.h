// SPDX-License-Identifier: Apache-2.0
//
// FurtherCommand: a sub-command beside those of commands.h.
// A program has it if it is linked with it.
#pragma once

#include <CLI/CLI.hpp>

#include "outcome.h"
#include "session.h"

namespace trisect::app {

class FurtherCommand {
public:
    FurtherCommand() = default;
    FurtherCommand(const FurtherCommand&) = delete;
    FurtherCommand& operator=(const FurtherCommand&) = delete;
    virtual ~FurtherCommand() = default;

    /// Adds the sub-command with its options, and returns it.
    virtual CLI::App& declare(CLI::App& app) = 0;
    [[nodiscard]] virtual Outcome run(Session& session) const = 0;
};

}  // namespace trisect::app
