// SPDX-License-Identifier: Apache-2.0
//
// compare-hierarchies, which measures the structures of the comparison library.
#pragma once

#include <memory>

namespace trisect::app {

class FurtherCommand;

[[nodiscard]] std::unique_ptr<FurtherCommand> compare_hierarchies_command();

}  // namespace trisect::app
