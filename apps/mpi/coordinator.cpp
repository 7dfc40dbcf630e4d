// SPDX-License-Identifier: Apache-2.0
#include "coordinator.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>
#include <utility>

#include "trisect/clash_merge.h"

namespace trisect::app {
namespace {

// An order is at most one in so many of what is left to a rank, and of the share of each in all
// that is left.
constexpr std::size_t orders_of_a_rank = 4;
constexpr std::size_t orders_of_all = 2;
// And takes some milliseconds at most, where it is known what pieces take: then a rank that hands
// back the rest has not held much.
constexpr double seconds_of_an_order = 0.01;
constexpr std::size_t pieces_of_unknown_cost = 16;
// When a rank gets its next piece only after the last one: so few are left for each. It waits for a
// message then, a few times, which is less than a tile of many parts takes.
constexpr std::size_t pieces_of_the_end = 4;
// Of the pairs of a tile.
constexpr std::uint64_t most_shares = 4096;
// Which take about a millisecond to read.
constexpr std::uint64_t bytes_of_a_short_file = std::uint64_t{32} << 10;

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
      file_bytes_(files_.size()),
      files_left_(files_.size()),
      left_(ranks),
      slices_(ranks) {
    take_over(done);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> sizes;
    for (std::size_t i = 0; i < files_.size(); ++i)
        if (!knows_file_[i]) sizes.emplace_back(file_bytes_[i] = size_of(manifest_.files[i]), i);
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
    order.kind = RankOrder::Kind::File;
    order.pieces.push_back({file_order_[next_file_++], 0, 0, {}});
    return true;
}

bool Coordinator::next(std::size_t rank, RankOrder& order) {
    order = {};
    if (is_over()) return false;
    if (!has_tiles_) return next_file(order);
    order.kind = RankOrder::Kind::Tile;
    return next_slices(rank, order) || next_tiles(rank, order) || next_of_others(order);
}

std::size_t Coordinator::pieces_of(std::size_t share) const {
    share = std::max<std::size_t>(1, share);
    if (costs_.empty()) return std::min(share, pieces_of_unknown_cost);
    const double each = seconds_ / static_cast<double>(costs_.size());
    const double most = std::max(1.0, seconds_of_an_order / std::max(each, 1e-9));
    return static_cast<double>(share) < most ? share : static_cast<std::size_t>(most);
}

std::size_t Coordinator::ahead() const {
    if (!has_tiles_ && next_file_ < file_order_.size() &&
        file_bytes_[file_order_[next_file_]] > bytes_of_a_short_file)
        return 1;
    const std::size_t left = slices_left_ + not_ordered_;
    return left < pieces_of_the_end * left_.size() ? 1 : 3;
}

void Coordinator::add_piece(RankOrder& order, std::uint64_t number) const {
    const Tile& tile = tiles_[tile_of(number)];
    order.owner = tile.owner;
    order.pieces.push_back({number, tile.region, tile.number, tile.share});
}

// Whoever has the parts of a tile needs no message for its slices.
bool Coordinator::next_slices(std::size_t rank, RankOrder& order) {
    Left& from = slices_[rank];
    if (from.empty()) return false;
    std::size_t n = pieces_of(std::min(from.size(), slices_left_ / (orders_of_all * left_.size())));
    for (slices_left_ -= n; n != 0; --n) {
        add_piece(order, from.front());
        from.pop_front();
    }
    return true;
}

bool Coordinator::next_tiles(std::size_t rank, RankOrder& order) {
    Left& from = left_[rank];
    if (from.empty()) return false;
    std::size_t n = pieces_of(
        std::min(from.size() / orders_of_a_rank, not_ordered_ / (orders_of_all * left_.size())));
    for (not_ordered_ -= n; n != 0; --n) {
        add_piece(order, tile_piece(from.front(), 0));
        from.pop_front();
    }
    return true;
}

// Of the rank that has most, from the other end; first tiles, which may have slices.
bool Coordinator::next_of_others(RankOrder& order) {
    const bool are_slices = not_ordered_ == 0;
    auto& all = are_slices ? slices_ : left_;
    std::size_t& left = are_slices ? slices_left_ : not_ordered_;
    Left& from = *std::ranges::max_element(all, {}, &Left::size);
    if (from.empty()) return false;
    std::size_t n =
        pieces_of(std::min(from.size() / orders_of_a_rank, left / (orders_of_all * left_.size())));
    for (left -= n; n != 0; --n) {
        add_piece(order, are_slices ? from.back() : tile_piece(from.back(), 0));
        from.pop_back();
    }
    return true;
}

void Coordinator::add_slice_left(std::uint64_t piece, bool is_next) {
    Left& to = slices_[tiles_[tile_of(piece)].owner];
    is_next ? to.push_front(piece) : to.push_back(piece);
    ++slices_left_;
}

void Coordinator::take_back(const std::vector<RankPiece>& pieces) {
    for (std::size_t i = pieces.size(); i-- > 0;) {
        const std::uint64_t number = pieces[i].number;
        if (!has_tiles_) {
            file_order_.push_back(number);
        } else if (slice_of(number) != 0 || tiles_[tile_of(number)].slices != 0) {
            add_slice_left(number, true);
        } else {
            left_[tiles_[tile_of(number)].owner].push_front(tile_of(number));
            ++not_ordered_;
        }
    }
}

void Coordinator::accept(RankResult&& result) {
    switch (result.kind) {
        case RankResult::Kind::File:
            files_[result.piece] = std::move(result.file);
            --files_left_;
            break;
        case RankResult::Kind::Tile:
            costs_.push_back({result.piece, parts_of_slice(result.piece), result.pairs, result.work,
                              result.seconds});
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
        const std::uint32_t owner = plan.owners[r];
        std::uint32_t number = 0;
        for (const TileFacts& facts : *regions[r]) {
            ClashShare share{0, shares_of(facts.parts)};
            for (; share.number < share.count; ++share.number)
                tiles_.push_back({facts, share, r, number, owner, 0, 0});
            ++number;
        }
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
        std::vector<ClashText> found;
        for (const Json& record : entry.at("found")) found.push_back(clash_text(record));
        add_slice(piece, tile.slices, std::move(found));
    }
    for (std::size_t i = 0; i < tiles_.size(); ++i)
        for (std::uint32_t s = 0; is_known[i] && s < tiles_[i].slices; ++s)
            if (!done_.contains(tile_piece(i, s))) add_slice_left(tile_piece(i, s), false);
    done_.clear();
}

void Coordinator::add_slice(std::uint64_t piece, std::uint32_t slices,
                            std::vector<ClashText>&& found) {
    Tile& tile = tiles_[tile_of(piece)];
    for (ClashText& clash : found) {
        if (clash.is_answer)
            clashes_.push_back(std::move(clash));
        else
            unanswered_.push_back(Json::parse(clash.text));
    }
    ++tile.done;
    if (tile.slices == 0) {
        tile.slices = slices;
        for (std::uint32_t s = 1; s < slices; ++s)
            add_slice_left(tile_piece(tile_of(piece), s), false);
    }
    if (is_finished(tile)) --tiles_left_;
}

std::uint64_t Coordinator::listed() const {
    std::uint64_t out = 0;
    for (const Tile& tile : tiles_)
        if (tile.share.number == 0) out += tile.facts.parts;
    return out;
}

std::size_t Coordinator::cells() const {
    return static_cast<std::size_t>(
        std::ranges::count(tiles_, 0U, [](const Tile& tile) { return tile.share.number; }));
}

std::uint32_t Coordinator::shares_of(std::uint64_t parts) {
    const std::uint64_t shares = parts * parts / 2 / comparisons_of_a_share;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(shares, 1, most_shares));
}

// Those of a tile are counted once.
std::size_t Coordinator::parts_of_slice(std::uint64_t piece) const {
    if (slice_of(piece) != 0) return 0;
    const Tile& tile = tiles_[tile_of(piece)];
    return (tile.facts.parts + tile.share.number) / tile.share.count;
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
    // Shares of one cell follow each other.
    bool is_listed = false;
    for (const Tile& tile : tiles_) {
        if (tile.share.number == 0) is_listed = false;
        if (is_finished(tile) || std::exchange(is_listed, true)) continue;
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
    out.texts = std::exchange(clashes_, {});
    out.unanswered = std::exchange(unanswered_, {});
    // Those of a pair came in the order of sets.
    std::ranges::stable_sort(out.texts, {}, [](const ClashText& c) { return std::tie(c.a, c.b); });
    sort_clashes(manifest_, out.unanswered);
    std::ranges::sort(missing_);
    std::vector<std::vector<std::string>> parts(files_.size());
    for (const auto& [file, id] : missing_) parts[file].push_back(id);
    out.missing = missing_files(manifest_.files, files_, std::move(parts));
    if (!has_tiles_ || tiles_left_ != 0) out.undone = undone();
    return out;
}

}  // namespace trisect::app
