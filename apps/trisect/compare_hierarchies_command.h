// SPDX-License-Identifier: Apache-2.0
//
// compare-hierarchies, which measures the structures of the comparison library.
#pragma once

#include <memory>

#include "sub_command.h"

namespace trisect::app {

[[nodiscard]] std::unique_ptr<SubCommand> compare_hierarchies_command();

}  // namespace trisect::app
