// SPDX-License-Identifier: Apache-2.0
#include "coordinating_rank.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <utility>

#include "model_cache.h"
#include "trisect/clash_command.h"
#include "trisect/clash_output.h"
#include "trisect/clash_picture.h"

namespace trisect::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// A stopped run has no more: whoever stopped it may end it.
constexpr double patience_of_a_stop = 0.5;

FinishedPieces read_journals(const std::vector<std::string>& names, const std::string& key) {
    FinishedPieces out;
    for (const std::string& name : names) out.merge(read_clash_journal(name, key));
    return out;
}

}  // namespace

CoordinatingRank::CoordinatingRank(Session& session, const RankClashOptions& options, bool& is_open)
    : session_(session),
      options_(options),
      is_open_(is_open),
      all_(static_cast<std::size_t>(Ranks::count())) {}

Outcome CoordinatingRank::run() {
    session_.plan(4);
    try {
        session_.stage("manifest", [&] { begin(); });
        session_.interruptible_stage("pairs", [&] {
            hand_out();
            return 0;
        });
        end_ranks({});
    } catch (...) {
        const std::exception_ptr reason = std::current_exception();
        write_partial();
        end_ranks(patience_of_a_stop);
        local_.reset();
        std::rethrow_exception(reason);
    }
    if (const auto& failure = coordinator_->failure()) {
        const Failure reason = *failure;
        write_partial();
        throw Error(static_cast<ErrorCode>(reason.code), reason.message);
    }
    const ClashReport report = coordinator_->take_report();
    session_.stage("write", [&] { write(report); });
    return outcome(report);
}

// Every rank reads some shares; all see the same file, so this rank knows how many will come.
ClashManifest CoordinatingRank::read_manifest() {
    const SharedManifest manifest(options_.clash.manifest, all_.size());
    std::vector<std::optional<ManifestShare>> shares(manifest.shares());
    std::size_t missing = shares.size();
    const auto take_message = [&] {
        const auto message = ranks_.receive();
        if (!message) return false;
        SharedParts share = shared_parts_of(message->bytes);
        if (share.number >= shares.size()) {
            missing = 0;
            return false;
        }
        shares[share.number] = std::move(share.parts);
        if (missing != 0) --missing;
        return true;
    };
    for (std::size_t i = 0; i < shares.size(); i += all_.size()) {
        shares[i] = manifest.read(i);
        if (missing != 0) --missing;
        while (missing != 0 && take_message()) continue;
    }
    for (Patience patience; missing != 0;) {
        if (take_message()) continue;
        if (session_.supervisor().stop_flag()) throw CancelledError();
        patience.wait();
    }
    return manifest.join(std::move(shares));
}

// The journal of this rank has all that is taken over before the others are removed.
void CoordinatingRank::begin() {
    manifest_ = read_manifest();
    RankStart start{options_.clash.manifest, clash_run_key(manifest_, options_.clash),
                    manifest_.groups.size(), manifest_.sets};
    const std::vector<std::string> old = journals();
    FinishedPieces done;
    if (options_.clash.resume) done = read_journals(old, start.key);
    local_ = std::make_unique<LocalRank>(std::make_unique<RankWorker>(
        session_, options_.clash, options_.most_bytes, start, rank_journal(options_, 0), done));
    for (const std::string& name : old)
        if (name != rank_journal(options_, 0)) fs::remove(name);
    coordinator_.emplace(session_, options_.clash, manifest_, done);
    all_.front().asks_for = tasks_ahead;
    for (std::size_t r = 1; r < all_.size(); ++r)
        ranks_.send(static_cast<int>(r), Ranks::Start, bytes_of(start));
}

void CoordinatingRank::hand_out() {
    Patience patience;
    while (!coordinator_->is_over()) {
        const bool has_come = accept_all();
        const bool has_gone = give_all();
        if (has_come || has_gone)
            patience.reset();
        else
            patience.wait();
        show_progress();
        if (session_.supervisor().stop_flag()) throw CancelledError();
    }
}

bool CoordinatingRank::accept_all() {
    bool has_come = false;
    while (auto message = ranks_.receive()) {
        if (message->tag == Ranks::Result)
            accept(static_cast<std::size_t>(message->from), rank_result_of(message->bytes));
        has_come = true;
    }
    while (auto result = local_ ? local_->take() : std::nullopt) {
        accept(0, std::move(*result));
        has_come = true;
    }
    return has_come;
}

void CoordinatingRank::accept(std::size_t rank, RankResult&& result) {
    Rank& from = all_[rank];
    if (result.kind == RankResult::Kind::End) {
        from.has_ended = true;
        from.end = std::move(result);
        return;
    }
    if (result.kind != RankResult::Kind::Ready) ++from.tasks;
    ++from.asks_for;
    from.seconds += result.seconds;
    if (coordinator_) coordinator_->accept(std::move(result));
}

bool CoordinatingRank::give_all() {
    bool has_gone = false;
    // One to each in turn.
    for (bool again = true; again;) {
        again = false;
        for (std::size_t r = 0; r < all_.size(); ++r) {
            RankTask task;
            if (all_[r].asks_for == 0 || !coordinator_->next(task)) continue;
            --all_[r].asks_for;
            again = has_gone = true;
            if (r == 0)
                local_->give(std::move(task));
            else
                ranks_.send(static_cast<int>(r), Ranks::Task, bytes_of(task));
        }
    }
    return has_gone;
}

