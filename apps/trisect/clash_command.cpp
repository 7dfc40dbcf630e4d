// SPDX-License-Identifier: Apache-2.0
//
// clash MANIFEST -o REPORT: all clashes between the parts of an assembly. Each file is read once,
// however many parts have it. Pairs whose boxes meet are put in order and decided in pieces of a
// fixed size; a finished piece is written down, and a run that was killed goes on after it. So
// reports depend neither on threads nor on interruptions.
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "clash_answer.h"
#include "clash_journal.h"
#include "clash_manifest.h"
#include "clash_pairs.h"
#include "clash_picture.h"
#include "clash_report.h"
#include "commands.h"
#include "operand.h"
#include "output_name.h"
#include "parallel_each.h"
#include "values.h"

namespace trisect::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t piece_size = 1024;  // pairs; journals of other sizes would not fit

enum class ReportFormat : std::uint8_t { Json, Csv, Bcf };

ReportFormat format_of(const std::string& name) {
    if (name.ends_with(".json")) return ReportFormat::Json;
    if (name.ends_with(".csv")) return ReportFormat::Csv;
    if (name.ends_with(".bcf") || name.ends_with(".bcfzip")) return ReportFormat::Bcf;
    throw UsageError(name + ": a report is .json, .csv, .bcf or .bcfzip");
}

struct Shard {
    std::size_t number = 0;
    std::size_t count = 1;
};

Shard parse_shard(const std::string& text) {
    if (text.empty()) return {};
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos) throw UsageError("--shard: I/N, such as 1/4");
    const std::int64_t number = parse_integer(text.substr(0, slash), "--shard");
    const std::int64_t count = parse_integer(text.substr(slash + 1), "--shard");
    if (number < 1 || count < number) throw UsageError("--shard: I/N with I from 1 to N");
    return {static_cast<std::size_t>(number - 1), static_cast<std::size_t>(count)};
}

/// The files of all parts, each once, and what became of them.
class ClashFiles {
public:
    ClashFiles(const ClashManifest& manifest, bool keep_going) : keep_going_(keep_going) {
        for (const ClashPart& part : manifest.parts) files_[part.file].parts.push_back(part.id);
    }

    void read(Session& session, const OperandOptions& options) {
        std::vector<std::string> names;
        for (const auto& [name, file] : files_) names.push_back(name);
        if (keep_going_) {
            for (const std::string& name : names) read_one(session, options, name);
            return;
        }
        std::vector<Operand> read = read_operands(session, names, options);
        for (std::size_t i = 0; i < names.size(); ++i)
            files_.at(names[i]).model = InterferenceModel(read[i].solid);
    }
    /// Boxes, and all that questions need.
    void prepare(const Session& session) {
        std::vector<File*> all;
        for (auto& [name, file] : files_) all.push_back(&file);
        for_each_in_parallel(all.size(), session.limits(), [&](std::size_t i) {
            if (all[i]->failure.is_null()) all[i]->box = bounds(all[i]->model.solid());
        });
    }

    struct File {
        InterferenceModel model;
        std::optional<Bounds> box;
        std::vector<std::string> parts;
        Json failure;
    };
    [[nodiscard]] const File& of(const ClashPart& part) const { return files_.at(part.file); }
    [[nodiscard]] std::size_t size() const { return files_.size(); }

    [[nodiscard]] std::vector<Json> missing() const {
        std::vector<Json> out;
        for (const auto& [name, file] : files_) {
            if (file.failure.is_null()) continue;
            Json record;
            record["file"] = name;
            record["error"] = file.failure;
            record["parts"] = file.parts;
            out.push_back(std::move(record));
        }
        return out;
    }
    /// Of names, sizes and times.
    [[nodiscard]] std::string state() const {
        std::string out;
        for (const auto& [name, file] : files_) {
            std::error_code error;
            const auto size = fs::file_size(name, error);
            const auto time = fs::last_write_time(name, error).time_since_epoch().count();
            out += fmt::format("{}|{}|{}\n", name, error ? 0 : size, error ? 0 : time);
        }
        return out;
    }

private:
    void read_one(Session& session, const OperandOptions& options, const std::string& name) {
        try {
            const std::vector<Operand> read = read_operands(session, std::span(&name, 1), options);
            files_.at(name).model = InterferenceModel(read[0].solid);
        } catch (const Error& e) {
            if (e.code() == ErrorCode::Cancelled || e.code() == ErrorCode::Internal) throw;
            files_.at(name).failure = e.what();
            session.note(fmt::format("left out: {}", e.what()));
        }
    }

