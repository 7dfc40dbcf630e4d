// SPDX-License-Identifier: Apache-2.0
//
// PartStore: the parts in the regions of one rank.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "part_messages.h"
#include "rank_task.h"
#include "trisect/clash_pairs.h"
#include "trisect/clash_tiles.h"

namespace trisect::app {

/// Divides each of its regions into tiles, and has the parts of each. What they are depends on the
/// manifest alone: parts of a region are in the order of the hashes of their identities.
class PartStore {
public:
    /// \param plan stays alive as long as this
    PartStore(const RegionPlan& plan, std::size_t own);

    void reserve(std::size_t parts) { parts_.reserve(parts); }
    /// \param regions all that the box meets, also those of other ranks
    void add(BoxedPart&& part, std::span<const std::uint32_t> regions);
    /// \pre all parts are here
    [[nodiscard]] TileSurvey divide(const ClashLimits& limits);
    /// Safe to use from many threads, as part().
    [[nodiscard]] TileParts tile(std::uint32_t region, std::uint32_t tile) const;
    [[nodiscard]] const ClashPart& part(std::uint32_t number) const { return parts_[number]; }
    /// For another rank.
    [[nodiscard]] FetchedTiles fetched(const std::vector<RankPiece>& pieces) const;

private:
    struct Region {
        std::uint32_t number = 0;
        std::vector<ClashBox> boxes;
        std::vector<std::uint64_t> hashes;  // of the identities of these, until they are sorted
        std::vector<ClashTiles> tiles;      // one, once it was made
    };

    static void sort_boxes(Region& region);

    const RegionPlan& plan_;
    std::vector<ClashPart> parts_;
    std::vector<Region> regions_;        // its own
    std::vector<std::uint32_t> places_;  // of a region in these, by its number
};

}  // namespace trisect::app
