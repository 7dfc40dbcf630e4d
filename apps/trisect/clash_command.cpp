// SPDX-License-Identifier: Apache-2.0
//
// clash MANIFEST -o REPORT: all clashes between the parts of an assembly. Each file is read once,
// however many parts have it. Pairs whose boxes meet are put in order and decided in pieces of a
// fixed size; a finished piece is written down, and a run that was killed goes on after it. So
// reports depend neither on threads nor on interruptions.
#include "clash_command.h"

#include <trisect/kernel/error.h>
#include <trisect/kernel/support/parallel_parts.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "clash_answer.h"
#include "clash_files.h"
#include "clash_gdml.h"
#include "clash_id.h"
#include "clash_journal.h"
#include "clash_manifest.h"
#include "clash_merge.h"
#include "clash_output.h"
#include "clash_page.h"
#include "clash_pairs.h"
#include "clash_picture.h"
#include "clash_report.h"
#include "clash_tiles.h"
#include "commands.h"
#include "page_entities.h"
#include "parallel_each.h"

namespace trisect::app {
namespace {

constexpr std::size_t manifest_readers = 16;  // as many threads have something to read
constexpr std::size_t piece_size = 1024;      // pairs; journals of other sizes would not fit

ClashManifest read_by_threads(Session& session, const std::string& file) {
    const SharedManifest manifest(file, manifest_readers);
    std::vector<std::optional<ManifestShare>> shares(manifest.shares());
    for_each_in_parallel(shares.size(), session.limits(),
                         [&](std::size_t i) { shares[i] = manifest.read(i); });
    return manifest.join(std::move(shares));
}

class ClashRun {
public:
    ClashRun(Session& session, const ClashOptions& options)
        : session_(session),
          options_(options),
          shard_(parse_shard(options.shard)),
          manifest_(read_by_threads(session, options.manifest)),
          files_(manifest_.files.size()),
          models_(manifest_.files.size()) {
        report_.manifest = options.manifest;
        report_.shard = options.shard;
        report_.run = clash_run_json(manifest_, options);
    }

    ClashReport& find() {
        session_.stage("read", [&] { read_files(); });
        session_.stage("prepare", [&] { place_parts(); });
        session_.stage("boxes", [&] { find_candidates(); });
        session_.interruptible_stage("pairs", [&] {
            answer_all();
            return 0;
        });
        report_.missing = missing_files(manifest_, files_);
        return report_;
    }
    void write() {
        session_.stage("write", [&] {
            write_clash_outputs(session_, options_, manifest_, report_, [&](std::size_t i) {
                const Json& clash = report_.clashes[i];
                return clash_picture(clash, part_of(clash.at("a")), part_of(clash.at("b")));
            });
        });
        if (!options_.page.empty())
            session_.stage("page", [&] {
                session_.write_output(
                    options_.page, clash_page(manifest_, report_, [&](std::uint32_t i) {
                        return models_.at(manifest_.parts[i].file).is_empty() ? PlacedPart()
                                                                              : placed(i);
                    }));
            });
        if (journal_) journal_->remove();
    }
    [[nodiscard]] const ClashManifest& manifest() const { return manifest_; }
    [[nodiscard]] std::size_t candidates() const { return candidates_.size(); }

private:
    void read_files() {
        for_each_in_parallel(files_.size(), session_.limits(), [&](std::size_t i) {
            try {
                ClashFileModel read =
                    read_clash_file(session_, options_.operands, manifest_.files[i]);
                files_[i] = std::move(read.file);
                models_[i] = std::move(read.model);
            } catch (const Error& e) {
                if (!is_left_out(e, options_)) throw;
                files_[i].failure = e.what();
            }
        });
        for (const ClashFile& file : files_)
            if (!file.failure.empty()) session_.note("left out: " + file.failure);
    }

    void place_parts() {
        poses_.resize(manifest_.parts.size());
        for_each_in_parallel(poses_.size(), session_.limits(), [&](std::size_t i) {
            const ClashPart& part = manifest_.parts[i];
            poses_[i] = clash_pose(options_.manifest, part.id, part.pose);
        });
        boxes_ = clash_boxes(manifest_, files_);
    }

