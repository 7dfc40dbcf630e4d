// SPDX-License-Identifier: Apache-2.0
//
// Coordinator: orders of work for all ranks, and the findings that come back.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "part_messages.h"
#include "rank_task.h"
#include "trisect/clash_journal.h"
#include "trisect/clash_report.h"
#include "trisect/failure.h"
#include "trisect/options.h"

namespace trisect::app {

struct PieceCost {
    std::uint64_t piece = 0;
    std::size_t parts = 0;
    std::uint64_t pairs = 0;
    std::uint64_t work = 0;
    double seconds = 0;
};

/// First the files, whose boxes make those of the parts; then the tiles, which ranks made of their
/// regions. The rank that does a tile says how many slices its pairs are: those after the first are
/// pieces of their own. So no tile is too much for one rank. A rank does what is of its own
/// regions, and when nothing of that is left, what is of the rank that has most.
///
/// Where many parts are in one place, to look for the pairs of a tile is much as well: the tile is
/// cut into shares of its pairs first, and each of these is a tile by itself here.
///
/// An order has many pieces while many are left, a fixed part of what is left to a rank, and at the
/// end single ones. A rank hands back what it does not come to within some time.
///
/// What the pieces are depends on the manifest alone, and where one is done does not matter. Has
/// nothing to do with messages, and no parts but those of clashes.
class Coordinator {
public:
    /// \param manifest without parts; gets those of clashes
    /// \param done pieces of earlier runs, which are not done again
    Coordinator(const ClashOptions& options, ClashManifest& manifest, const FinishedPieces& done,
                std::size_t ranks);

    [[nodiscard]] bool has_all_files() const { return files_left_ == 0; }
    /// Where a file is missing, its box is none.
    [[nodiscard]] const std::vector<ClashFile>& files() const { return files_; }
    /// \param missing parts of files that are left out
    void begin_tiles(const RegionPlan& plan, const std::vector<TileSurvey>& surveys,
                     std::vector<std::pair<std::uint32_t, std::string>> missing);

    /// What a rank is to do. False: nothing at present, or nothing any more.
    [[nodiscard]] bool next(std::size_t rank, RankOrder& order);
    void accept(RankResult&& result);
    /// What a rank was to do, and has not begun.
    void take_back(const std::vector<RankPiece>& pieces);
    void fail(int code, const std::string& message);
    /// All is done, or something failed that ends the run.
    [[nodiscard]] bool is_over() const { return failure_ || (has_tiles_ && tiles_left_ == 0); }
    [[nodiscard]] const std::optional<Failure>& failure() const { return failure_; }
    /// How many orders a rank has at a time. One, where few pieces are left, or they differ, as
    /// files do: a rank that has two would do both while another one waits.
    [[nodiscard]] std::size_t ahead() const;

    /// Of what was done until now, and what was not; once.
    [[nodiscard]] ClashReport take_report();
    [[nodiscard]] std::size_t tiles() const { return tiles_.size(); }
    [[nodiscard]] std::size_t tiles_left() const { return tiles_left_; }
    /// Of space: tiles that are shares of the same pairs are one.
    [[nodiscard]] std::size_t cells() const;
    /// About a millisecond of boxes that are compared, if all are in one place. Journals do not
    /// depend on ranks, so that this is fixed.
    static constexpr std::uint64_t comparisons_of_a_share = std::uint64_t{1} << 18;
    /// How many shares of its pairs a tile of so many parts has.
    [[nodiscard]] static std::uint32_t shares_of(std::uint64_t parts);
    /// How often parts are in tiles.
    [[nodiscard]] std::uint64_t listed() const;
    /// What each slice of this run cost, as CSV.
    [[nodiscard]] std::string costs_table() const;
    [[nodiscard]] const std::vector<PieceCost>& costs() const { return costs_; }

private:
    struct Tile {
        TileFacts facts;
        ClashShare share;
        std::uint32_t region = 0;
        std::uint32_t number = 0;  // in the region
        std::uint32_t owner = 0;
        std::uint32_t slices = 0;  // 0: not known yet
        std::uint32_t done = 0;
    };
    // Tiles of a rank whose first slice was not ordered, or further slices.
    using Left = std::deque<std::uint64_t>;

    void take_over(const FinishedPieces& done);
    void take_over_tiles();
    [[nodiscard]] std::size_t parts_of_slice(std::uint64_t piece) const;
    void add_slice(std::uint64_t piece, std::uint32_t slices, std::vector<ClashText>&& found);
    [[nodiscard]] bool next_file(RankOrder& order);
    [[nodiscard]] bool next_slices(std::size_t rank, RankOrder& order);
    [[nodiscard]] bool next_tiles(std::size_t rank, RankOrder& order);
    [[nodiscard]] bool next_of_others(RankOrder& order);
    void add_slice_left(std::uint64_t piece, bool is_next);
    [[nodiscard]] std::size_t pieces_of(std::size_t share) const;
    void add_piece(RankOrder& order, std::uint64_t number) const;
    [[nodiscard]] bool is_finished(const Tile& tile) const {
        return tile.slices != 0 && tile.done == tile.slices;
    }
    [[nodiscard]] std::vector<Json> undone() const;

    const ClashOptions& options_;
    ClashManifest& manifest_;
    std::vector<ClashFile> files_;
    std::vector<bool> knows_file_;
    std::vector<std::uint64_t> file_bytes_;
    std::vector<std::uint64_t> file_order_;  // those that are to be read, the largest first
    std::size_t next_file_ = 0;
    std::size_t files_left_ = 0;

    bool has_tiles_ = false;
    std::vector<Tile> tiles_;
    std::vector<Left> left_;       // by rank
    std::size_t not_ordered_ = 0;  // tiles in these lists
    std::vector<Left> slices_;     // by rank, of its tiles whose first slice is done
    std::size_t slices_left_ = 0;  // in these lists
    std::size_t tiles_left_ = 0;

    FinishedPieces done_;
    std::optional<Failure> failure_;
    std::uint64_t failed_piece_ = 0;
    std::vector<PieceCost> costs_;
    double seconds_ = 0;  // of all tiles
    std::vector<ClashText> clashes_;
    std::vector<Json> unanswered_;
    std::vector<std::pair<std::uint32_t, std::string>> missing_;
};

}  // namespace trisect::app
