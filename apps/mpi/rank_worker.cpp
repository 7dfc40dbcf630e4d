// SPDX-License-Identifier: Apache-2.0
#include "rank_worker.h"

#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <ctime>
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

bool has_corner_in(const Bounds& cell, const Bounds& box) {
    for (std::size_t k = 0; k < 3; ++k)
        if (box.lo[k] < cell.lo[k] || !(box.lo[k] < cell.hi[k])) return false;
    return true;
}

}  // namespace

RankWorker::RankWorker(Session& session, const ClashOptions& options, std::uint64_t most_bytes,
                       const RankStart& start, const std::string& journal,
                       const FinishedPieces& kept)
    : session_(session),
      options_(options),
      start_(start),
      limits_(start_.sets, start_.groups),
      models_(session, options.operands, most_bytes),
      journal_(journal, start_.key, kept) {}

RankResult RankWorker::done(const RankTask& task) {
    RankResult result;
    result.piece = task.piece;
    const double begin = processor_seconds();
    const StopScope scope(session_.limits());
    try {
        if (task.kind == RankTask::Kind::File)
            read_file(task, result);
        else
            answer_slice(task, result);
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

RankResult RankWorker::ended() const {
    RankResult out;
    out.kind = RankResult::Kind::End;
    out.reads = models_.reads();
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    out.memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return out;
}

void RankWorker::read_file(const RankTask& task, RankResult& result) {
    result.kind = RankResult::Kind::File;
    try {
        result.file = models_.get(task.files.front()).file;
    } catch (const Error& e) {
        if (!is_left_out(e, options_)) throw;
        result.file.failure = e.what();
    }
    journal_.add(first_file_piece + task.piece, file_json(result.file));
}

void RankWorker::answer_slice(const RankTask& task, RankResult& result) {
    result.kind = RankResult::Kind::Tile;
    if (tile_ != tile_of(task.piece)) find_candidates(task);
    const std::size_t size = std::max(options_.volumes ? slice_volumes : slice_pairs,
                                      (pairs_.size() + most_slices - 1) / most_slices);
    const std::size_t slices = std::max<std::size_t>(1, (pairs_.size() + size - 1) / size);
    const std::size_t slice = slice_of(task.piece);
    if (slice == 0) check_poses(task);
    const std::size_t begin = std::min(slice * size, pairs_.size());
    const std::size_t n = std::min(size, pairs_.size() - begin);
    std::vector<std::vector<Json>> records(n);
    for_each_in_parallel(n, session_.limits(),
                         [&](std::size_t i) { records[i] = answers(task, pairs_[begin + i]); });
    result.records = Json::array();
    for (auto& some : records)
        for (Json& record : some) result.records.push_back(std::move(record));
    result.slices = static_cast<std::uint32_t>(slices);
    result.pairs = n;
    journal_.add(task.piece, Json{{"slices", slices}, {"found", result.records}});
}

// By files, so that a model is asked for again while it is here.
void RankWorker::find_candidates(const RankTask& task) {
    std::vector<ClashBox> boxes;
    boxes.reserve(task.parts.size());
    for (const TilePart& part : task.parts) boxes.push_back(part.box);
    tile_.reset();
    pairs_.clear();
    add_candidates(limits_, boxes, task.cell, pairs_);
    const auto file = [&](std::uint32_t part) {
        return std::ranges::lower_bound(task.parts, part, {},
                                        [](const TilePart& p) { return p.box.part; })
            ->file;
    };
    std::ranges::sort(pairs_, {}, [&](const ClashCandidate& c) {
        return std::tuple(file(c.a), file(c.b), c.a, c.b);
    });
    tile_ = tile_of(task.piece);
}

std::vector<Json> RankWorker::answers(const RankTask& task, const ClashCandidate& pair) {
    const ClashQuestions questions{options_.regions, options_.volumes};
    const PlacedPart a = placed(task, pair.a);
    const PlacedPart b = placed(task, pair.b);
    return options_.keep_going ? clash_records_or_error(start_.sets, a, b, questions)
                               : clash_records(start_.sets, a, b, questions);
}

PlacedPart RankWorker::placed(const RankTask& task, std::uint32_t number) {
    const TilePart& part = *std::ranges::lower_bound(task.parts, number, {},
                                                     [](const TilePart& p) { return p.box.part; });
    return {models_.get(task.files[part.file]).model,
            clash_pose(start_.manifest, part.id, part.pose), part.box.box, part.id, part.box.group};
}

// Of those whose corner is here: of each part once.
void RankWorker::check_poses(const RankTask& task) const {
    for (const TilePart& part : task.parts)
        if (has_corner_in(task.cell, part.box.box))
            (void)clash_pose(start_.manifest, part.id, part.pose);
}

}  // namespace trisect::app
