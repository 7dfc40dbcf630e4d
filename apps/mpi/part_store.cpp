// SPDX-License-Identifier: Apache-2.0
#include "part_store.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace trisect::app {
namespace {

constexpr std::uint32_t elsewhere = 0xffffffff;

}  // namespace

PartStore::PartStore(const RegionPlan& plan, std::size_t own)
    : plan_(plan), places_(plan.regions.size(), elsewhere) {
    for (std::uint32_t r = 0; r < plan.regions.size(); ++r) {
        if (plan.owners[r] != own) continue;
        places_[r] = static_cast<std::uint32_t>(regions_.size());
        regions_.emplace_back().number = r;
    }
}

void PartStore::add(BoxedPart&& part, std::span<const std::uint32_t> regions) {
    const auto number = static_cast<std::uint32_t>(parts_.size());
    for (const std::uint32_t region : regions) {
        if (places_[region] == elsewhere) continue;
        Region& to = regions_[places_[region]];
        to.boxes.push_back({part.box, number, part.part.group});
        to.hashes.push_back(part.hash);
    }
    parts_.push_back(std::move(part.part));
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

TileSurvey PartStore::divide(const ClashLimits& limits) {
    TileSurvey out;
    for (Region& region : regions_) {
        sort_boxes(region);
        const ClashTiles& tiles = region.tiles.emplace_back(
            region.boxes, limits, plan_.regions.cell(region.number), plan_.most_load);
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
    const RankPiece* last = nullptr;
    for (const RankPiece& piece : pieces) {
        const bool is_last =
            last != nullptr && last->region == piece.region && last->tile == piece.tile;
        last = &piece;
        out.places.push_back(static_cast<std::uint32_t>(out.tiles.size()) - (is_last ? 1 : 0));
        if (is_last) continue;
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
