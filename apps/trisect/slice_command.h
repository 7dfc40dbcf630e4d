// SPDX-License-Identifier: Apache-2.0
//
// The sub-command slice.
#pragma once

#include <trisect/bsp/modelling/slices.h>

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

#include "layer_heights.h"
#include "layer_stack.h"
#include "options.h"
#include "outcome.h"
#include "session.h"

namespace trisect::app {

struct SliceCommandOptions {
    QueryOptions set;
    HeightRequest heights;
    int axis = 2;
    SliceRule rule = SliceRule::Closed;
    std::string output;                 ///< empty: none
    std::optional<LayerFormat> format;  ///< nothing: by the name of the output
};

void add_slice_command(CLI::App& app, SliceCommandOptions& options);
[[nodiscard]] Outcome run_slice(Session& session, const SliceCommandOptions& options);

}  // namespace trisect::app
