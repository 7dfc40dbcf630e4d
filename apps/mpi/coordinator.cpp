// SPDX-License-Identifier: Apache-2.0
#include "coordinator.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "trisect/clash_merge.h"

namespace trisect::app {
namespace {

// Orders that a rank has ahead take at least so many seconds, unless they are too many.
constexpr double seconds_ahead = 0.005;
constexpr std::size_t least_ahead = 2;
constexpr std::size_t most_ahead = 16;
// And are no more than one in so many of what is left to a rank.
constexpr std::size_t orders_of_which_one_is_ahead = 4;

std::uint64_t size_of(const std::string& file) {
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    return error ? 0 : size;
}

}  // namespace

Coordinator::Coordinator(const ClashOptions& options, ClashManifest& manifest,
                         const FinishedPieces& done, std::size_t ranks)
    : options_(options),
      manifest_(manifest),
      files_(manifest.files.size()),
      knows_file_(files_.size()),
      files_left_(files_.size()),
      left_(ranks) {
    take_over(done);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> sizes;
    for (std::size_t i = 0; i < files_.size(); ++i)
        if (!knows_file_[i]) sizes.emplace_back(size_of(manifest_.files[i]), i);
    std::ranges::stable_sort(sizes, std::ranges::greater(), [](const auto& s) { return s.first; });
    for (const auto& [size, file] : sizes) file_order_.push_back(file);
}

void Coordinator::take_over(const FinishedPieces& done) {
    for (const auto& [piece, records] : done) {
        if (piece < first_file_piece) {
            done_.emplace(piece, records);
            continue;
        }
        const std::uint64_t file = piece - first_file_piece;
        if (file >= files_.size() || knows_file_[file]) continue;
        files_[file] = file_of_json(records);
        knows_file_[file] = true;
        --files_left_;
    }
}

bool Coordinator::next_file(RankOrder& order) {
    if (next_file_ == file_order_.size()) return false;
    order = {RankOrder::Kind::File, file_order_[next_file_++], 0, 0, 0};
    return true;
}

bool Coordinator::next(std::size_t rank, RankOrder& order) {
    if (is_over()) return false;
    if (!has_tiles_) return next_file(order);
    if (!slices_.empty()) {
        order = tile_order(slices_.front());
        slices_.pop_front();
        return true;
    }
    if (!left_[rank].empty()) {
        order = tile_order(tile_piece(left_[rank].front(), 0));
        left_[rank].pop_front();
        --not_ordered_;
        return true;
    }
    // From the other end.
    Left& most = *std::ranges::max_element(left_, {}, &Left::size);
    if (most.empty()) return false;
    order = tile_order(tile_piece(most.back(), 0));
    most.pop_back();
    --not_ordered_;
    return true;
}

RankOrder Coordinator::tile_order(std::uint64_t piece) const {
    const Tile& tile = tiles_[tile_of(piece)];
    return {RankOrder::Kind::Tile, piece, tile.owner, tile.region, tile.number};
}

std::size_t Coordinator::ahead() const {
    if (costs_.empty() || !(seconds_ > 0)) return least_ahead;
    const double wanted = seconds_ahead * static_cast<double>(costs_.size()) / seconds_;
    // What a rank has, no other one can take.
    const std::size_t most = std::clamp(
        not_ordered_ / (orders_of_which_one_is_ahead * left_.size()), least_ahead, most_ahead);
    return wanted < static_cast<double>(most)
               ? std::max(least_ahead, static_cast<std::size_t>(std::ceil(wanted)))
               : most;
}

void Coordinator::accept(RankResult&& result) {
    switch (result.kind) {
        case RankResult::Kind::File:
            files_[result.piece] = std::move(result.file);
            --files_left_;
            break;
        case RankResult::Kind::Tile:
            costs_.push_back({result.piece, tiles_[tile_of(result.piece)].facts.parts, result.pairs,
                              result.work, result.seconds});
            seconds_ += result.seconds;
            for (ClashPart& part : result.parts) manifest_.parts.push_back(std::move(part));
            add_slice(result.piece, result.slices, std::move(result.records));
            break;
        case RankResult::Kind::Failure:
            // Of several the first, as if all had been done one after the other.
            if (failure_ && failed_piece_ < result.piece) break;
            fail(result.code, result.message);
            failed_piece_ = result.piece;
            break;
        case RankResult::Kind::Ready:
        case RankResult::Kind::End:
            break;
    }
}

void Coordinator::fail(int code, const std::string& message) {
    failure_ = Failure{code, message, {}, {}};
}

void Coordinator::begin_tiles(const RegionPlan& plan, const std::vector<TileSurvey>& surveys,
                              std::vector<std::pair<std::uint32_t, std::string>> missing) {
    missing_ = std::move(missing);
    std::vector<const std::vector<TileFacts>*> regions(plan.regions.size());
    for (const TileSurvey& survey : surveys)
        for (const auto& [region, tiles] : survey.regions) regions[region] = &tiles;
    for (std::uint32_t r = 0; r < regions.size(); ++r) {
        const auto owner = static_cast<std::uint32_t>(plan.owner(r, left_.size()));
        std::uint32_t number = 0;
        for (const TileFacts& facts : *regions[r])
            tiles_.push_back({facts, r, number++, owner, 0, 0});
    }
    has_tiles_ = true;
    tiles_left_ = tiles_.size();
    take_over_tiles();
    for (std::size_t i = 0; i < tiles_.size(); ++i)
        if (tiles_[i].slices == 0) {
            left_[tiles_[i].owner].push_back(i);
            ++not_ordered_;
        }
}

void Coordinator::take_over_tiles() {
    std::vector<bool> is_known(tiles_.size());
    for (auto& [piece, entry] : done_) {
        if (tile_of(piece) >= tiles_.size()) continue;
        Tile& tile = tiles_[tile_of(piece)];
        tile.slices = entry.at("slices").get<std::uint32_t>();
        is_known[tile_of(piece)] = true;
        if (entry.contains("parts"))
            for (const Json& part : entry.at("parts"))
                manifest_.parts.push_back(part_of_json(part));
        add_slice(piece, tile.slices, std::move(entry.at("found")));
    }
    for (std::size_t i = 0; i < tiles_.size(); ++i)
        for (std::uint32_t s = 0; is_known[i] && s < tiles_[i].slices; ++s)
            if (!done_.contains(tile_piece(i, s))) slices_.push_back(tile_piece(i, s));
    done_.clear();
}

void Coordinator::add_slice(std::uint64_t piece, std::uint32_t slices, Json&& found) {
    Tile& tile = tiles_[tile_of(piece)];
    for (Json& record : found)
        (record.contains("error") ? unanswered_ : clashes_).push_back(std::move(record));
    ++tile.done;
    if (tile.slices == 0) {
        tile.slices = slices;
        for (std::uint32_t s = 1; s < slices; ++s) slices_.push_back(tile_piece(tile_of(piece), s));
    }
    if (is_finished(tile)) --tiles_left_;
}

std::uint64_t Coordinator::listed() const {
    std::uint64_t out = 0;
    for (const Tile& tile : tiles_) out += tile.facts.parts;
    return out;
}

std::string Coordinator::costs_table() const {
    std::string out = "tile,slice,region,regions,parts,pairs,work,seconds\n";
    const std::uint32_t regions = tiles_.empty() ? 0 : tiles_.back().region + 1;
    for (const PieceCost& c : costs_)
        out += fmt::format("{},{},{},{},{},{},{},{:.6f}\n", tile_of(c.piece), slice_of(c.piece),
                           tiles_[tile_of(c.piece)].region, regions, c.parts, c.pairs, c.work,
                           c.seconds);
    return out;
}

std::vector<Json> Coordinator::undone() const {
    std::vector<Json> out;
    if (!has_tiles_) {
        Json record;
        record["files"] = files_left_;
        record["parts"] = manifest_.size();
        out.push_back(std::move(record));
        return out;
    }
    const auto corner = [](const Point3d& p) {
        Json values = Json::array();
        for (const double v : p) values.push_back(std::isfinite(v) ? Json(v) : Json());
        return values;
    };
    for (const Tile& tile : tiles_) {
        if (is_finished(tile)) continue;
        Json record;
        record["lo"] = corner(tile.facts.cell.lo);
        record["hi"] = corner(tile.facts.cell.hi);
        record["parts"] = tile.facts.parts;
        out.push_back(std::move(record));
    }
    return out;
}

ClashReport Coordinator::take_report() {
    std::ranges::sort(manifest_.parts, {}, &ClashPart::id);
    const auto twice =
        std::unique(manifest_.parts.begin(), manifest_.parts.end(),
                    [](const ClashPart& a, const ClashPart& b) { return a.id == b.id; });
    manifest_.parts.erase(twice, manifest_.parts.end());
    ClashReport out;
    out.manifest = options_.manifest;
    out.clashes = std::exchange(clashes_, {});
    out.unanswered = std::exchange(unanswered_, {});
    sort_clashes(manifest_, out.clashes);
    sort_clashes(manifest_, out.unanswered);
    std::ranges::sort(missing_);
    std::vector<std::vector<std::string>> parts(files_.size());
    for (const auto& [file, id] : missing_) parts[file].push_back(id);
    out.missing = missing_files(manifest_.files, files_, std::move(parts));
    if (!has_tiles_ || tiles_left_ != 0) out.undone = undone();
    return out;
}

}  // namespace trisect::app
