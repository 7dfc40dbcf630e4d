// SPDX-License-Identifier: Apache-2.0
//
// Tasks of ranks, and their results.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trisect/clash_files.h"
#include "trisect/clash_manifest.h"
#include "trisect/clash_pairs.h"
#include "trisect/outcome.h"

namespace trisect::app {

/// What all ranks know before they begin; the first message.
struct RankStart {
    std::string manifest;  ///< its name
    std::string key;       ///< of the run
    std::uint64_t groups = 0;
    std::vector<ClashSet> sets;
};

/// A part of a tile.
struct TilePart {
    ClashBox box;
    std::uint32_t file = 0;  ///< in the list of the task
    std::string id;
    std::array<double, 12> pose{};
};

struct RankTask {
    enum class Kind : std::uint8_t {
        File,  ///< read a file, and say how large it is
        Tile,  ///< a slice of the pairs of a tile
        End    ///< nothing is left
    };
    Kind kind = Kind::End;
    std::uint64_t piece = 0;  ///< the file; the tile and the slice
    std::vector<std::string> files;
    Bounds cell;
    std::vector<TilePart> parts;
};

struct RankResult {
    enum class Kind : std::uint8_t { Ready, File, Tile, Failure, End };
    Kind kind = Kind::Ready;
    std::uint64_t piece = 0;
    ClashFile file;
    std::uint32_t slices = 1;  ///< of the tile
    Json records;
    int code = 0;  ///< of a failure
    std::string message;
    // Counted and timed.
    std::uint64_t pairs = 0;
    std::uint64_t work = 0;      ///< units of a StopScope
    double seconds = 0;          ///< of the processor
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
[[nodiscard]] std::string bytes_of(const RankTask& task);
[[nodiscard]] std::string bytes_of(const RankResult& result);
[[nodiscard]] RankStart rank_start_of(const std::string& bytes);
[[nodiscard]] RankTask rank_task_of(const std::string& bytes);
[[nodiscard]] RankResult rank_result_of(const std::string& bytes);

/// One share of a manifest; without parts where it could not be read.
inline constexpr std::uint64_t no_share = ~std::uint64_t{0};  ///< where a rank finds none
struct SharedParts {
    std::uint64_t number = 0;
    std::optional<ManifestShare> parts;
};
[[nodiscard]] std::string bytes_of(const SharedParts& share);
[[nodiscard]] SharedParts shared_parts_of(const std::string& bytes);

/// A file's entry in a journal.
[[nodiscard]] Json file_json(const ClashFile& file);
[[nodiscard]] ClashFile file_of_json(const Json& json);

}  // namespace trisect::app
