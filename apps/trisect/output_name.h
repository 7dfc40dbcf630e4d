// SPDX-License-Identifier: Apache-2.0
//
// The names of outputs that have one format only.
#pragma once

#include <string>
#include <string_view>

#include "session.h"

namespace trisect::app {

/// The name must be empty (no output), "-" (the standard output, unless --json wants it) or have
/// the extension, such as ".png", or none; checked before the work begins. \throw UsageError
void check_output_name(const Session& session, const std::string& name, std::string_view extension);

}  // namespace trisect::app
