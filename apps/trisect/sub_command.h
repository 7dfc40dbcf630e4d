// SPDX-License-Identifier: Apache-2.0
//
// SubCommand: one sub-command of trisect, or several that have their options in common.
// A program has those that it is given (command_line.h).
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace trisect::app {

class Session;
struct Outcome;

class SubCommand {
public:
    SubCommand() = default;
    SubCommand(const SubCommand&) = delete;
    SubCommand& operator=(const SubCommand&) = delete;
    virtual ~SubCommand() = default;

    /// Adds itself, with its options, to a command line.
    virtual void declare(CLI::App& app) = 0;
    /// \param name which one the user named
    [[nodiscard]] virtual Outcome run(Session& session, const std::string& name) const = 0;
};

using SubCommands = std::vector<std::unique_ptr<SubCommand>>;

/// What `trisect` has, but for compare-hierarchies, which is in a library of its own.
[[nodiscard]] SubCommands all_commands();
/// What scripts/demo builds: union, intersection, difference, xor, resolve, info, convert and
/// render.
[[nodiscard]] SubCommands few_commands();

}  // namespace trisect::app
