// SPDX-License-Identifier: Apache-2.0
//
// mill STOCK TOOL HOLDER --path FILE: the tool's swept steps are subtracted one by one, and after
// each the holder is checked against what is left of the stock and against the fixtures. The first
// collision is named with its step, time, place and faces.
#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <vector>

#include "commands.h"
#include "mesh_files.h"
#include "mill_checkpoint.h"
#include "mill_film.h"
#include "mill_job.h"
#include "mill_page.h"
#include "mill_picture.h"
#include "mill_run.h"
#include "output_name.h"
#include "values.h"

namespace trisect::app {
namespace {

using MillClock = std::chrono::steady_clock;

double seconds_since(MillClock::time_point start) {
    return std::chrono::duration<double>(MillClock::now() - start).count();
}

/// Writes what was done from time to time, so that little is lost whatever ends the program. A
/// checkpoint grows with the run: writing takes a fiftieth of the time at most.
class Checkpoints {
public:
    Checkpoints(Session& session, const MillOptions& options, const MillJob& job)
        : session_(session),
          job_(job),
          name_(options.checkpoint.empty() ? options.resume : options.checkpoint),
          interval_(options.checkpoint_seconds) {}

    void write_if_due(const MillRun& run) {
        if (seconds_since(last_) >= std::max(interval_, 50 * cost_)) write(run);
    }
    void write(const MillRun& run) {
        if (name_.empty()) return;
        const MillClock::time_point start = MillClock::now();
        session_.write_output(name_, checkpoint_text(job_, run));
        last_ = MillClock::now();
        cost_ = seconds_since(start);
    }
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    Session& session_;
    const MillJob& job_;
    std::string name_;
    double interval_;
    double cost_ = 0;
    MillClock::time_point last_ = MillClock::now();
};

/// Frames for the page, at steps of equal distance, and the last one.
class FilmCrew {
public:
    FilmCrew(const MillJob& job, const MillOptions& options)
        : job_(job), film_(options.page_bytes), is_on_(!options.page.empty()) {
        const std::size_t steps = job.steps.size();
        const std::size_t count = std::clamp<std::size_t>(options.frames, 2, MillFilm::most_frames);
        for (std::size_t i = 0; i < count; ++i) due_.push_back(i * steps / (count - 1));
    }
    /// After each step, and before the first one.
    void look(const MillRun& run) {
        if (!is_on_ || next_ == due_.size() || run.done() < due_[next_]) return;
        while (next_ + 1 < due_.size() && due_[next_ + 1] <= run.done()) ++next_;
        if (film_.wants(next_)) take(run);
        ++next_;
    }
    void look_last(const MillRun& run) {
        if (is_on_ && (film_.frames().empty() || film_.frames().back() != run.done())) take(run);
    }
    [[nodiscard]] const MillFilm& film() const { return film_; }
    [[nodiscard]] double seconds() const { return seconds_; }

private:
    void take(const MillRun& run) {
        const MillClock::time_point start = MillClock::now();
        MeshMap map;
        const PolygonMesh mesh = run.stock().to_mesh(map);
        film_.add(mesh, map, run.done(),
                  [this](std::uint32_t source) { return source != job_.stock_source; });
        seconds_ += seconds_since(start);
    }
    const MillJob& job_;
    MillFilm film_;
    bool is_on_;
    std::vector<std::size_t> due_;
    std::size_t next_ = 0;
    double seconds_ = 0;
};

void show_step(Session& session, const MillRun& run, const MillJob& job, const char* what) {
    if (run.done() % 16 != 0) return;
    session.supervisor().enter_stage(
        fmt::format("{} step {} of {}", what, run.done(), job.steps.size()),
        static_cast<int>(run.done()), static_cast<int>(job.steps.size()));
}

/// Repeats what a checkpoint has, and does the other steps until the end or a collision.
void mill_all(Session& session, const MillOptions& options, const MillJob& job, MillRun& run,
              FilmCrew& crew, Checkpoints& checkpoints) {
    crew.look(run);
    if (!options.resume.empty()) {
        const MillCheckpoint checkpoint = read_checkpoint(options.resume, job);
        for (const MillRecord& record : checkpoint.records) {
            detail::check_stop();
            run.repeat(record);
            crew.look(run);
            show_step(session, run, job, "repeating");
        }
        run.add_collisions(checkpoint.collisions);
    }
    try {
        while (!run.is_finished() && (options.keep_going || !run.has_collision())) {
            detail::check_stop();
            run.step();
            crew.look(run);
            checkpoints.write_if_due(run);
            show_step(session, run, job, "milling");
        }
    } catch (const Error&) {
        checkpoints.write(run);
        if (!checkpoints.name().empty())
            session.note(fmt::format("{} has the first {} steps (--resume)", checkpoints.name(),
                                     run.done()));
        throw;
    }
    checkpoints.write(run);
    crew.look_last(run);
}

/// The boundary with maximal faces is a function of the set: an interrupted run writes the same
/// bytes as one that was not.
void write_stock(Session& session, const MillOptions& options, const MillRun& run) {
    const Brep brep = run.stock().to_brep();
    if (has_exact_boundary(options.output))
        return session.write_output(options.output, exact_text(brep));
    const MeshFormat format = output_format(session, options.output);
    (void)write_output_mesh(session, options.output, format,
                            output_polygons(brep, format, nullptr));
}

Json statistics(const std::vector<MillRecord>& records, double MillTimes::*member) {
    std::vector<double> all;
    for (const MillRecord& r : records) all.push_back(r.times.*member);
    std::sort(all.begin(), all.end());
    double sum = 0;
    for (const double t : all) sum += t;
    Json out;
    const auto n = all.size();
    out["mean"] = n == 0 ? 0 : sum / static_cast<double>(n);
    out["median"] = n == 0 ? 0 : all[n / 2];
    out["p99"] = n == 0 ? 0 : all[n * 99 / 100];
    out["worst"] = n == 0 ? 0 : all.back();
    return out;
}

Json times_json(const MillRun& run) {
    Json out;
    out["sweep"] = statistics(run.records(), &MillTimes::sweep);
    out["cut"] = statistics(run.records(), &MillTimes::cut);
    out["volume"] = statistics(run.records(), &MillTimes::volume);
    out["check"] = statistics(run.records(), &MillTimes::check);
    return out;
}

std::string answer_of(const MillJob& job, const MillRun& run) {
    std::string out;
    for (const Json& c : run.collisions()) out += collision_text(c, job.steps.size());
    if (run.collisions().empty()) out = fmt::format("no collision in {} steps\n", job.steps.size());
    return out;
}

std::string mill_remarks(const Session& session, const MillJob& job, const MillRun& run,
                         const FilmCrew& crew) {
    const Json times = times_json(run);
    const auto mean = [&](const char* name) { return times[name]["mean"].get<double>(); };
    double total = 0;
    for (const auto& seconds : session.seconds()) total += seconds.get<double>();
    std::string out =
        fmt::format("steps        {} of {}, {} moves, {} arcs in chords\n", run.done(),
                    job.steps.size(), job.path.moves.size(), job.path.arcs);
    out += fmt::format("grid         2^{}; tool and positions moved by at most {}\n",
                       job.grid.exponent(), number_text(job.grid.max_move()));
    out += fmt::format("removed      {} of {}\n", number_text(run.removed()),
                       number_text(job.stock_volume));
    out += fmt::format(
        "a step       {:.3f} ms: sweep {:.3f}, cut {:.3f}, volume {:.3f}, checks {:.3f}\n",
        mean("sweep") + mean("cut") + mean("volume") + mean("check"), mean("sweep"), mean("cut"),
        mean("volume"), mean("check"));
    if (!crew.film().frames().empty())
        out += fmt::format("page         {} frames{}, {} triangles\n", crew.film().frames().size(),
                           crew.film().has_dropped() ? " (fewer, for its size)" : "",
                           crew.film().triangles().size());
    return out + fmt::format("time         {:.3f} s", total);
}

Json mill_document(const Session& session, const MillOptions& options, const MillJob& job,
                   const MillRun& run, const FilmCrew& crew) {
    Json out;
    out["schema"] = "trisect.mill/1";
    out.update(job.facts);
    out["steps_done"] = run.done();
    out["finished"] = run.is_finished();
    out["stock_volume"] = job.stock_volume;
    out["removed"] = run.removed();
    out["collisions"] = run.collisions();
    out["milliseconds"] = times_json(run);
    if (!options.page.empty())
        out["page"] = {{"file", options.page},
                       {"frames", crew.film().frames()},
                       {"triangles", crew.film().triangles().size()},
                       {"seconds", crew.seconds()}};
    if (!options.output.empty()) out["output"] = options.output;
    out["seconds"] = session.seconds();
    return out;
}

double positive(const std::string& text, const char* what) {
    const double value = parse_number(text, what);
    if (!(value > 0)) throw UsageError(std::string(what) + ": must be positive");
    return value;
}

void add_number(CLI::App& command, const char* name, double& value, const char* help,
                const char* type) {
    command
        .add_option_function<std::string>(
            name, [&value, name](const auto& s) { value = positive(s, name); }, help)
        ->type_name(type);
}

void add_mill_outputs(CLI::App& command, MillOptions& o) {
    const auto add = [&](const char* name, std::string& file, const char* help) {
        command.add_option(name, file, help)->type_name("FILE");
    };
    add("-o,--output", o.output, "the stock after the last step; also .exact, without loss");
    add("--page", o.page, "a self-contained HTML page of the stock over time");
    add("--picture", o.picture, "a picture (PNG) of the stock, and of the holder at a collision");
    add("--log", o.log, "a table (CSV) with a line a step");
    add("--checkpoint", o.checkpoint, "what was done so far, written from time to time");
    add("--resume", o.resume,
        "a checkpoint to go on from; it is also written, unless --checkpoint "
        "names another file");
    add_number(command, "--checkpoint-seconds", o.checkpoint_seconds,
               "between checkpoints (default 2)", "S");
    command
        .add_option_function<std::string>(
            "--frames",
            [&o](const auto& s) {
                const std::int64_t n = parse_integer(s, "--frames");
                if (n < 2 || n > static_cast<std::int64_t>(MillFilm::most_frames))
                    throw UsageError("--frames: must be from 2 to 250");
                o.frames = static_cast<std::uint64_t>(n);
            },
            "versions of the stock on the page (default 60)")
        ->type_name("N");
    command
        .add_option_function<std::string>(
            "--page-bytes", [&o](const auto& s) { o.page_bytes = parse_bytes(s, "--page-bytes"); },
            "the page has fewer frames where it would be larger (default 60M)")
        ->type_name("BYTES[KMGT]");
}

void check_mill_options(const Session& session, const MillOptions& o) {
    for (const std::string& name : {o.stock, o.tool, o.holder})
        if (name == "-") throw UsageError("mill reads its meshes from files");
    if (o.path == "-")
        for (const std::string& name : {o.checkpoint, o.resume})
            if (!name.empty()) throw UsageError("a path from the standard input cannot be resumed");
    check_output_name(session, o.page, ".html");
    check_output_name(session, o.picture, ".png");
    check_output_name(session, o.log, ".csv");
    if (!o.output.empty() && !has_exact_boundary(o.output)) (void)output_format(session, o.output);
    check_outputs(session, {o.output, o.page, o.picture, o.log, o.checkpoint}, Answer::Printed);
}

}  // namespace

void add_mill_command(CLI::App& app, MillOptions& o) {
    CLI::App* command = app.add_subcommand(
        "mill", "cut a tool path into a stock, with collision checks; exit code 1 at a collision");
    command->add_option("STOCK", o.stock, "mesh file")->required();
    command
        ->add_option("TOOL", o.tool, "mesh of convex shells; its tip is the origin, its axis is z")
        ->required();
    command->add_option("HOLDER", o.holder, "mesh file in the tool's coordinates")->required();
    command
        ->add_option("--path", o.path,
                     "G-code (G0 to G3), or, named *.poses, lines of twelve numbers, those of "
                     "rapid moves after the word rapid")
        ->required()
        ->type_name("FILE");
    command->add_option("--fixture", o.fixtures, "mesh that neither tool nor holder may meet")
        ->type_name("FILE")
        ->allow_extra_args(false);
    add_number(*command, "--chord", o.chord, "how far chords may be from arcs (default 0.01)", "D");
    add_number(*command, "--feed", o.feed, "where the path has none yet, a minute (default 1000)",
               "F");
    add_number(*command, "--rapid-feed", o.rapid_feed, "of rapid moves, a minute (default 10000)",
               "F");
    command
        ->add_option_function<std::string>(
            "--grid",
            [&o](const auto& s) {
                const std::int64_t e = parse_integer(s, "--grid");
                if (e % 8 != 0 || e < -1200 || e > 1016)
                    throw UsageError(
                        "--grid: the exponent must be a multiple of 8 from -1200 to 1016");
                o.grid = static_cast<int>(e);
            },
            "tool corners and positions are multiples of 2^E (default: some 30 bits of the extent)")
        ->type_name("E");
    command->add_flag("--touch", o.touch, "contact of the holder, and with fixtures, counts too");
    command->add_flag("!--ends-only", o.between,
                      "check the holder at the ends of moves only; else it is of convex shells");
    command->add_flag("--keep-going", o.keep_going, "list all collisions");
    add_mill_outputs(*command, o);
    add_operand_options(*command, o.operands);
}

Outcome run_mill(Session& session, const MillOptions& options) {
    check_mill_options(session, options);
    session.plan(6);
    const MillJob job = session.stage("read", [&] { return read_mill_job(session, options); });
    MillRun run(job, options);
    FilmCrew crew(job, options);
    Checkpoints checkpoints(session, options, job);
    session.interruptible_stage("mill", [&] {
        mill_all(session, options, job, run, crew, checkpoints);
        return 0;
    });
    session.stage("write", [&] {
        if (!options.output.empty()) write_stock(session, options, run);
        if (!options.log.empty()) session.write_output(options.log, step_table(job, run));
    });
    if (!options.page.empty())
        session.stage(
            "page", [&] { session.write_output(options.page, page_text(job, run, crew.film())); });
    if (!options.picture.empty())
        session.stage("picture",
                      [&] { session.write_output(options.picture, picture_of_run(job, run)); });
    Outcome out;
    out.code = run.has_collision() ? exit_findings : exit_done;
    out.document = mill_document(session, options, job, run, crew);
    out.answer = answer_of(job, run);
    out.remarks = mill_remarks(session, job, run, crew);
    return out;
}

}  // namespace trisect::app