    void find_candidates() {
        const ClashLimits limits(manifest_.sets, manifest_.groups.size());
        const ClashTiles tiles(boxes_, limits);
        const detail::ParallelParts parts(tiles.size(), 0, 16);
        std::vector<std::vector<ClashCandidate>> found(parts.count());
        parts.for_each([&](std::size_t part, std::size_t tile, std::size_t end) {
            std::vector<ClashBox> here;
            for (; tile < end; ++tile) {
                here.clear();
                for (const std::uint32_t i : tiles.boxes(tile)) here.push_back(boxes_[i]);
                add_candidates(limits, here, tiles.cell(tile), found[part]);
            }
        });
        for (const auto& some : found)
            candidates_.insert(candidates_.end(), some.begin(), some.end());
        std::ranges::sort(candidates_);
    }

    // A shard has every so many of the pieces.
    void answer_all() {
        const std::string name = options_.outputs.front() + ".journal";
        const std::string key = clash_run_key(manifest_, options_);
        FinishedPieces done;
        if (options_.resume) done = read_clash_journal(name, key);
        journal_.emplace(name, key, done);
        const std::size_t pieces = (candidates_.size() + piece_size - 1) / piece_size;
        for (std::size_t piece = shard_.number; piece < pieces; piece += shard_.count) {
            session_.supervisor().enter_stage(
                fmt::format("pairs {}/{}", piece * piece_size, candidates_.size()), 3, 5);
            if (!done.contains(piece)) {
                done[piece] = answers_of(piece);
                journal_->add(piece, done[piece]);
            }
            for (Json& record : done[piece])
                (record.contains("error") ? report_.unanswered : report_.clashes)
                    .push_back(std::move(record));
            done.erase(piece);
        }
    }

    [[nodiscard]] Json answers_of(std::size_t piece) const {
        const std::size_t begin = piece * piece_size;
        const std::size_t n = std::min(piece_size, candidates_.size() - begin);
        std::vector<std::vector<Json>> records(n);
        for_each_in_parallel(n, session_.limits(), [&](std::size_t i) {
            const ClashCandidate& pair = candidates_[begin + i];
            records[i] = (options_.keep_going ? clash_records_or_error : clash_records)(
                manifest_.sets, placed(pair.a), placed(pair.b),
                {options_.regions, options_.volumes});
        });
        Json out = Json::array();
        for (auto& some : records)
            for (Json& record : some) out.push_back(std::move(record));
        return out;
    }

    [[nodiscard]] PlacedPart placed(std::uint32_t number) const {
        const ClashPart& part = manifest_.parts[number];
        return {models_[part.file], poses_[number],
                posed_box(files_[part.file].box.value(), part.pose), part.id, part.group};
    }
    [[nodiscard]] PlacedPart part_of(const Json& id) const {
        return placed(part_number(manifest_, id.get_ref<const std::string&>()));
    }

