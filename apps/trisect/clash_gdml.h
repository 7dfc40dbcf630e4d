// SPDX-License-Identifier: Apache-2.0
//
// Clashes in a GDML geometry: volumes of one mother that overlap, or protrude from it.
#pragma once

#include "options.h"
#include "outcome.h"
#include "session.h"

namespace trisect::app {

/// \throw UsageError for options that are of other manifests
[[nodiscard]] Outcome run_gdml_clash(Session& session, const ClashOptions& options);

}  // namespace trisect::app