void CoordinatingRank::show_progress() {
    const std::size_t tiles = coordinator_->tiles();
    session_.supervisor().enter_stage(
        tiles == 0 ? "files"
                   : fmt::format("tiles {}/{}", tiles - coordinator_->tiles_left(), tiles),
        tiles == 0 ? 1 : 2, 4);
}

// \param seconds how long to wait for ranks that may be no more
void CoordinatingRank::end_ranks(std::optional<double> seconds) {
    if (local_) {
        local_->stop();
        while (auto result = seconds ? std::nullopt : local_->take()) accept(0, std::move(*result));
        all_.front().end = local_->worker().ended();
    }
    for (std::size_t r = 1; r < all_.size(); ++r)
        ranks_.send(static_cast<int>(r), Ranks::Task, bytes_of(RankTask()));
    const auto begin = Clock::now();
    Patience patience;
    while (true) {
        while (auto message = ranks_.receive())
            if (message->tag == Ranks::Result)
                accept(static_cast<std::size_t>(message->from), rank_result_of(message->bytes));
        if (std::all_of(all_.begin() + 1, all_.end(), [](const Rank& r) { return r.has_ended; }))
            break;
        if (seconds && std::chrono::duration<double>(Clock::now() - begin).count() > *seconds)
            return;
        if (!seconds && session_.supervisor().stop_flag()) throw CancelledError();
        patience.wait();
    }
    while (!ranks_.has_sent_all()) patience.wait();
    is_open_ = false;
}

void CoordinatingRank::write(const ClashReport& report) {
    ModelCache models(session_, options_.clash.operands, options_.most_bytes);
    const auto part_of = [&](const Json& id) {
        const ClashPart& part =
            manifest_.parts[part_number(manifest_, id.get_ref<const std::string&>())];
        ClashFileModel read = models.get(manifest_.files[part.file]);
        return PlacedPart{read.model, Pose::from_doubles(part.pose),
                          posed_box(read.file.box.value(), part.pose), part.id, part.group};
    };
    write_clash_outputs(session_, options_.clash, manifest_, report, [&](std::size_t i) {
        const Json& clash = report.clashes[i];
        return clash_picture(clash, part_of(clash.at("a")), part_of(clash.at("b")));
    });
    if (!options_.costs.empty()) session_.write_output(options_.costs, coordinator_->costs_table());
    std::error_code ignored;
    for (const std::string& name : journals()) fs::remove(name, ignored);
    fs::remove(partial_name(), ignored);
}

// What was found until now and what is still to be done.
void CoordinatingRank::write_partial() noexcept {
    if (!coordinator_) return;
    try {
        const ClashReport report = coordinator_->take_report();
        session_.write_output(
            partial_name(),
            clash_json(manifest_, report).dump(1, ' ', false, Json::error_handler_t::replace) +
                '\n');
        session_.note(fmt::format("{}: {} clashes until now, {} of {} cells not done",
                                  partial_name(), report.clashes.size(), report.undone.size(),
                                  coordinator_->tiles()));
    } catch (const std::exception& e) {
        session_.note(partial_name() + ": " + e.what());
    }
}

std::string CoordinatingRank::partial_name() const {
    return options_.clash.outputs.front() + ".partial.json";
}

std::vector<std::string> CoordinatingRank::journals() const {
    const fs::path first(options_.clash.outputs.front());
    const fs::path folder = first.has_parent_path() ? first.parent_path() : ".";
    const std::string begin = first.filename().string() + ".journal.";
    std::vector<std::string> out;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.size() > begin.size() && name.starts_with(begin) &&
            name.find_first_not_of("0123456789", begin.size()) == std::string::npos)
            out.push_back(first.string() + name.substr(begin.size() - 9));
    }
    std::ranges::sort(out);
    return out;
}

Outcome CoordinatingRank::outcome(const ClashReport& report) const {
    Outcome out = clash_outcome(manifest_, report);
    std::uint64_t pairs = 0;
    for (const PieceCost& cost : coordinator_->costs()) pairs += cost.pairs;
    out.document["files"] = manifest_.files.size();
    out.document["candidates"] = pairs;
    out.document["tiles"] = coordinator_->tiles();
    out.document["listed"] = coordinator_->listed();
    out.document["messages"] = ranks_.messages();
    out.document["message_bytes"] = ranks_.bytes();
    out.document["ranks"] = Json::array();
    for (const Rank& rank : all_) {
        Json r;
        r["tasks"] = rank.tasks;
        r["processor_seconds"] = rank.seconds;
        r["memory"] = rank.end.memory;
        r["files_read"] = rank.end.reads;
        out.document["ranks"].push_back(std::move(r));
    }
    out.document["seconds"] = session_.seconds();
    const std::string remarks =
        fmt::format("{} parts of {} files in {} tiles on {} ranks, {} pairs of boxes, {} clashes",
                    manifest_.parts.size(), manifest_.files.size(), coordinator_->tiles(),
                    all_.size(), pairs, report.clashes.size());
    out.remarks = out.remarks.empty() ? remarks : remarks + '\n' + out.remarks;
    return out;
}

}  // namespace trisect::app
