// SPDX-License-Identifier: Apache-2.0
#include "coordinating_rank.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <utility>

#include "model_cache.h"
#include "rank_worker.h"
#include "region_owners.h"
#include "trisect/clash_command.h"
#include "trisect/clash_id.h"
#include "trisect/clash_output.h"
#include "trisect/clash_picture.h"
#include "trisect/clash_tiles.h"

namespace trisect::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Neighbours within a region are routed and divided together; there are many more than ranks.
constexpr double boxes_of_a_region = 2048;

// A stopped run has no more: whoever stopped it may end it.
constexpr double patience_of_a_stop = 0.5;

// Seconds on the clock since the first rank began, and of the processor of this one.
Json steps_json(const RankSteps& steps, double began) {
    Json out = Json::array();
    for (std::size_t i = 0; i < RankSteps::count; ++i) {
        const RankSteps::Time& time = steps.times[i];
        if (time.clock == 0) continue;
        out.push_back({{"step", RankSteps::names[i]},
                       {"clock", time.clock - began},
                       {"processor", time.processor}});
    }
    return out;
}

// All in order; those of each rank are.
std::vector<SampledBox> merged_samples(const std::vector<PartSurvey>& surveys) {
    std::vector<SampledBox> out;
    std::vector<std::ptrdiff_t> begins{0};
    for (const PartSurvey& s : surveys) {
        out.insert(out.end(), s.sample.begin(), s.sample.end());
        begins.push_back(static_cast<std::ptrdiff_t>(out.size()));
    }
    const auto by_hash = [](const SampledBox& a, const SampledBox& b) { return a.hash < b.hash; };
    for (std::size_t width = 1; width < surveys.size(); width *= 2)
        for (std::size_t i = 0; i + width < surveys.size(); i += 2 * width) {
            const std::size_t end = std::min(i + 2 * width, surveys.size());
            std::inplace_merge(out.begin() + begins[i], out.begin() + begins[i + width],
                               out.begin() + begins[end], by_hash);
        }
    return out;
}

FinishedPieces read_journals(const std::vector<std::string>& names, const std::string& key) {
    FinishedPieces out;
    for (const std::string& name : names) out.merge(read_clash_journal(name, key));
    return out;
}

}  // namespace

CoordinatingRank::CoordinatingRank(Session& session, const RankClashOptions& options,
                                   const RankBegin& begin, bool& is_open)
    : session_(session),
      options_(options),
      is_open_(is_open),
      station_(session, options, begin, ranks_),
      all_(static_cast<std::size_t>(Ranks::count())),
      surveys_(all_.size()),
      surveys_left_(all_.size()) {}

