// SPDX-License-Identifier: Apache-2.0
//
// RankWorker: the work of one rank.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model_cache.h"
#include "rank_task.h"
#include "trisect/clash_answer.h"
#include "trisect/clash_journal.h"
#include "trisect/options.h"
#include "trisect/session.h"

namespace trisect::app {

/// Knows nothing of other ranks. What is finished is in the journal before it is handed back.
class RankWorker {
public:
    /// Pairs of a slice, fewer where each may be a boolean, and more where a tile would have more
    /// slices than that. Journals do not depend on ranks, so these are fixed.
    static constexpr std::size_t slice_pairs = 32;
    static constexpr std::size_t slice_volumes = 4;
    static constexpr std::size_t most_slices = 256;

    RankWorker(Session& session, const ClashOptions& options, std::uint64_t most_bytes,
               const RankStart& start, const std::string& journal, const FinishedPieces& kept);

    /// What fails is a result, too. \throw CancelledError
    [[nodiscard]] RankResult done(const RankTask& task);
    /// What the rank needed.
    [[nodiscard]] RankResult ended() const;
    void remove_journal() { journal_.remove(); }

private:
    void read_file(const RankTask& task, RankResult& result);
    void answer_slice(const RankTask& task, RankResult& result);
    void find_candidates(const RankTask& task);
    void add_parts(const RankTask& task, const ClashCandidate& pair, RankResult& result) const;
    [[nodiscard]] std::vector<Json> answers(const RankTask& task, const ClashCandidate& pair);
    [[nodiscard]] PlacedPart placed(const RankTask& task, std::uint32_t part);

    Session& session_;
    const ClashOptions& options_;
    RankStart start_;
    ClashLimits limits_;
    ModelCache models_;
    std::optional<std::uint64_t> tile_;  // of which the pairs are
    std::vector<ClashCandidate> pairs_;
    ClashJournal journal_;
};

}  // namespace trisect::app
