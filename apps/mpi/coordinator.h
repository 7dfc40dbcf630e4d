// SPDX-License-Identifier: Apache-2.0
//
// Coordinator: hands out the work of all ranks, and collects what they find.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "rank_task.h"
#include "trisect/clash_journal.h"
#include "trisect/clash_report.h"
#include "trisect/clash_tiles.h"
#include "trisect/failure.h"
#include "trisect/options.h"
#include "trisect/session.h"

namespace trisect::app {

struct PieceCost {
    std::uint64_t piece = 0;
    std::size_t parts = 0;
    std::uint64_t pairs = 0;
    std::uint64_t work = 0;
    double seconds = 0;
};

/// First the files, whose boxes make those of the parts; then the tiles. A tile is one task, and
/// the rank that has it says how many slices its pairs are: those after the first are tasks of
/// their own, for whoever comes next. So no tile is too much for one rank.
///
/// What is handed out depends on the manifest alone, and where a piece is done does not matter.
/// Knows nothing of messages.
class Coordinator {
public:
    /// \param done pieces of earlier runs, which are not done again
    Coordinator(Session& session, const ClashOptions& options, const ClashManifest& manifest,
                const FinishedPieces& done);

    /// False: nothing at present, or nothing any more.
    [[nodiscard]] bool next(RankTask& task);
    void accept(RankResult&& result);
    /// All is done, or something failed that ends the run.
    [[nodiscard]] bool is_over() const { return failure_ || tiles_left_ == 0; }
    [[nodiscard]] const std::optional<Failure>& failure() const { return failure_; }

    /// Of what was done until now, and what was not; once.
    [[nodiscard]] ClashReport take_report();
    [[nodiscard]] std::size_t tiles() const { return tiles_ ? tiles_->size() : 0; }
    [[nodiscard]] std::size_t tiles_left() const { return tiles_left_; }
    [[nodiscard]] std::size_t listed() const { return tiles_ ? tiles_->listed() : 0; }
    /// What each slice of this run cost, as CSV.
    [[nodiscard]] std::string costs_table() const;
    [[nodiscard]] const std::vector<PieceCost>& costs() const { return costs_; }
    /// Where a file is missing, its box is none.
    [[nodiscard]] const std::vector<ClashFile>& files() const { return files_; }

private:
    struct TileState {
        std::uint32_t slices = 0;  // 0: not known yet
        std::uint32_t done = 0;
    };

    void take_over(const FinishedPieces& done);
    void begin_tiles();
    void add_slice(std::uint64_t piece, std::uint32_t slices, Json&& found);
    [[nodiscard]] RankTask tile_task(std::uint64_t piece) const;
    [[nodiscard]] bool is_finished(const TileState& tile) const {
        return tile.slices != 0 && tile.done == tile.slices;
    }
    [[nodiscard]] std::vector<Json> undone() const;

    Session& session_;
    const ClashOptions& options_;
    const ClashManifest& manifest_;
    std::vector<ClashFile> files_;
    std::vector<bool> knows_file_;
    std::size_t next_file_ = 0;
    std::size_t files_left_ = 0;

    std::vector<ClashBox> boxes_;
    std::optional<ClashTiles> tiles_;
    std::vector<TileState> states_;
    std::deque<std::uint64_t> slices_;  // of tiles whose first is done
    std::size_t next_tile_ = 0;
    std::size_t tiles_left_ = 1;  // until they are known

    FinishedPieces done_;
    std::optional<Failure> failure_;
    std::uint64_t failed_piece_ = 0;
    std::vector<PieceCost> costs_;
    std::vector<Json> clashes_;
    std::vector<Json> unanswered_;
};

}  // namespace trisect::app
