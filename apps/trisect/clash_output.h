// SPDX-License-Identifier: Apache-2.0
//
// Files of reports, in all formats.
#pragma once

#include <string>
#include <vector>

#include "clash_report.h"
#include "options.h"
#include "session.h"

namespace trisect::app {

/// Before the work begins: names and formats of all outputs. \throw UsageError
void check_clash_outputs(const Session& session, const ClashOptions& options);

/// Writes each output by its ending, and pictures where the options want them.
void write_clash_outputs(Session& session, const ClashOptions& options,
                         const ClashManifest& manifest, const ClashReport& report,
                         const ClashPicture& picture);

/// Code, document and text of a command that made a report; the document lacks what counts work.
[[nodiscard]] Outcome clash_outcome(const ClashManifest& manifest, const ClashReport& report);

}  // namespace trisect::app
