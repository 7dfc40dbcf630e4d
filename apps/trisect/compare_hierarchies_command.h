// SPDX-License-Identifier: Apache-2.0
//
// compare-hierarchies, which measures the structures of the comparison library.
#pragma once

#include "command_table.h"

namespace trisect::app {

/// run() of command_line.h, with this sub-command too.
[[nodiscard]] int run_with_comparison(int argc, char** argv);
[[nodiscard]] CommandTable table_with_comparison();

}  // namespace trisect::app
