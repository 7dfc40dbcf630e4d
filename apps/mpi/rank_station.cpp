// SPDX-License-Identifier: Apache-2.0
#include "rank_station.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "message.h"
#include "rank_worker.h"
#include "trisect/failure.h"

namespace trisect::app {
namespace {

std::string hashes_bytes(const std::vector<std::uint64_t>& hashes) {
    MessageWriter out;
    out.put_list(hashes);
    return out.take();
}

}  // namespace

RankStation::RankStation(Session& session, const RankClashOptions& options, const RankBegin& begin,
                         Ranks& ranks)
    : session_(session),
      options_(options),
      ranks_(ranks),
      own_(static_cast<std::size_t>(Ranks::rank())),
      count_(static_cast<std::size_t>(Ranks::count())),
      reading_(begin.reading),
      steps_(begin.steps),
      sources_left_(count_) {}

void RankStation::begin() {
    source_ = reading_.take();
    steps_.note(RankSteps::Read);
    const auto hashes = source_.hashes(count_);
    for (std::size_t r = 0; r < count_; ++r)
        ranks_.send(static_cast<int>(r), Ranks::Hashes, hashes_bytes(hashes[r]));
}

bool RankStation::take(const Ranks::Message& message) {
    try {
        switch (message.tag) {
            case Ranks::Summary:
            case Ranks::Result:
            case Ranks::Survey:
            case Ranks::Tiles:
                return false;
            default:
                handle(message);
                return true;
        }
    } catch (...) {
        const Failure failure = current_failure();
        if (failure.code == static_cast<int>(ErrorCode::Cancelled)) throw;
        RankResult result;
        result.kind = RankResult::Kind::Failure;
        result.code = failure.code;
        result.message = failure.message;
        answer(std::move(result));
    }
    return true;
}

void RankStation::handle(const Ranks::Message& message) {
    switch (message.tag) {
        case Ranks::Hashes:
            return compare(message.bytes);
        case Ranks::Start:
            return start(message.bytes);
        case Ranks::Order:
            return obey(rank_order_of(message.bytes));
        case Ranks::Files:
            return survey(message.bytes);
        case Ranks::Regions:
            return route(message.bytes);
        case Ranks::Parts:
            return add_parts(message.bytes);
        case Ranks::Fetch: {
            RankTask task{rank_order_of(message.bytes), {}, nullptr};
            task.fetched = std::make_shared<const FetchedTiles>(store_->fetched(task.order.pieces));
            return ranks_.send(message.from, Ranks::Task, bytes_of(task));
        }
        case Ranks::Task:
            return take_task(rank_task_of(message.bytes));
        default:
            throw Error(ErrorCode::Internal, "a message of no kind");
    }
}

// Identities are the same where their hashes are, or nearly certainly: the first rank then reads
// the whole and compares them.
void RankStation::compare(const std::string& hashes) {
    const auto some = MessageReader(hashes).get_list<std::uint64_t>();
    hashes_.insert(hashes_.end(), some.begin(), some.end());
    if (++compared_ != count_) return;
    std::ranges::sort(hashes_);
    ManifestSummary summary = source_.summary();
    summary.has_twice = std::ranges::adjacent_find(hashes_) != hashes_.end();
    hashes_ = {};
    ranks_.send(0, Ranks::Summary, bytes_of(summary));
    steps_.note(RankSteps::Compared);
}

void RankStation::start(const std::string& bytes) {
    start_ = rank_start_of(bytes);
    source_.begin(*start_);
    local_ = std::make_unique<LocalRank>(
        std::make_unique<RankWorker>(session_, options_.clash, options_.most_bytes, *start_,
                                     rank_journal(options_, Ranks::rank()), kept_));
    kept_.clear();
    answer(RankResult());  // it is ready
    steps_.note(RankSteps::Started);
}

void RankStation::obey(const RankOrder& order) {
    if (order.kind == RankOrder::Kind::End) return end();
    if (order.kind == RankOrder::Kind::File) return local_->give({order, {}, nullptr});
    if (order.owner == own_)
        local_->give({order, {}, &*store_});
    else if (has_kept(order))
        local_->give({order, kept_tile_.fetched, nullptr});
    else
        ranks_.send(static_cast<int>(order.owner), Ranks::Fetch, bytes_of(order));
}

// Where many parts are in one place, one tile has many orders.
void RankStation::take_task(RankTask task) {
    if (task.fetched->tiles.size() == 1) kept_tile_ = task;
    local_->give(std::move(task));
}

bool RankStation::has_kept(const RankOrder& order) const {
    if (!kept_tile_.fetched || order.owner != kept_tile_.order.owner) return false;
    const RankPiece& kept = kept_tile_.order.pieces.front();
    return std::ranges::all_of(order.pieces, [&](const RankPiece& piece) {
        return piece.region == kept.region && piece.tile == kept.tile;
    });
}

void RankStation::survey(const std::string& files) {
    files_ = clash_files_of(files);
    ranks_.send(0, Ranks::Survey, bytes_of(source_.survey(*start_, files_)));
    steps_.note(RankSteps::Surveyed);
    // While the first rank plans the regions.
    if (own_ != 0) source_.find_boxes(files_);
    boxes_ += source_.parts();
}

void RankStation::route(const std::string& regions) {
    plan_ = region_plan_of(regions);
    store_.emplace(*plan_, own_);
    store_->reserve(source_.parts());
    const ClashLimits limits(start_->sets, start_->groups.size());
    source_.route(
        *plan_, limits.most(), files_, own_, count_,
        [&](BoxedPart&& part, std::span<const std::uint32_t> met) {
            store_->add(std::move(part), met);
        },
        [&](std::size_t rank, std::string bytes) {
            ranks_.send(static_cast<int>(rank), Ranks::Parts, std::move(bytes));
        });
    steps_.note(RankSteps::Routed);
    for (const std::string& bytes : std::exchange(early_, {})) add_parts(bytes);
    --sources_left_;
    divide_if_all_are_here();
}

void RankStation::add_parts(const std::string& bytes) {
    if (!store_) {
        early_.push_back(bytes);
        return;
    }
    PartList list = part_list_of(bytes);
    boxes_ += list.parts.size();
    const ClashLimits limits(start_->sets, start_->groups.size());
    std::vector<std::uint32_t> met;
    for (ClashPart& part : list.parts) {
        BoxedPart with_box = boxed(std::move(part), files_);
        met.clear();
        plan_->regions.for_each_cell(with_box.box, limits.most(),
                                     [&](std::uint32_t region) { met.push_back(region); });
        store_->add(std::move(with_box), met);
    }
    if (!list.is_last) return;
    --sources_left_;
    divide_if_all_are_here();
}

void RankStation::divide_if_all_are_here() {
    if (sources_left_ != 0) return;
    const ClashLimits limits(start_->sets, start_->groups.size());
    ranks_.send(0, Ranks::Tiles, bytes_of(store_->divide(limits)));
    steps_.note(RankSteps::Divided);
}

bool RankStation::send_results() {
    bool has_gone = false;
    while (const auto done = local_ ? local_->take() : std::nullopt) {
        answer(*done);
        has_gone = true;
    }
    return has_gone;
}

void RankStation::end() {
    RankResult result;
    if (local_) {
        local_->stop();
        (void)send_results();
        result.end = local_->worker().ended();
        result.end.idle = local_->idle();
    }
    steps_.note(RankSteps::Ended);
    result.kind = RankResult::Kind::End;
    result.end.boxes = boxes_;
    result.end.steps = steps_;
    result.end.messages = ranks_.messages();
    result.end.bytes = ranks_.bytes();
    answer(std::move(result));
    has_ended_ = true;
}

void RankStation::stop() {
    if (local_) local_->stop();
}

void RankStation::wait(Patience& patience) const {
    local_ ? local_->wait(patience.next()) : patience.wait();
}

void RankStation::answer(const RankAnswer& answer) {
    ranks_.send(0, Ranks::Result, bytes_of(answer));
}

void RankStation::answer(RankResult&& result) {
    RankAnswer out;
    out.results.push_back(std::move(result));
    answer(out);
}

void serve(Session& session, const RankClashOptions& options, const RankBegin& begin) {
    session.interruptible_stage("pairs", [&] {
        Ranks ranks;
        RankStation station(session, options, begin, ranks);
        station.begin();
        for (Patience patience; !station.has_ended();) {
            bool has_come = false;
            while (const auto message = ranks.receive()) {
                if (!station.take(*message))
                    throw Error(ErrorCode::Internal, "a message for another rank");
                has_come = true;
            }
            if (station.send_results() || has_come)
                patience.reset();
            else
                station.wait(patience);
            if (session.supervisor().stop_flag()) throw CancelledError();
        }
        ranks.leave();
        return 0;
    });
}

std::string rank_journal(const RankClashOptions& options, int rank) {
    return fmt::format("{}.journal.{}", options.clash.outputs.front(), rank);
}

}  // namespace trisect::app
