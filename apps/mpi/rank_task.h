// SPDX-License-Identifier: Apache-2.0
//
// Tasks of ranks, and their results.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "message.h"
#include "rank_steps.h"
#include "trisect/clash_files.h"
#include "trisect/clash_manifest.h"
#include "trisect/clash_pairs.h"
#include "trisect/clash_text.h"
#include "trisect/outcome.h"

namespace trisect::app {

/// What all ranks know before they begin.
struct RankStart {
    std::string manifest;     ///< its name
    std::string key;          ///< of the run
    bool is_divided = true;   ///< each rank has read some of the parts; otherwise the first all
    std::uint64_t parts = 0;  ///< in all
    std::vector<std::string> files;   ///< as in ClashManifest
    std::vector<std::string> groups;  ///< as in ClashManifest
    std::vector<ClashSet> sets;
};

/// A piece of work.
struct RankPiece {
    std::uint64_t number = 0;  ///< the file; the share of a tile and the slice
    std::uint32_t region = 0;  ///< of the tile
    std::uint32_t tile = 0;    ///< in its region
    ClashShare share;          ///< of its pairs
};

/// What to do next, one piece after the other.
struct RankOrder {
    enum class Kind : std::uint8_t {
        File,  ///< read files, and say how large they are
        Tile,  ///< slices of the pairs of tiles
        End    ///< nothing is left
    };
    Kind kind = Kind::End;
    std::uint32_t owner = 0;  ///< the rank that has the parts of the tiles
    std::vector<RankPiece> pieces;
};

/// The boxes of a tile, whose numbers are their places in the list, and the numbers of their parts.
struct TileParts {
    Bounds cell;
    std::vector<ClashBox> boxes;
    std::vector<std::uint32_t> parts;
};

/// Tiles of another rank, with their parts, each once.
struct FetchedTiles {
    std::vector<ClashPart> parts;
    std::vector<TileParts> tiles;       ///< each once, where its pieces follow each other
    std::vector<std::uint32_t> places;  ///< in these, of each piece of the order it was asked for
};

class PartStore;

/// An order with all that it needs.
struct RankTask {
    RankOrder order;
    std::shared_ptr<const FetchedTiles> fetched;  ///< where the tiles are another rank's
    const PartStore* store = nullptr;             ///< where they are its own

    [[nodiscard]] TileParts tile(std::size_t piece) const;
    [[nodiscard]] const ClashPart& part(std::uint32_t number) const;
};

/// What a rank needed in all.
struct RankEnd {
    double seconds = 0;          ///< of the processor
    double idle = 0;             ///< seconds on the clock without work, from the first order of a
                                 ///< tile to the last
    std::uint64_t memory = 0;    ///< most bytes that it had
    std::uint64_t reads = 0;     ///< files that were read, also again
    std::uint64_t messages = 0;  ///< sent and received
    std::uint64_t bytes = 0;     ///< of these
    std::uint64_t boxes = 0;     ///< of parts, that were computed
    RankSteps steps;
};

struct RankResult {
    enum class Kind : std::uint8_t { Ready, File, Tile, Failure, End };
    Kind kind = Kind::Ready;
    std::uint64_t piece = 0;
    ClashFile file;
    std::uint32_t slices = 1;  ///< of the tile
    std::vector<ClashText> records;
    std::vector<ClashPart> parts;  ///< that occur in the records
    int code = 0;                  ///< of a failure
    std::string message;
    // Counted and timed.
    std::uint64_t pairs = 0;
    std::uint64_t work = 0;  ///< units of a StopScope
    double seconds = 0;      ///< of the processor
    RankEnd end;
};

/// What came of an order, or something else to say.
struct RankAnswer {
    bool is_of_order = false;
    std::vector<RankResult> results;
    std::vector<RankPiece> left;  ///< what was not begun, and is for whoever comes next
};

/// Numbers of pieces of work, as journals have them.
// A tile is a share of its pairs here, all of them but where many parts are in one place.
[[nodiscard]] constexpr std::uint64_t tile_piece(std::uint64_t tile, std::uint64_t slice) {
    return tile << 24 | slice;
}
[[nodiscard]] constexpr std::uint64_t tile_of(std::uint64_t piece) { return piece >> 24; }
[[nodiscard]] constexpr std::uint64_t slice_of(std::uint64_t piece) { return piece & 0xffffff; }
inline constexpr std::uint64_t first_file_piece = std::uint64_t{1} << 62;

[[nodiscard]] std::string bytes_of(const RankStart& start);
[[nodiscard]] std::string bytes_of(const RankOrder& order);
[[nodiscard]] std::string bytes_of(const RankTask& task);
[[nodiscard]] std::string bytes_of(const RankAnswer& answer);
[[nodiscard]] RankStart rank_start_of(const std::string& bytes);
[[nodiscard]] RankOrder rank_order_of(const std::string& bytes);
[[nodiscard]] RankTask rank_task_of(const std::string& bytes);
[[nodiscard]] RankAnswer rank_answer_of(const std::string& bytes);

void put_part(MessageWriter& out, const ClashPart& part);
[[nodiscard]] ClashPart get_part(MessageReader& in);
void put_file(MessageWriter& out, const ClashFile& file);
[[nodiscard]] ClashFile get_file(MessageReader& in);

/// Entries of a journal.
[[nodiscard]] Json file_json(const ClashFile& file);
[[nodiscard]] ClashFile file_of_json(const Json& json);
[[nodiscard]] Json part_json(const ClashPart& part);
[[nodiscard]] ClashPart part_of_json(const Json& json);

}  // namespace trisect::app
