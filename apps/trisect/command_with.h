// SPDX-License-Identifier: Apache-2.0
//
// Sub-commands made of the two functions that each has (commands.h).
#pragma once

#include <memory>
#include <string>

#include "commands.h"
#include "sub_command.h"

namespace trisect::app {

template <class Options>
class CommandWith final : public SubCommand {
public:
    using Add = void (*)(CLI::App&, Options&);
    using Run = Outcome (*)(Session&, const Options&);

    CommandWith(Add add, Run work) : add_(add), run_(work) {}
    void declare(CLI::App& app) override { add_(app, options_); }
    [[nodiscard]] Outcome run(Session& session, const std::string&) const override {
        return run_(session, options_);
    }

private:
    Add add_;
    Run run_;
    Options options_{};
};

template <class Options>
[[nodiscard]] std::unique_ptr<SubCommand> command_with(void (*add)(CLI::App&, Options&),
                                                       Outcome (*run)(Session&, const Options&)) {
    return std::make_unique<CommandWith<Options>>(add, run);
}

/// union, intersection, difference, xor and resolve: they differ in the name alone.
class BooleanCommands final : public SubCommand {
public:
    void declare(CLI::App& app) override { add_boolean_commands(app, options_); }
    [[nodiscard]] Outcome run(Session& session, const std::string& name) const override {
        BooleanOptions options = options_;
        options.operation = name;
        return run_boolean(session, options);
    }

private:
    BooleanOptions options_;
};

}  // namespace trisect::app
