// SPDX-License-Identifier: Apache-2.0
//
// compare-hierarchies, which measures and so stands apart from the commands of commands.h.
#pragma once

#include <CLI/CLI.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "options.h"
#include "outcome.h"
#include "session.h"

namespace trisect::app {

struct CompareHierarchiesOptions {
    std::array<std::string, 2> inputs;
    std::string motion;  ///< a file: how the second one moves
    std::int64_t frames = 100;
    std::vector<std::string> structures;  ///< by name; empty: all
    std::string chart;                    ///< empty: none
    OperandOptions operands;
};

void add_compare_hierarchies_command(CLI::App& app, CompareHierarchiesOptions& options);
[[nodiscard]] Outcome run_compare_hierarchies(Session& session,
                                              const CompareHierarchiesOptions& options);

}  // namespace trisect::app
