// SPDX-License-Identifier: Apache-2.0
#include "rank_worker.h"

#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <sys/resource.h>

#include "trisect/clash_command.h"
#include "trisect/failure.h"
#include "trisect/parallel_each.h"

namespace trisect::app {
namespace {

double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

RankWorker::RankWorker(Session& session, const ClashOptions& options, std::uint64_t most_bytes,
                       const RankStart& start, const std::string& journal,
                       const FinishedPieces& kept)
    : session_(session),
      options_(options),
      start_(start),
      limits_(start_.sets, start_.groups.size()),
      models_(session, options.operands, most_bytes),
      journal_(journal, start_.key, kept) {}

RankAnswer RankWorker::done(const RankTask& task) {
    using Clock = std::chrono::steady_clock;
    RankAnswer out;
    out.is_of_order = true;
    const auto begin = Clock::now();
    if (task.store == nullptr || task.store != store_) are_parts_of_task_ = false;
    store_ = task.store;
    const std::vector<RankPiece>& pieces = task.order.pieces;
    try {
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            out.results.push_back(done(task, i));
            if (out.results.back().kind == RankResult::Kind::Failure) break;
            if (Clock::now() - begin < most_time) continue;
            out.left.assign(pieces.begin() + static_cast<std::ptrdiff_t>(i) + 1, pieces.end());
            break;
        }
    } catch (...) {
        journal_.add(std::exchange(entries_, {}));
        throw;
    }
    journal_.add(std::exchange(entries_, {}));
    return out;
}

RankResult RankWorker::done(const RankTask& task, std::size_t at) {
    RankResult result;
    result.piece = task.order.pieces[at].number;
    const double begin = processor_seconds();
    const StopScope scope(session_.limits());
    try {
        if (task.order.kind == RankOrder::Kind::File)
            read_file(result.piece, result);
        else
            answer_slice(task, at, result);
    } catch (...) {
        const Failure failure = current_failure();
        if (failure.code == static_cast<int>(ErrorCode::Cancelled)) throw;
        result.kind = RankResult::Kind::Failure;
        result.code = failure.code;
        result.message = failure.message;
    }
    result.work = scope.work();
    result.seconds = processor_seconds() - begin;
    return result;
}

RankEnd RankWorker::ended() const {
    RankEnd out;
    out.reads = models_.reads();
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    out.memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    const auto seconds_of = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    out.seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    return out;
}

void RankWorker::read_file(std::uint64_t file, RankResult& result) {
    result.kind = RankResult::Kind::File;
    try {
        result.file = models_.get(start_.files.at(file)).file;
    } catch (const Error& e) {
        if (!is_left_out(e, options_)) throw;
        result.file.failure = e.what();
    }
    entries_ += ClashJournal::entry(first_file_piece + file, file_json(result.file));
}

void RankWorker::answer_slice(const RankTask& task, std::size_t at, RankResult& result) {
    result.kind = RankResult::Kind::Tile;
    // Orders of one tile follow each other: pairs are the same, by places in its list.
    take_tile(task, at);
    if (tile_ != tile_of(result.piece)) find_candidates(task, task.order.pieces[at]);
    const std::size_t size =
        std::max(pairs_of_slice(options_), (pairs_.size() + most_slices - 1) / most_slices);
    const std::size_t slices = std::max<std::size_t>(1, (pairs_.size() + size - 1) / size);
    const std::size_t begin = std::min(slice_of(result.piece) * size, pairs_.size());
    const std::size_t n = std::min(size, pairs_.size() - begin);
    std::vector<std::vector<Json>> records(n);
    std::vector<std::vector<ClashText>> texts(n);
    for_each_in_parallel(n, session_.limits(), [&](std::size_t i) {
        records[i] = answers(task, pairs_[begin + i]);
        for (const Json& record : records[i]) texts[i].push_back(clash_text(record));
    });
    Json found = Json::array();
    for (std::size_t i = 0; i < n; ++i) {
        if (!records[i].empty()) add_parts(task, pairs_[begin + i], result);
        for (Json& record : records[i]) found.push_back(std::move(record));
        for (ClashText& text : texts[i]) result.records.push_back(std::move(text));
    }
    result.slices = static_cast<std::uint32_t>(slices);
    result.pairs = n;
    add_entry(result, std::move(found));
}

// Most tiles have no clash, and are written without a document.
void RankWorker::add_entry(const RankResult& result, Json&& found) {
    if (found.empty()) {
        entries_ += fmt::format("{{\"piece\":{},\"records\":{{\"found\":[],\"slices\":{}}}}}\n",
                                result.piece, result.slices);
        return;
    }
    Json entry{{"slices", result.slices}};
    entry["found"] = std::move(found);
    for (const ClashPart& part : result.parts) entry["parts"].push_back(part_json(part));
    entries_ += ClashJournal::entry(result.piece, entry);
}

void RankWorker::take_tile(const RankTask& task, std::size_t at) {
    const RankPiece& piece = task.order.pieces[at];
    const TilePlace place(piece.region, piece.tile);
    if (place_ == place && are_parts_of_task_) return;
    const bool is_another = place_ != place;
    place_.reset();
    if (is_another) tile_.reset();
    parts_ = task.tile(at);
    are_parts_of_task_ = true;
    if (is_another) sweep_ = ClashSweep(limits_, parts_.boxes);
    place_ = place;
}

// By files, so that a model is asked for again while it is here.
void RankWorker::find_candidates(const RankTask& task, const RankPiece& piece) {
    tile_.reset();
    pairs_.clear();
    sweep_.add_candidates(limits_, parts_.boxes, parts_.cell, piece.share, pairs_);
    const auto part_of = [&](std::uint32_t box) -> const ClashPart& {
        return task.part(parts_.parts[box]);
    };
    for (ClashCandidate& pair : pairs_)
        if (part_of(pair.b).id < part_of(pair.a).id) std::swap(pair.a, pair.b);
    const auto key = [&](const ClashCandidate& c) {
        const ClashPart& a = part_of(c.a);
        const ClashPart& b = part_of(c.b);
        return std::tuple(a.file, b.file, std::string_view(a.id), std::string_view(b.id));
    };
    std::ranges::sort(pairs_, {}, key);
    tile_ = tile_of(piece.number);
}

void RankWorker::add_parts(const RankTask& task, const ClashCandidate& pair,
                           RankResult& result) const {
    for (const std::uint32_t box : {pair.a, pair.b}) {
        const ClashPart& part = task.part(parts_.parts[box]);
        if (std::ranges::find(result.parts, part.id, &ClashPart::id) == result.parts.end())
            result.parts.push_back(part);
    }
}

std::vector<Json> RankWorker::answers(const RankTask& task, const ClashCandidate& pair) {
    const ClashQuestions questions{options_.regions, options_.volumes};
    const PlacedPart a = placed(task, pair.a);
    const PlacedPart b = placed(task, pair.b);
    return options_.keep_going ? clash_records_or_error(start_.sets, a, b, questions)
                               : clash_records(start_.sets, a, b, questions);
}

PlacedPart RankWorker::placed(const RankTask& task, std::uint32_t box) {
    const ClashPart& part = task.part(parts_.parts[box]);
    return {models_.get(start_.files[part.file]).model,
            clash_pose(start_.manifest, part.id, part.pose), parts_.boxes[box].box, part.id,
            part.group};
}

}  // namespace trisect::app
