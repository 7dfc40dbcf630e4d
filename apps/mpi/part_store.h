// SPDX-License-Identifier: Apache-2.0
//
// PartStore: the parts in the regions of one rank.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "part_messages.h"
#include "rank_task.h"
#include "trisect/clash_pairs.h"
#include "trisect/clash_tiles.h"

namespace trisect::app {

/// Divides each of its regions into tiles, and has the parts of each. What they are depends on the
/// manifest alone: parts are in the order of the hashes of their identities.
class PartStore {
public:
    void add(ClashPart part) { parts_.push_back(std::move(part)); }
    /// \pre all parts are here
    [[nodiscard]] TileSurvey divide(const RegionPlan& plan, const ClashLimits& limits,
                                    const std::vector<ClashFile>& files, std::size_t own,
                                    std::size_t ranks);
    [[nodiscard]] TileParts tile(std::uint32_t region, std::uint32_t tile) const;

private:
    struct Region {
        std::vector<ClashBox> boxes;
        std::vector<ClashTiles> tiles;  // one, once it was made
    };

    void sort_parts();

    std::vector<ClashPart> parts_;
    std::vector<std::uint32_t> order_;  // places of parts, by number
    std::map<std::uint32_t, Region> regions_;
};

}  // namespace trisect::app
