// SPDX-License-Identifier: Apache-2.0
#include "part_store.h"

#include <algorithm>
#include <utility>

namespace trisect::app {

void PartStore::sort_parts() {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> hashes(parts_.size());
    for (std::uint32_t i = 0; i < parts_.size(); ++i) hashes[i] = {identity_hash(parts_[i].id), i};
    std::ranges::sort(hashes);
    order_.resize(parts_.size());
    for (std::size_t i = 0; i < hashes.size(); ++i) order_[i] = hashes[i].second;
}

TileSurvey PartStore::divide(const RegionPlan& plan, const ClashLimits& limits,
                             const std::vector<ClashFile>& files, std::size_t own,
                             std::size_t ranks) {
    sort_parts();
    for (std::uint32_t r = 0; r < plan.regions.size(); ++r)
        if (plan.owner(r, ranks) == own) regions_[r];
    for (std::uint32_t n = 0; n < order_.size(); ++n) {
        const ClashPart& part = parts_[order_[n]];
        const ClashBox box{posed_box(files[part.file].box.value(), part.pose), n, part.group};
        plan.regions.for_each_cell(box.box, limits.most(), [&](std::uint32_t region) {
            if (const auto at = regions_.find(region); at != regions_.end())
                at->second.boxes.push_back(box);
        });
    }
    TileSurvey out;
    for (auto& [number, region] : regions_) {
        const ClashTiles& tiles = region.tiles.emplace_back(
            region.boxes, limits, plan.regions.cell(number), plan.most_load);
        auto& facts = out.regions.emplace_back(number, std::vector<TileFacts>()).second;
        for (std::size_t i = 0; i < tiles.size(); ++i)
            facts.push_back({tiles.cell(i), tiles.boxes(i).size()});
    }
    return out;
}

TileParts PartStore::tile(std::uint32_t region, std::uint32_t tile) const {
    const Region& from = regions_.at(region);
    TileParts out;
    out.cell = from.tiles.front().cell(tile);
    for (const std::uint32_t i : from.tiles.front().boxes(tile)) {
        ClashBox box = from.boxes[i];
        const ClashPart& part = parts_[order_[box.part]];
        box.part = static_cast<std::uint32_t>(out.parts.size());
        out.parts.push_back({box, part});
    }
    return out;
}

}  // namespace trisect::app
