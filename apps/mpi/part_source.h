// SPDX-License-Identifier: Apache-2.0
//
// PartSource: the parts of a manifest that one rank has read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "part_messages.h"
#include "rank_task.h"
#include "trisect/clash_manifest.h"

namespace trisect::app {

/// Every rank reads some shares of the text. No rank has all parts: when space is divided, each
/// part goes to the ranks whose regions it meets, and is forgotten here.
class PartSource {
public:
    /// Reads the shares of a rank. One that cannot be read is no failure: then the first rank reads
    /// the whole, and says why.
    void read(const std::string& manifest, std::size_t rank, std::size_t ranks);
    /// Until begin(). \pre read()
    [[nodiscard]] const SharedManifest& manifest() const { return *manifest_; }
    /// All parts, where the first rank has read the whole.
    void take(std::vector<ClashPart> parts);
    [[nodiscard]] std::size_t parts() const;

    /// Hashes of all identities, for the rank that compares them.
    [[nodiscard]] std::vector<std::vector<std::uint64_t>> hashes(std::size_t ranks);
    [[nodiscard]] ManifestSummary summary() const;

    /// Parts with the files and groups of the whole, in place of those of shares.
    void begin(const RankStart& start);
    [[nodiscard]] PartSurvey survey(const RankStart& start,
                                    const std::vector<ClashFile>& files) const;
    /// Boxes of all parts, so that they are there when the regions come.
    void find_boxes(const std::vector<ClashFile>& files);
    /// Parts for a rank, as a list that part_list_of() reads; whether it is the last one for it.
    using Send = std::function<void(std::size_t rank, std::string bytes)>;
    using Keep = std::function<void(BoxedPart&& part, std::span<const std::uint32_t> regions)>;
    /// Parts of `own` regions are kept, with all regions that they meet; others are sent.
    void route(const RegionPlan& plan, double clearance, const std::vector<ClashFile>& files,
               std::size_t own, std::size_t ranks, const Keep& keep, const Send& send);

private:
    struct Share;
    static void find_hashes(Share& share);

    struct Share {
        ManifestShare read;
        std::vector<std::uint64_t> hashes;  // of identities
        std::vector<Bounds> boxes;          // once they are asked for; any where there is none
    };

    std::optional<SharedManifest> manifest_;
    std::vector<std::uint64_t> blocks_;
    std::vector<std::string> block_ids_;
    std::vector<Share> shares_;
    bool is_whole_ = true;
};

/// The last list of a rank says so.
struct PartList {
    bool is_last = false;
    std::vector<ClashPart> parts;
};
[[nodiscard]] PartList part_list_of(const std::string& bytes);

}  // namespace trisect::app