    bool keep_going_;
    std::map<std::string, File> files_;
};

class ClashRun {
public:
    ClashRun(Session& session, const ClashOptions& options)
        : session_(session),
          options_(options),
          shard_(parse_shard(options.shard)),
          manifest_(read_clash_manifest(options.manifest)),
          files_(manifest_, options.keep_going) {
        report_.manifest = options.manifest;
        report_.shard = options.shard;
    }

    ClashReport& find() {
        session_.stage("read", [&] { files_.read(session_, options_.operands); });
        session_.stage("prepare", [&] {
            files_.prepare(session_);
            place_parts();
        });
        session_.stage("boxes", [&] { find_candidates(); });
        session_.interruptible_stage("pairs", [&] {
            answer_all();
            return 0;
        });
        report_.missing = files_.missing();
        return report_;
    }
    void write() {
        session_.stage("write", [&] {
            for (const std::string& name : options_.outputs) write_one(name);
            write_pictures();
        });
        if (journal_) journal_->remove();
    }
    [[nodiscard]] const ClashManifest& manifest() const { return manifest_; }
    [[nodiscard]] std::size_t candidates() const { return candidates_.size(); }
    [[nodiscard]] std::size_t files() const { return files_.size(); }

private:
    void place_parts() {
        boxes_.resize(manifest_.parts.size());
        poses_.resize(manifest_.parts.size());
        for_each_in_parallel(boxes_.size(), session_.limits(), [&](std::size_t i) {
            const ClashPart& part = manifest_.parts[i];
            try {
                poses_[i] = Pose::from_doubles(part.pose);
            } catch (const UsageError& e) {
                throw InputError(FilePlace{options_.manifest, 0, 0, 0},
                                 fmt::format("part '{}': {}", part.id, e.what()));
            }
            if (const auto& box = files_.of(part).box) boxes_[i] = posed_box(*box, part.pose);
        });
    }

    // A shard has every so many of the pieces.
    void find_candidates() {
        candidates_ = clash_candidates(manifest_, boxes_);
        pieces_ = (candidates_.size() + piece_size - 1) / piece_size;
    }

    void answer_all() {
        journal_.emplace(options_.outputs.front() + ".journal", run_key(), options_.resume);
        for (std::size_t piece = shard_.number; piece < pieces_; piece += shard_.count) {
            session_.supervisor().enter_stage(
                fmt::format("pairs {}/{}", piece * piece_size, candidates_.size()), 3, 5);
            if (journal_->done(piece) == nullptr) journal_->add(piece, answers_of(piece));
            for (const Json& record : *journal_->done(piece))
                (record.contains("error") ? report_.unanswered : report_.clashes).push_back(record);
        }
    }

    [[nodiscard]] Json answers_of(std::size_t piece) const {
        const std::size_t begin = piece * piece_size;
        const std::size_t n = std::min(piece_size, candidates_.size() - begin);
        std::vector<std::vector<Json>> records(n);
        for_each_in_parallel(n, session_.limits(), [&](std::size_t i) {
            records[i] = answers_of(candidates_[begin + i]);
        });
        Json out = Json::array();
        for (auto& some : records)
            for (Json& record : some) out.push_back(std::move(record));
        return out;
    }
    [[nodiscard]] std::vector<Json> answers_of(const ClashCandidate& pair) const {
        try {
            return clash_records(manifest_, pair, placed(pair.a), placed(pair.b),
                                 {options_.regions, options_.volumes});
        } catch (const Error& e) {
            if (!options_.keep_going || e.code() == ErrorCode::Cancelled ||
                e.code() == ErrorCode::Internal)
                throw;
            Json record;
            record["a"] = manifest_.parts[pair.a].id;
            record["b"] = manifest_.parts[pair.b].id;
            record["error"] = e.what();
            return {record};
        }
    }
    [[nodiscard]] PlacedPart placed(std::uint32_t part) const {
        return {files_.of(manifest_.parts[part]).model, poses_[part], *boxes_[part]};
    }

    [[nodiscard]] std::string run_key() const {
        return clash_id({manifest_.bytes, files_.state(), options_.shard,
                         fmt::format("{} {} {} {} {}", options_.regions, options_.volumes,
                                     options_.keep_going, options_.operands.assume_embedded,
                                     static_cast<int>(options_.operands.winding))});
    }

