// SPDX-License-Identifier: Apache-2.0
//
// Common parts of all programs that find clashes.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "clash_manifest.h"
#include "options.h"
#include "outcome.h"

namespace trisect {
class Error;
}

namespace trisect::app {

/// The sub-command `clash` with the options that do not depend on how the work is shared.
CLI::App& add_clash_options(CLI::App& app, ClashOptions& options);

/// Whether the run goes on without what failed.
[[nodiscard]] bool is_left_out(const Error& e, const ClashOptions& options);

/// All that answers depend on: of the manifest, of files, and of options.
[[nodiscard]] Json clash_run_json(const ClashManifest& manifest, const ClashOptions& options);
/// The same and the shard, as the key of a journal.
[[nodiscard]] std::string clash_run_key(const ClashManifest& manifest, const ClashOptions& options);

}  // namespace trisect::app
