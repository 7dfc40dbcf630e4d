// SPDX-License-Identifier: Apache-2.0
//
// Tasks of ranks, and their results.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "message.h"
#include "trisect/clash_files.h"
#include "trisect/clash_manifest.h"
#include "trisect/clash_pairs.h"
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

/// What to do next.
struct RankOrder {
    enum class Kind : std::uint8_t {
        File,  ///< read a file, and say how large it is
        Tile,  ///< a slice of the pairs of a tile
        End    ///< nothing is left
    };
    Kind kind = Kind::End;
    std::uint64_t piece = 0;   ///< the file; the tile and the slice
    std::uint32_t owner = 0;   ///< the rank that has the parts of the tile
    std::uint32_t region = 0;  ///< of the tile
    std::uint32_t tile = 0;    ///< in its region
};

/// A part of a tile; the number of its box is its place in the list.
struct TilePart {
    ClashBox box;
    ClashPart part;
};

struct TileParts {
    Bounds cell;
    std::vector<TilePart> parts;
};

/// An order with all that it needs.
struct RankTask {
    RankOrder order;
    TileParts tile;
};

struct RankResult {
    enum class Kind : std::uint8_t { Ready, File, Tile, Failure, End };
    Kind kind = Kind::Ready;
    std::uint64_t piece = 0;
    ClashFile file;
    std::uint32_t slices = 1;  ///< of the tile
    Json records;
    std::vector<ClashPart> parts;  ///< that occur in the records
    int code = 0;                  ///< of a failure
    std::string message;
    // Counted and timed.
    std::uint64_t pairs = 0;
    std::uint64_t work = 0;      ///< units of a StopScope
    double seconds = 0;          ///< of the processor; at the end: of all that the rank did
    std::uint64_t memory = 0;    ///< at the end: most bytes that the rank had
    std::uint64_t reads = 0;     ///< at the end: files that were read, also again
    std::uint64_t received = 0;  ///< at the end: bytes
};

/// Numbers of pieces of work, as journals have them.
[[nodiscard]] constexpr std::uint64_t tile_piece(std::uint64_t tile, std::uint64_t slice) {
    return tile << 24 | slice;
}
[[nodiscard]] constexpr std::uint64_t tile_of(std::uint64_t piece) { return piece >> 24; }
[[nodiscard]] constexpr std::uint64_t slice_of(std::uint64_t piece) { return piece & 0xffffff; }
inline constexpr std::uint64_t first_file_piece = std::uint64_t{1} << 62;

[[nodiscard]] std::string bytes_of(const RankStart& start);
[[nodiscard]] std::string bytes_of(const RankOrder& order);
[[nodiscard]] std::string bytes_of(const RankTask& task);
[[nodiscard]] std::string bytes_of(const RankResult& result);
[[nodiscard]] RankStart rank_start_of(const std::string& bytes);
[[nodiscard]] RankOrder rank_order_of(const std::string& bytes);
[[nodiscard]] RankTask rank_task_of(const std::string& bytes);
[[nodiscard]] RankResult rank_result_of(const std::string& bytes);

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
