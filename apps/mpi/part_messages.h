// SPDX-License-Identifier: Apache-2.0
//
// Messages by which the parts of a manifest are divided over ranks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trisect/clash_division.h"
#include "trisect/clash_files.h"
#include "trisect/clash_manifest.h"
#include "trisect/clash_pairs.h"

namespace trisect::app {

/// Of an identity; the same in every run.
[[nodiscard]] std::uint64_t identity_hash(std::string_view id);

/// What one rank has read of a manifest, without the parts.
struct ManifestSummary {
    bool is_whole = true;    ///< all shares of this rank could be read
    bool has_twice = false;  ///< identities that occur twice
    std::uint64_t parts = 0;
    std::vector<std::string> files;                             ///< each once
    std::vector<std::string> groups;                            ///< each once
    std::vector<std::pair<std::uint64_t, std::string>> blocks;  ///< of the text, with their ids
};

/// A box that stands for others, in an order that is the same on any number of ranks.
struct SampledBox {
    std::uint64_t hash = 0;  ///< of the identity
    ClashBox box;
};

/// A part, its box, and the hash of its identity. They are computed once for each part that a rank
/// has read, and once more where it was sent to.
struct BoxedPart {
    ClashPart part;
    Bounds box;
    std::uint64_t hash = 0;
};

/// What one rank says of its parts once the boxes of files are known.
struct PartSurvey {
    std::uint64_t boxes = 0;
    std::vector<SampledBox> sample;
    std::vector<std::pair<std::uint32_t, std::string>> missing;  ///< of files that are left out
    std::string failed_part;  ///< the first one whose pose is none, by identity
    std::string failure;
    int code = 0;
};

/// Space, divided into regions of some thousand parts, which belong to ranks.
struct RegionPlan {
    ClashDivision regions;
    double most_load = 0;               ///< of a tile
    std::vector<std::uint32_t> owners;  ///< the rank of each region (region_owners)
};

struct TileFacts {
    Bounds cell;
    std::uint64_t parts = 0;
};

/// The tiles of the regions of one rank.
struct TileSurvey {
    std::vector<std::pair<std::uint32_t, std::vector<TileFacts>>> regions;
};

/// \pre the file has a box
[[nodiscard]] BoxedPart boxed(ClashPart part, const std::vector<ClashFile>& files);

[[nodiscard]] std::string bytes_of(const ManifestSummary& summary);
[[nodiscard]] std::string bytes_of(const std::vector<ClashFile>& files);
[[nodiscard]] std::string bytes_of(const PartSurvey& survey);
[[nodiscard]] std::string bytes_of(const RegionPlan& plan);
[[nodiscard]] std::string bytes_of(const TileSurvey& survey);
[[nodiscard]] ManifestSummary manifest_summary_of(const std::string& bytes);
[[nodiscard]] std::vector<ClashFile> clash_files_of(const std::string& bytes);
[[nodiscard]] PartSurvey part_survey_of(const std::string& bytes);
[[nodiscard]] RegionPlan region_plan_of(const std::string& bytes);
[[nodiscard]] TileSurvey tile_survey_of(const std::string& bytes);

}  // namespace trisect::app
