// SPDX-License-Identifier: Apache-2.0
#include "coordinator.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "trisect/clash_merge.h"

namespace trisect::app {

Coordinator::Coordinator(Session& session, const ClashOptions& options,
                         const ClashManifest& manifest, const FinishedPieces& done)
    : session_(session),
      options_(options),
      manifest_(manifest),
      files_(manifest.files.size()),
      knows_file_(files_.size()),
      files_left_(files_.size()) {
    take_over(done);
    if (files_left_ == 0) begin_tiles();
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

bool Coordinator::next(RankTask& task) {
    if (is_over()) return false;
    if (!tiles_) {
        while (next_file_ < files_.size() && knows_file_[next_file_]) ++next_file_;
        if (next_file_ == files_.size()) return false;
        task = {};
        task.kind = RankTask::Kind::File;
        task.piece = next_file_;
        task.files = {manifest_.files[next_file_++]};
        return true;
    }
    if (!slices_.empty()) {
        task = tile_task(slices_.front());
        slices_.pop_front();
        return true;
    }
    while (next_tile_ < states_.size() && states_[next_tile_].slices != 0) ++next_tile_;
    if (next_tile_ == states_.size()) return false;
    task = tile_task(tile_piece(next_tile_++, 0));
    return true;
}

RankTask Coordinator::tile_task(std::uint64_t piece) const {
    RankTask task;
    task.kind = RankTask::Kind::Tile;
    task.piece = piece;
    task.cell = tiles_->cell(tile_of(piece));
    std::map<std::uint32_t, std::uint32_t> files;
    for (const std::uint32_t i : tiles_->boxes(tile_of(piece)))
        files.try_emplace(manifest_.parts[boxes_[i].part].file, 0);
    for (auto& [file, place] : files) {
        place = static_cast<std::uint32_t>(task.files.size());
        task.files.push_back(manifest_.files[file]);
    }
    for (const std::uint32_t i : tiles_->boxes(tile_of(piece))) {
        const ClashPart& part = manifest_.parts[boxes_[i].part];
        task.parts.push_back({boxes_[i], files.at(part.file), part.id, part.pose});
    }
    return task;
}

void Coordinator::accept(RankResult&& result) {
    if (result.kind == RankResult::Kind::Tile)
        costs_.push_back({result.piece, tiles_->boxes(tile_of(result.piece)).size(), result.pairs,
                          result.work, result.seconds});
    switch (result.kind) {
        case RankResult::Kind::File:
            files_[result.piece] = std::move(result.file);
            if (--files_left_ == 0 && !failure_) begin_tiles();
            break;
        case RankResult::Kind::Tile:
            add_slice(result.piece, result.slices, std::move(result.records));
            break;
        case RankResult::Kind::Failure:
            // Of several the first, as if all had been done one after the other.
            if (failure_ && failed_piece_ < result.piece) break;
            failure_ = Failure{result.code, result.message, {}, {}};
            failed_piece_ = result.piece;
            break;
        case RankResult::Kind::Ready:
        case RankResult::Kind::End:
            break;
    }
}

void Coordinator::begin_tiles() {
    for (const ClashFile& file : files_)
        if (!file.failure.empty()) session_.note("left out: " + file.failure);
    boxes_ = clash_boxes(manifest_, files_);
    // Ranks check those in their tiles; parts without a box are in none.
    for (const ClashPart& part : manifest_.parts)
        if (!files_[part.file].box) (void)clash_pose(options_.manifest, part.id, part.pose);
    tiles_.emplace(boxes_, ClashLimits(manifest_.sets, manifest_.groups.size()));
    states_.resize(tiles_->size());
    tiles_left_ = states_.size();
    for (auto& [piece, entry] : done_) {
        if (tile_of(piece) >= states_.size()) continue;
        TileState& tile = states_[tile_of(piece)];
        tile.slices = entry.at("slices").get<std::uint32_t>();
        add_slice(piece, tile.slices, std::move(entry.at("found")));
    }
    for (std::size_t i = 0; i < states_.size(); ++i)
        for (std::uint32_t s = 0; s < states_[i].slices; ++s)
            if (!done_.contains(tile_piece(i, s))) slices_.push_back(tile_piece(i, s));
    done_.clear();
}

void Coordinator::add_slice(std::uint64_t piece, std::uint32_t slices, Json&& found) {
    TileState& tile = states_[tile_of(piece)];
    for (Json& record : found)
        (record.contains("error") ? unanswered_ : clashes_).push_back(std::move(record));
    ++tile.done;
    if (tile.slices == 0) {
        tile.slices = slices;
        for (std::uint32_t s = 1; s < slices; ++s) slices_.push_back(tile_piece(tile_of(piece), s));
    }
    if (is_finished(tile)) --tiles_left_;
}

std::string Coordinator::costs_table() const {
    std::string out = "tile,slice,parts,pairs,work,seconds\n";
    for (const PieceCost& c : costs_)
        out += fmt::format("{},{},{},{},{},{:.6f}\n", tile_of(c.piece), slice_of(c.piece), c.parts,
                           c.pairs, c.work, c.seconds);
    return out;
}

std::vector<Json> Coordinator::undone() const {
    std::vector<Json> out;
    if (!tiles_) {
        Json record;
        record["files"] = files_left_;
        record["parts"] = manifest_.parts.size();
        out.push_back(std::move(record));
        return out;
    }
    const auto corner = [](const Point3d& p) {
        Json values = Json::array();
        for (const double v : p) values.push_back(std::isfinite(v) ? Json(v) : Json());
        return values;
    };
    for (std::size_t i = 0; i < states_.size(); ++i) {
        if (is_finished(states_[i])) continue;
        Json record;
        record["lo"] = corner(tiles_->cell(i).lo);
        record["hi"] = corner(tiles_->cell(i).hi);
        record["parts"] = tiles_->boxes(i).size();
        out.push_back(std::move(record));
    }
    return out;
}

ClashReport Coordinator::take_report() {
    ClashReport out;
    out.manifest = options_.manifest;
    out.clashes = std::exchange(clashes_, {});
    out.unanswered = std::exchange(unanswered_, {});
    sort_clashes(manifest_, out.clashes);
    sort_clashes(manifest_, out.unanswered);
    out.missing = missing_files(manifest_, files_);
    if (tiles_left_ != 0) out.undone = undone();
    return out;
}

}  // namespace trisect::app
