// SPDX-License-Identifier: Apache-2.0
//
// Booleans of operands larger than memory, as a command.
#pragma once

#include "options.h"
#include "outcome.h"
#include "pieces/slab_run.h"
#include "session.h"

namespace CLI {
class App;
}

namespace trisect::app {

/// --slabs, --pieces and --resume.
void add_slab_options(CLI::App& command, BooleanOptions& options);

/// Whether the options ask for slabs, or the files are too large for --max-memory without.
[[nodiscard]] bool wants_slabs(const Session& session, const BooleanOptions& options);

/// \throw UsageError for what is not done in slabs
[[nodiscard]] SlabOptions slab_options(const Session& session, const BooleanOptions& options);

/// In this process alone.
[[nodiscard]] Outcome run_in_slabs(Session& session, const BooleanOptions& options);

[[nodiscard]] Outcome slab_outcome(const Session& session, const BooleanOptions& options,
                                   const SlabPlan& plan, const JoinedMesh& joined);

}  // namespace trisect::app
