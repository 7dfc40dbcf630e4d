// SPDX-License-Identifier: Apache-2.0
//
// Command line of trisect, from arguments to an exit code.
#pragma once

namespace trisect::app {

/// Parses the arguments, runs the sub-command, prints what it has to say and returns the exit code.
[[nodiscard]] int run(int argc, char** argv);

}  // namespace trisect::app