    Session& session_;
    const ClashOptions& options_;
    ClashShard shard_;
    ClashManifest manifest_;
    std::vector<ClashFile> files_;
    std::vector<InterferenceModel> models_;
    std::vector<Pose> poses_;
    std::vector<ClashBox> boxes_;
    std::vector<ClashCandidate> candidates_;
    std::optional<ClashJournal> journal_;
    ClashReport report_;
};

// Of a report that is merged: the page reads each file when it comes to the first of its parts.
void write_merged_page(Session& session, const ClashOptions& options, const ClashManifest& manifest,
                       const ClashReport& report) {
    const std::string text = clash_page(manifest, report, [&](std::uint32_t i) {
        PlacedPart out;
        const std::string& file = manifest.files[manifest.parts[i].file];
        try {
            out.model = read_clash_file(session, options.operands, file).model;
        } catch (const Error& e) {
            if (!is_left_out(e, options)) throw;
            session.note(std::string("left out: ") + e.what());
        }
        return out;
    });
    session.write_output(options.page, text);
}

Outcome merge_shards(Session& session, const ClashOptions& options) {
    session.plan(options.page.empty() ? 2 : 3);
    const ClashManifest manifest = read_clash_manifest(options.manifest);
    if (!options.pictures.empty())
        throw UsageError("--pictures: not of reports that are merged, whose parts are not read");
    const ClashReport report =
        session.stage("merge", [&] { return merged_report(manifest, options.shards); });
    session.stage("write", [&] {
        write_clash_outputs(session, options, manifest, report,
                            [](std::size_t) { return std::string(); });
    });
    if (!options.page.empty())
        session.stage("page", [&] { write_merged_page(session, options, manifest, report); });
    Outcome out = clash_outcome(manifest, report);
    out.document["seconds"] = session.seconds();
    return out;
}

}  // namespace

bool is_left_out(const Error& e, const ClashOptions& options) {
    return options.keep_going && e.code() != ErrorCode::Cancelled &&
           e.code() != ErrorCode::Internal;
}

Json clash_run_json(const ClashManifest& manifest, const ClashOptions& options) {
    Json out;
    out["manifest"] = manifest.key;
    out["files"] = clash_id({clash_files_state(manifest)});
    out["regions"] = options.regions;
    out["volumes"] = options.volumes;
    out["keep_going"] = options.keep_going;
    out["assume_embedded"] = options.operands.assume_embedded;
    out["winding"] = static_cast<int>(options.operands.winding);
    return out;
}

std::string clash_run_key(const ClashManifest& manifest, const ClashOptions& options) {
    return clash_id({clash_run_json(manifest, options).dump(), options.shard});
}

CLI::App& add_clash_options(CLI::App& app, ClashOptions& options) {
    CLI::App* command = app.add_subcommand(
        "clash", "all clashes between the parts of an assembly; exit code 1 if there are any");
    command
        ->add_option("MANIFEST", options.manifest,
                     "parts and sets to compare (JSON), a table of parts (CSV), or a geometry of "
                     "volumes in volumes (GDML)")
        ->required();
    command
        ->add_option(
            "-o,--output", options.outputs,
            "report, as .json, .csv or BCF 2.1 (.bcf, .bcfzip); may be given several times")
        ->required()
        ->type_name("FILE")
        ->expected(1, 16);
    command->add_flag("--regions", options.regions, "also where boundaries meet");
    command->add_flag("--volumes", options.volumes, "also the volume of each overlap, exactly");
    command
        ->add_option("--pictures", options.pictures,
                     "folder for a picture of each clash; BCF has them too")
        ->type_name("FOLDER");
    command->add_flag("--resume", options.resume, "go on where a run that was stopped ended");
    command->add_flag("--keep-going", options.keep_going,
                      "leave out what cannot be used, and list it in the report");
    command
        ->add_option("--facets", options.facets,
                     "of a whole circle, in GDML: a multiple of 4 up to 3600")
        ->type_name("N")
        ->capture_default_str();
    add_operand_options(*command, options.operands);
    return *command;
}

void add_clash_command(CLI::App& app, ClashOptions& options) {
    CLI::App* command = &add_clash_options(app, options);
    command
        ->add_option("--shard", options.shard,
                     "only part I of N of the pairs: runs may share the work")
        ->type_name("I/N");
    command
        ->add_option("--merge", options.shards,
                     "make one report of those of all shards (JSON) instead, without the parts")
        ->type_name("REPORT")
        ->expected(1, 1'000'000);
    add_page_option(*command, options.page);
}

Outcome run_clash(Session& session, const ClashOptions& options) {
    check_clash_outputs(session, options);
    check_page_name(session, options.page);
    if (options.manifest.ends_with(".gdml")) {
        if (!options.page.empty()) throw UsageError("--page: not of detector geometries");
#ifdef TRISECT_WITH_GDML
        return run_gdml_clash(session, options);
#else
        throw UnsupportedError(options.manifest + ": Trisect was built without expat");
#endif
    }
    if (!options.shards.empty()) return merge_shards(session, options);
    session.plan(options.page.empty() ? 5 : 6);
    ClashRun run(session, options);
    const ClashReport& report = run.find();
    run.write();
    Outcome out = clash_outcome(run.manifest(), report);
    const std::size_t files = run.manifest().files.size();
    out.document["files"] = files;
    out.document["candidates"] = run.candidates();
    out.document["seconds"] = session.seconds();
    const std::string remarks =
        fmt::format("{} parts of {} files, {} pairs of boxes, {} clashes",
                    run.manifest().parts.size(), files, run.candidates(), report.clashes.size());
    out.remarks = out.remarks.empty() ? remarks : remarks + '\n' + out.remarks;
    return out;
}

}  // namespace trisect::app
