// SPDX-License-Identifier: Apache-2.0
#include "part_store.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace trisect::app {
namespace {

constexpr std::uint32_t elsewhere = 0xffffffff;

}  // namespace

void PartStore::find_regions(const RegionPlan& plan, std::size_t own) {
    places_.assign(plan.regions.size(), elsewhere);
    for (std::uint32_t r = 0; r < plan.regions.size(); ++r) {
        if (plan.owners[r] != own) continue;
        places_[r] = static_cast<std::uint32_t>(regions_.size());
        regions_.emplace_back().number = r;
    }
}

void PartStore::list_boxes(const RegionPlan& plan, double clearance,
                           const std::vector<ClashFile>& files) {
    for (std::uint32_t n = 0; n < parts_.size(); ++n) {
        const ClashPart& part = parts_[n];
        const ClashBox box{posed_box(files[part.file].box.value(), part.pose), n, part.group};
        const std::uint64_t hash = identity_hash(part.id);
        plan.regions.for_each_cell(box.box, clearance, [&](std::uint32_t region) {
            if (places_[region] == elsewhere) return;
            regions_[places_[region]].boxes.push_back(box);
            regions_[places_[region]].hashes.push_back(hash);
        });
    }
}

void PartStore::sort_boxes(Region& region) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order(region.boxes.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {region.hashes[i], i};
    std::ranges::sort(order);
    std::vector<ClashBox> boxes;
    boxes.reserve(order.size());
    for (const auto& [hash, i] : order) boxes.push_back(region.boxes[i]);
    region.boxes = std::move(boxes);
    region.hashes = {};
}

TileSurvey PartStore::divide(const RegionPlan& plan, const ClashLimits& limits,
                             const std::vector<ClashFile>& files, std::size_t own) {
    find_regions(plan, own);
    list_boxes(plan, limits.most(), files);
    TileSurvey out;
    for (Region& region : regions_) {
        sort_boxes(region);
        const ClashTiles& tiles = region.tiles.emplace_back(
            region.boxes, limits, plan.regions.cell(region.number), plan.most_load);
        auto& facts = out.regions.emplace_back(region.number, std::vector<TileFacts>()).second;
        for (std::size_t i = 0; i < tiles.size(); ++i)
            facts.push_back({tiles.cell(i), tiles.boxes(i).size()});
    }
    return out;
}

TileParts PartStore::tile(std::uint32_t region, std::uint32_t tile) const {
    const Region& from = regions_.at(places_.at(region));
    const ClashTiles& tiles = from.tiles.front();
    TileParts out;
    out.cell = tiles.cell(tile);
    out.boxes.reserve(tiles.boxes(tile).size());
    out.parts.reserve(tiles.boxes(tile).size());
    for (const std::uint32_t i : tiles.boxes(tile)) {
        ClashBox box = from.boxes[i];
        out.parts.push_back(box.part);
        box.part = static_cast<std::uint32_t>(out.boxes.size());
        out.boxes.push_back(box);
    }
    return out;
}

FetchedTiles PartStore::fetched(const std::vector<RankPiece>& pieces) const {
    FetchedTiles out;
    std::unordered_map<std::uint32_t, std::uint32_t> places;
    for (const RankPiece& piece : pieces) {
        TileParts& tile = out.tiles.emplace_back(this->tile(piece.region, piece.tile));
        for (std::uint32_t& number : tile.parts) {
            const auto [at, is_new] =
                places.try_emplace(number, static_cast<std::uint32_t>(out.parts.size()));
            if (is_new) out.parts.push_back(part(number));
            number = at->second;
        }
    }
    return out;
}

}  // namespace trisect::app
