// SPDX-License-Identifier: Apache-2.0
//
// Checkpoints of a run, and tables of its steps.
#pragma once

#include <string>
#include <vector>

#include "mill_job.h"
#include "mill_run.h"
#include "outcome.h"

namespace trisect::app {

/// What a run had done. The stock is not in it: the cuts are made again, without measures and
/// checks, which gives the same solid, face by face and name by name, in a part of the time.
struct MillCheckpoint {
    std::vector<MillRecord> records;
    Json collisions = Json::array();
};

/// JSON, trisect.mill-checkpoint/1: the inputs' hash, an array of numbers a step, collisions.
[[nodiscard]] std::string checkpoint_text(const MillJob& job, const MillRun& run);
/// \throw InputError for what is no checkpoint, or one of other inputs or options
[[nodiscard]] MillCheckpoint read_checkpoint(const std::string& file, const MillJob& job);

/// CSV with a line a step: number, line, kind, position, time, removed volume, milliseconds,
/// collision.
[[nodiscard]] std::string step_table(const MillJob& job, const MillRun& run);

}  // namespace trisect::app