    void write_one(const std::string& name) {
        switch (format_of(name)) {
            case ReportFormat::Json:
                session_.write_output(name,
                                      clash_json(manifest_, report_)
                                              .dump(1, ' ', false, Json::error_handler_t::replace) +
                                          '\n');
                break;
            case ReportFormat::Csv:
                session_.write_output(name, clash_csv(manifest_, report_));
                break;
            case ReportFormat::Bcf:
                session_.write_output(name, clash_bcf(manifest_, report_, [&](std::size_t i) {
                                          return options_.pictures.empty() ? "" : picture(i);
                                      }));
        }
    }
    void write_pictures() {
        if (options_.pictures.empty()) return;
        fs::create_directories(options_.pictures);
        for (std::size_t i = 0; i < report_.clashes.size(); ++i) {
            const std::string id = report_.clashes[i].at("id").get<std::string>();
            session_.write_output((fs::path(options_.pictures) / (id + ".png")).string(),
                                  picture(i));
        }
    }
    [[nodiscard]] std::string picture(std::size_t clash) const {
        const Json& record = report_.clashes[clash];
        return clash_picture(record, placed(number_of(record.at("a"))),
                             placed(number_of(record.at("b"))));
    }
    [[nodiscard]] std::uint32_t number_of(const Json& id) const {
        const auto at = std::ranges::lower_bound(manifest_.parts, id.get_ref<const std::string&>(),
                                                 {}, &ClashPart::id);
        return static_cast<std::uint32_t>(at - manifest_.parts.begin());
    }

    Session& session_;
    const ClashOptions& options_;
    Shard shard_;
    ClashManifest manifest_;
    ClashFiles files_;
    std::vector<Pose> poses_;
    std::vector<std::optional<Bounds>> boxes_;
    std::vector<ClashCandidate> candidates_;
    std::size_t pieces_ = 0;
    std::optional<ClashJournal> journal_;
    ClashReport report_;
};

std::string answer_text(const ClashManifest& manifest, const ClashReport& report) {
    constexpr std::size_t most_shown = 20;
    std::string out;
    for (std::size_t i = 0; i < std::min(most_shown, report.clashes.size()); ++i)
        out += clash_title(manifest, report.clashes[i]) + "\n";
    if (report.clashes.size() > most_shown)
        out += fmt::format("and {} more\n", report.clashes.size() - most_shown);
    return out;
}

}  // namespace

void add_clash_command(CLI::App& app, ClashOptions& options) {
    CLI::App* command = app.add_subcommand(
        "clash", "all clashes between the parts of an assembly; exit code 1 if there are any");
    command
        ->add_option("MANIFEST", options.manifest,
                     "parts and sets to compare (JSON), or a table of parts (CSV)")
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
    command
        ->add_option("--shard", options.shard,
                     "only part I of N of the pairs: runs may share the work")
        ->type_name("I/N");
    command->add_flag("--resume", options.resume, "go on where a run that was stopped ended");
    command->add_flag("--keep-going", options.keep_going,
                      "leave out what cannot be used, and list it in the report");
    add_operand_options(*command, options.operands);
}

Outcome run_clash(Session& session, const ClashOptions& options) {
    for (const std::string& name : options.outputs) {
        (void)format_of(name);
        check_outputs(session,
                      {options.outputs.front() == name ? "" : options.outputs.front(), name});
    }
    session.plan(5);
    ClashRun run(session, options);
    const ClashReport& report = run.find();
    run.write();
    Outcome out;
    const bool is_complete = report.missing.empty() && report.unanswered.empty();
    out.code = report.clashes.empty() && is_complete ? exit_done : exit_findings;
    out.document = clash_json(run.manifest(), report);
    out.document.erase("clashes");
    out.document["clashes"] = report.clashes.size();
    out.document["files"] = run.files();
    out.document["candidates"] = run.candidates();
    out.document["seconds"] = session.seconds();
    out.answer = answer_text(run.manifest(), report);
    out.remarks = fmt::format("{} parts of {} files, {} pairs of boxes, {} clashes",
                              run.manifest().parts.size(), run.files(), run.candidates(),
                              report.clashes.size());
    if (!is_complete)
        out.remarks += fmt::format("\nincomplete: {} files left out, {} pairs without an answer",
                                   report.missing.size(), report.unanswered.size());
    return out;
}

}  // namespace trisect::app
