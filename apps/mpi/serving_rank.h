// SPDX-License-Identifier: Apache-2.0
//
// Ranks other than the coordinating one.
#pragma once

#include "rank_clash_command.h"
#include "trisect/session.h"

namespace trisect::app {

/// Does tasks until there are none. \throw CancelledError
void serve(Session& session, const RankClashOptions& options);

/// The journal of a rank, beside the first output.
[[nodiscard]] std::string rank_journal(const RankClashOptions& options, int rank);

/// How many tasks a rank has at a time: one that it does, and the next.
inline constexpr int tasks_ahead = 2;

}  // namespace trisect::app
