// SPDX-License-Identifier: Apache-2.0
//
// RankWorker: the work of one rank.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
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
    static constexpr std::size_t slice_volumes = 2;
    static constexpr std::size_t most_slices = 256;
    [[nodiscard]] static std::size_t pairs_of_slice(const ClashOptions& options) {
        return options.volumes ? slice_volumes : slice_pairs;
    }

    RankWorker(Session& session, const ClashOptions& options, std::uint64_t most_bytes,
               const RankStart& start, const std::string& journal, const FinishedPieces& kept);

    /// An order takes no longer than this, but for its first piece: what is left then is handed
    /// back, so that nobody waits for it.
    static constexpr std::chrono::milliseconds most_time{20};

    /// What fails is a result, too. \throw CancelledError
    [[nodiscard]] RankAnswer done(const RankTask& task);
    /// What the rank needed.
    [[nodiscard]] RankEnd ended() const;
    void remove_journal() { journal_.remove(); }

private:
    [[nodiscard]] RankResult done(const RankTask& task, std::size_t at);
    void read_file(std::uint64_t file, RankResult& result);
    void answer_slice(const RankTask& task, std::size_t at, RankResult& result);
    void take_tile(const RankTask& task, std::size_t at);
    void find_candidates(const RankTask& task, const RankPiece& piece);
    void add_entry(const RankResult& result, Json&& found);
    void add_parts(const RankTask& task, const ClashCandidate& pair, RankResult& result) const;
    [[nodiscard]] std::vector<Json> answers(const RankTask& task, const ClashCandidate& pair);
    [[nodiscard]] PlacedPart placed(const RankTask& task, std::uint32_t box);

    Session& session_;
    const ClashOptions& options_;
    RankStart start_;
    ClashLimits limits_;
    ModelCache models_;
    const PartStore* store_ = nullptr;   // of which that is; null: another rank's
    std::optional<std::uint64_t> tile_;  // of which the pairs are
    using TilePlace = std::pair<std::uint32_t, std::uint32_t>;  // a region, and a tile in it
    std::optional<TilePlace> place_;                            // of which these are:
    ClashSweep sweep_;
    TileParts parts_;  // of an own one its numbers, of another's those of a task
    bool are_parts_of_task_ = false;
    std::vector<ClashCandidate> pairs_;
    std::string entries_;  // for the journal
    ClashJournal journal_;
};

}  // namespace trisect::app