Outcome CoordinatingRank::run() {
    session_.plan(5);
    try {
        session_.stage("manifest", [&] { begin(); });
        const auto interruptible = [&](const char* stage, const std::function<void()>& work) {
            session_.interruptible_stage(stage, [&] {
                work();
                return 0;
            });
        };
        interruptible("files", [&] { read_files(); });
        interruptible("divide", [&] { divide(); });
        interruptible("pairs", [&] { attend([] { return false; }); });
        end_ranks({});
    } catch (...) {
        const std::exception_ptr reason = std::current_exception();
        write_partial();
        end_ranks(patience_of_a_stop);
        station_.stop();
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

void CoordinatingRank::read_whole_manifest() {
    manifest_ = read_clash_manifest(options_.clash.manifest);
    manifest_.all_parts = manifest_.parts.size();
    station_.take_parts(std::exchange(manifest_.parts, {}));
    start_.is_divided = false;
}

// What all ranks have read of it, without the parts. Where there is anything odd, this rank reads
// the whole, which says what.
void CoordinatingRank::read_manifest() {
    station_.begin();
    attend([&] { return summaries_.size() == all_.size(); });
    const auto is_odd = [](const ManifestSummary& s) { return !s.is_whole || s.has_twice; };
    if (std::ranges::any_of(summaries_, is_odd)) return read_whole_manifest();
    ManifestSummary all;
    std::vector<std::string> blocks;
    for (const ManifestSummary& s : summaries_) {
        all.parts += s.parts;
        all.files.insert(all.files.end(), s.files.begin(), s.files.end());
        all.groups.insert(all.groups.end(), s.groups.begin(), s.groups.end());
        for (const auto& [block, id] : s.blocks) {
            blocks.resize(std::max<std::size_t>(blocks.size(), block + 1));
            blocks[block] = id;
        }
    }
    for (auto* const names : {&all.files, &all.groups}) {
        std::ranges::sort(*names);
        names->erase(std::unique(names->begin(), names->end()), names->end());
    }
    auto head =
        station_.manifest().head(std::move(all.files), std::move(all.groups), long_text_id(blocks));
    if (!head) return read_whole_manifest();
    manifest_ = std::move(*head);
    manifest_.all_parts = all.parts;
}

// The journal of this rank has all that is taken over before the others are removed.
void CoordinatingRank::begin() {
    read_manifest();
    summaries_.clear();
    start_.manifest = options_.clash.manifest;
    // Slices and shares of another size are other pieces.
    start_.key = fmt::format("{}/{}/{}", clash_run_key(manifest_, options_.clash),
                             RankWorker::pairs_of_slice(options_.clash),
                             Coordinator::comparisons_of_a_share);
    start_.parts = manifest_.size();
    start_.files = manifest_.files;
    start_.groups = manifest_.groups;
    start_.sets = manifest_.sets;
    const std::vector<std::string> old = journals();
    FinishedPieces done;
    if (options_.clash.resume) done = read_journals(old, start_.key);
    coordinator_.emplace(options_.clash, manifest_, done, all_.size());
    station_.take_over(std::move(done));
    ranks_.send(0, Ranks::Start, bytes_of(start_));
    attend([&] { return all_.front().is_ready; });
    if (coordinator_->is_over()) return;
    for (const std::string& name : old)
        if (name != rank_journal(options_, 0)) fs::remove(name);
    for (std::size_t r = 1; r < all_.size(); ++r)
        ranks_.send(static_cast<int>(r), Ranks::Start, bytes_of(start_));
}

void CoordinatingRank::read_files() {
    attend([&] { return coordinator_->has_all_files(); });
    for (const ClashFile& file : coordinator_->files())
        if (!file.failure.empty()) session_.note("left out: " + file.failure);
}

void CoordinatingRank::divide() {
    if (coordinator_->is_over()) return;
    send_to_all(Ranks::Files, bytes_of(coordinator_->files()));
    attend([&] { return surveys_left_ == 0; });
    const PartSurvey* failed = nullptr;
    for (const PartSurvey& s : surveys_)
        if (s.code != 0 && (failed == nullptr || s.failed_part < failed->failed_part)) failed = &s;
    if (failed != nullptr) coordinator_->fail(failed->code, failed->failure);
    if (coordinator_->is_over()) return;
    const RegionPlan plan = plan_regions();
    send_to_all(Ranks::Regions, bytes_of(plan));
    attend([&] { return tiles_.size() == all_.size(); });
    if (coordinator_->is_over()) return;
    std::vector<std::pair<std::uint32_t, std::string>> missing;
    for (PartSurvey& s : surveys_)
        for (auto& part : s.missing) missing.push_back(std::move(part));
    surveys_.clear();
    coordinator_->begin_tiles(plan, tiles_, std::move(missing));
    tiles_.clear();
}

// By a sample in an order that is the same on any number of ranks.
RegionPlan CoordinatingRank::plan_regions() {
    std::uint64_t boxes = 0;
    for (const PartSurvey& s : surveys_) {
        boxes += s.boxes;
    }
    const std::vector<SampledBox> sample = merged_samples(surveys_);
    std::vector<ClashBox> in_order;
    for (const SampledBox& s : sample) in_order.push_back(s.box);
    const auto all = static_cast<double>(boxes);
    const double each = sample.empty() ? 1 : all / static_cast<double>(sample.size());
    ClashLoads loads(in_order, each, ClashLimits(manifest_.sets, manifest_.groups.size()));
    const double load = loads.all();
    const double most = load / std::max(std::ceil(all / boxes_of_a_region), 1.0) * std::sqrt(2.0);
    ClashDivision regions(std::move(loads), unbounded_space(), most);
    std::vector<std::uint32_t> owners = region_owners(regions, surveys_);
    for (PartSurvey& s : surveys_) s.sample = {};
    return {std::move(regions), ClashTiles::most_load(load, all), std::move(owners)};
}

void CoordinatingRank::attend(const std::function<bool()>& is_done) {
    Patience patience;
    while (!is_done() && !(coordinator_ && coordinator_->is_over())) {
        const bool has_done = station_.send_results();
        const bool has_come = take_messages();
        const bool has_gone = give_all();
        if (has_done || has_come || has_gone)
            patience.reset();
        else
            station_.wait(patience);
        show_progress();
        if (session_.supervisor().stop_flag()) throw CancelledError();
    }
}

bool CoordinatingRank::take_messages() {
    bool has_come = false;
    while (const auto message = ranks_.receive()) {
        has_come = true;
        if (station_.take(*message)) continue;
        if (message->tag == Ranks::Summary)
            summaries_.push_back(manifest_summary_of(message->bytes));
        if (message->tag == Ranks::Survey) {
            surveys_[static_cast<std::size_t>(message->from)] = part_survey_of(message->bytes);
            --surveys_left_;
        }
        if (message->tag == Ranks::Tiles) tiles_.push_back(tile_survey_of(message->bytes));
        if (message->tag == Ranks::Result)
            accept(static_cast<std::size_t>(message->from), rank_answer_of(message->bytes));
    }
    return has_come;
}

void CoordinatingRank::accept(std::size_t rank, RankAnswer&& answer) {
    if (answer.is_of_order) --all_[rank].has;
    for (RankResult& result : answer.results) accept_result(rank, std::move(result));
    if (coordinator_) coordinator_->take_back(answer.left);
}

void CoordinatingRank::accept_result(std::size_t rank, RankResult&& result) {
    Rank& from = all_[rank];
    using Kind = RankResult::Kind;
    if (result.kind == Kind::End) {
        from.has_ended = true;
        from.end = result.end;
        return;
    }
    if (result.kind == Kind::Ready) from.is_ready = true;
    if (result.kind == Kind::File || result.kind == Kind::Tile) {
        ++from.tasks;
        from.seconds += result.seconds;
    }
    if (coordinator_)
        coordinator_->accept(std::move(result));
    else if (result.kind == Kind::Failure)
        throw Error(static_cast<ErrorCode>(result.code), result.message);
}

bool CoordinatingRank::give_all() {
    if (!coordinator_) return false;
    bool has_gone = false;
    // One to each in turn.
    for (bool again = true; again;) {
        again = false;
        for (std::size_t r = 0; r < all_.size(); ++r) {
            RankOrder order;
            if (!all_[r].is_ready || all_[r].has >= coordinator_->ahead() ||
                !coordinator_->next(r, order))
                continue;
            ++all_[r].has;
            again = has_gone = true;
            ranks_.send(static_cast<int>(r), Ranks::Order, bytes_of(order));
        }
    }
    return has_gone;
}

void CoordinatingRank::send_to_all(Ranks::Tag tag, const std::string& bytes) {
    for (std::size_t r = all_.size(); r-- > 0;) ranks_.send(static_cast<int>(r), tag, bytes);
}

void CoordinatingRank::show_progress() {
    if (!coordinator_) return;
    const std::size_t tiles = coordinator_->tiles();
    session_.supervisor().enter_stage(
        tiles == 0 ? "files"
                   : fmt::format("tiles {}/{}", tiles - coordinator_->tiles_left(), tiles),
        tiles == 0 ? 1 : 3, 5);
}

// \param seconds how long to wait for ranks that may be no more
void CoordinatingRank::end_ranks(std::optional<double> seconds) {
    for (std::size_t r = all_.size(); r-- > 0;)
        if (r != 0 || !seconds)
            ranks_.send(static_cast<int>(r), Ranks::Order, bytes_of(RankOrder()));
    const auto begin = Clock::now();
    Patience patience;
    while (!std::all_of(all_.begin() + (seconds ? 1 : 0), all_.end(),
                        [](const Rank& r) { return r.has_ended; })) {
        if (take_messages()) continue;
        if (seconds && std::chrono::duration<double>(Clock::now() - begin).count() > *seconds)
            return;
        if (!seconds && session_.supervisor().stop_flag()) throw CancelledError();
        patience.wait();
    }
    ranks_.leave();
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
        Json read;
        const Json& clash = report.clash(i, read);
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
        session_.write_output(partial_name(), clash_json(manifest_, report));
        session_.note(fmt::format("{}: {} clashes until now, {} of {} cells not done",
                                  partial_name(), report.count(), report.undone.size(),
                                  coordinator_->cells()));
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
    out.document["tiles"] = coordinator_->cells();
    out.document["listed"] = coordinator_->listed();
    out.document["messages"] = ranks_.messages();
    out.document["message_bytes"] = ranks_.bytes();
    const double began = all_.front().end.steps.times[RankSteps::Began].clock;
    out.document["ranks"] = Json::array();
    for (const Rank& rank : all_) {
        Json r;
        r["tasks"] = rank.tasks;
        r["processor_seconds"] = rank.seconds;
        r["all_processor_seconds"] = rank.end.seconds;
        r["memory"] = rank.end.memory;
        r["files_read"] = rank.end.reads;
        r["idle_seconds"] = rank.end.idle;
        r["messages"] = rank.end.messages;
        r["message_bytes"] = rank.end.bytes;
        r["boxes"] = rank.end.boxes;
        r["steps"] = steps_json(rank.end.steps, began);
        out.document["ranks"].push_back(std::move(r));
    }
    out.document["seconds"] = session_.seconds();
    const std::string remarks =
        fmt::format("{} parts of {} files in {} tiles on {} ranks, {} pairs of boxes, {} clashes",
                    manifest_.size(), manifest_.files.size(), coordinator_->cells(), all_.size(),
                    pairs, report.count());
    out.remarks = out.remarks.empty() ? remarks : remarks + '\n' + out.remarks;
    return out;
}

}  // namespace trisect::app
