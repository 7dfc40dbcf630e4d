// SPDX-License-Identifier: Apache-2.0
//
// Runs one scene with the engine that this program is linked with, and prints one line of JSON:
// what was run, the medians of import, evaluation and export in milliseconds, peak memory, the size
// of the result, and what the engine counted.
//
//     bench_ENGINE --scene b:82k --op union [--runs 5] [--threads 1] [--limit SECONDS] [--profile]
//                  [--clock wall|processor] [--serve] [--write FILE] [--dump FILE]
//                  [--leaf-polygons N]
//
// Import takes plain arrays, export gives plain arrays, reading of files is not timed. In a chain
// the tools' import is import, and all steps together are the evaluation. --limit ends a chain
// after so much time: `steps` then says how far it came; and after so much time no run begins.
// --profile also times making the B-rep.
// --write leaves the result's triangles as OFF.
//
// With --serve the program waits for a line on its standard input before every run and prints one
// line for each; at the end of the input it prints the summary. So a script can let engines take
// turns (scripts/bench-scenes), which is the way to compare on a machine whose speed drifts.

#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <trisect/brep/io/write_mesh.h>

#include "engine.h"
#include "scene.h"
#include "shapes.h"

namespace {

using bench::Engine;
using bench::Operation;
using bench::Scene;
using nlohmann::json;
using trisect::PolygonMesh;

struct Options {
    std::string scene;
    Operation operation = Operation::Union;
    bool operation_given = false;
    int runs = 5;
    bench::EngineOptions engine;
    double limit = 0;
    bool profile = false;
    bool serve = false;
    clockid_t clock = CLOCK_MONOTONIC;
    std::string write;
    std::string dump;
};

/// Milliseconds of wall time or of the processor, all threads together.
class Stopwatch {
public:
    explicit Stopwatch(clockid_t clock) : clock_(clock), start_(now()) {}
    [[nodiscard]] double milliseconds() const { return now() - start_; }

private:
    [[nodiscard]] double now() const {
        timespec t{};
        clock_gettime(clock_, &t);
        return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
    }
    clockid_t clock_;
    double start_;
};

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// A line of /proc/self/status in megabytes: VmRSS now, VmHWM at its highest. (What getrusage calls
/// the peak begins with the memory of the process that started this one.)
double memory_megabytes(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(name + ":")) return std::atof(line.c_str() + name.size() + 1) / 1024;
    return 0;
}
double peak_megabytes() { return memory_megabytes("VmHWM"); }
double resident_megabytes() { return memory_megabytes("VmRSS"); }

/// Making a scene takes more memory than having it: that is given back and forgotten.
void forget_peak_memory() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";
}

/// Of one run, in milliseconds.
struct Times {
    double import = 0;
    double evaluate = 0;
    double to_mesh = 0;
    std::size_t steps = 1;  ///< that were timed
    [[nodiscard]] double total() const { return import + evaluate + to_mesh; }
    [[nodiscard]] json to_json() const {
        return {{"import_ms", import},
                {"evaluate_ms", evaluate},
                {"export_ms", to_mesh},
                {"total_ms", total()},
                {"steps", steps}};
    }
};

/// Steps of a chain that may end early: those of shorter ones are too different to be compared by
/// their mean.
constexpr std::size_t long_chain = 100;

/// How a chain went: the mean time of a step, import of its tool included, and the memory at the
/// end, for each window of steps.
struct Chain {
    std::size_t steps = 0;
    std::size_t window = 0;
    std::vector<double> step_ms;
    std::vector<double> resident_mb;
    double index_ms = 0;  ///< of an indexed scene
};

class Job {
public:
    Job(const Options& options, Engine& engine, Scene scene)
        : options_(options), engine_(engine), scene_(std::move(scene)) {
        forget_peak_memory();
        inputs_mb_ = resident_megabytes();
    }

    Times run() {
        Times t;
        result_ = {};
        body_.reset();
        if (scene_.parts)
            run_parts(t);
        else if (scene_.is_chain())
            run_chain(t);
        else
            run_expression(t);
        counters_ = engine_.counters();
        const Stopwatch watch(options_.clock);
        result_ = engine_.to_mesh(body_);
        t.to_mesh = watch.milliseconds();
        if (times_.empty()) peak_mb_ = peak_megabytes();
        times_.push_back(t);
        return t;
    }

    /// After the last run: the checks of its result need memory and time of their own.
    json summary();

private:
    /// Without export.
    void run_again() {
        Times untaken;
        body_.reset();
        if (scene_.parts)
            run_parts(untaken);
        else if (scene_.is_chain())
            run_chain(untaken);
        else
            run_expression(untaken);
    }
    void run_expression(Times& t);
    void run_chain(Times& t);
    void run_parts(Times& t);
    Times run_step(std::size_t i);
    void check(json& out) const;

    const Options& options_;
    Engine& engine_;
    Scene scene_;
    double inputs_mb_ = 0;
    double peak_mb_ = 0;  ///< after the first run
    std::vector<Times> times_;
    Engine::Body body_;
    PolygonMesh result_;
    Chain chain_;
    json counters_;
    double part_volume_ = 0;  ///< of all parts together
};

void Job::run_expression(Times& t) {
    const Stopwatch import(options_.clock);
    const std::vector<Engine::Body> bodies = engine_.import_all(scene_.operands);
    t.import = import.milliseconds();
    const Stopwatch evaluate(options_.clock);
    const std::span<const Engine::Body> all(bodies);
    const std::size_t first = scene_.first_group_in(options_.operation);
    body_ = engine_.evaluate(all.first(first), all.subspan(first), options_.operation);
    t.evaluate = evaluate.milliseconds();
}

void Job::run_chain(Times& t) {
    const Stopwatch whole(CLOCK_MONOTONIC);
    t.steps = 0;
    chain_ = {};
    chain_.window = std::clamp<std::size_t>(scene_.steps / 10, 1, 1000);
    const Stopwatch import(options_.clock);
    body_ = engine_.import(scene_.operands[0]);
    if (scene_.untimed == 0 && !scene_.indexed) t.import = import.milliseconds();
    if (scene_.indexed) {
        const Stopwatch index(options_.clock);
        engine_.index(body_);
        chain_.index_ms = index.milliseconds();
    }
    double window_ms = 0;
    for (std::size_t i = 0; i < scene_.steps; ++i) {
        if (scene_.steps >= long_chain && options_.limit > 0 &&
            whole.milliseconds() > 1000 * options_.limit)
            break;
        const Times step = run_step(i);
        ++chain_.steps;
        if (i < scene_.untimed) continue;
        ++t.steps;
        t.import += step.import;
        t.evaluate += step.evaluate;
        window_ms += step.total();
        if ((i + 1) % chain_.window != 0) continue;
        chain_.step_ms.push_back(window_ms / static_cast<double>(chain_.window));
        chain_.resident_mb.push_back(resident_megabytes());
        window_ms = 0;
    }
}

Times Job::run_step(std::size_t i) {
    Times t;
    const bench::Step step = scene_.step(i);
    const Stopwatch import(options_.clock);
    const Engine::Body tool = engine_.import(step.tool);
    t.import = import.milliseconds();
    const Stopwatch evaluate(options_.clock);
    body_ = engine_.evaluate({&body_, 1}, {&tool, 1}, step.operation);
    t.evaluate = evaluate.milliseconds();
    return t;
}

void Job::run_parts(Times& t) {
    t.steps = 0;
    chain_ = {};
    const Stopwatch import(options_.clock);
    const Engine::Body whole = engine_.import(scene_.operands[0]);
    t.import = import.milliseconds();
    part_volume_ = 0;
    for (std::size_t i = 0; i < scene_.steps; ++i) {
        const bench::Step step = scene_.step(i);
        const Stopwatch evaluate(options_.clock);
        if (step.planes.empty()) {
            const Engine::Body tool = engine_.import(step.tool);
            body_ = engine_.evaluate({&whole, 1}, {&tool, 1}, step.operation);
        } else {
            body_ = engine_.trimmed(whole, step.planes);
        }
        const PolygonMesh mesh = engine_.to_mesh(body_);
        t.evaluate += evaluate.milliseconds();
        part_volume_ += shapes::size_of(mesh).volume;
        ++t.steps;
        ++chain_.steps;
    }
}

void Job::check(json& out) const {
    const shapes::Size size = shapes::size_of(result_);
    out["vertices"] = result_.points.size();
    out["triangles"] = result_.face_count();
    out["open_edges"] = shapes::open_edges(result_);
    out["volume"] = scene_.parts ? part_volume_ : size.volume;
    out["area"] = size.area;
    out["hash"] = shapes::hash_of(result_);
    const auto wanted = bench::expected(scene_.name, options_.operation);
    if (!wanted || (scene_.is_chain() && chain_.steps != scene_.steps)) return;
    out["volume_is_right"] =
        std::abs(size.volume - wanted->volume) <= wanted->tolerance * std::abs(wanted->volume);
}

json Job::summary() {
    std::size_t triangles = 0;
    for (const PolygonMesh& m : scene_.operands) triangles += m.face_count();
    json out{{"scene", scene_.name},
             {"operation", bench::name_of(options_.operation)},
             {"engine", engine_.name()},
             {"version", engine_.version()},
             {"threads", options_.engine.threads},
             {"clock", options_.clock == CLOCK_MONOTONIC ? "wall" : "processor"},
             {"runs", times_.size()},
             {"operands", scene_.operands.size()},
             {"triangles_in", triangles}};
    const auto median_of = [&](auto part) {
        std::vector<double> values;
        for (const Times& t : times_) values.push_back(part(t));
        return median(values);
    };
    out["import_ms"] = median_of([](const Times& t) { return t.import; });
    out["evaluate_ms"] = median_of([](const Times& t) { return t.evaluate; });
    out["export_ms"] = median_of([](const Times& t) { return t.to_mesh; });
    out["total_ms"] = median_of([](const Times& t) { return t.total(); });
    out["inputs_mb"] = inputs_mb_;
    out["peak_mb"] = peak_mb_;
    if (scene_.is_chain())
        out["chain"] = {{"steps", chain_.steps},     {"of", scene_.steps},
                        {"untimed", scene_.untimed}, {"window", chain_.window},
                        {"step_ms", chain_.step_ms}, {"resident_mb", chain_.resident_mb}};
    if (scene_.indexed) out["index_ms"] = chain_.index_ms;
    out["counters"] = counters_;
    if (options_.profile) {
        const Stopwatch watch(options_.clock);
        if (engine_.assemble(body_)) out["assemble_ms"] = watch.milliseconds();
        for (const auto& [name, which] : {std::pair{"volume_ms", bench::Measure::Volume},
                                          {"area_ms", bench::Measure::Area},
                                          {"bounds_ms", bench::Measure::Bounds}}) {
            // The last run's body may have what a measure left behind: a new one each.
            run_again();
            const Stopwatch measuring(options_.clock);
            if (engine_.measure(body_, which)) out[name] = measuring.milliseconds();
        }
    }
    check(out);
    if (!options_.write.empty()) trisect::write_mesh(options_.write, result_);
    return out;
}

std::optional<Options> parse(int argc, char** argv) {
    Options out;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--serve" || word == "--profile") {
            (word == "--serve" ? out.serve : out.profile) = true;
            continue;
        }
        if (++i == argc) return std::nullopt;
        const std::string value = argv[i];
        if (word == "--scene") {
            out.scene = value;
        } else if (word == "--op") {
            const auto operation = bench::operation_of(value);
            if (!operation) return std::nullopt;
            out.operation = *operation;
            out.operation_given = true;
        } else if (word == "--runs") {
            out.runs = std::atoi(value.c_str());
        } else if (word == "--threads") {
            out.engine.threads = std::atoi(value.c_str());
        } else if (word == "--leaf-polygons") {
            out.engine.leaf_polygons = std::atoi(value.c_str());
        } else if (word == "--limit") {
            out.limit = std::atof(value.c_str());
        } else if (word == "--clock") {
            if (value != "wall" && value != "processor") return std::nullopt;
            out.clock = value == "wall" ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID;
        } else if (word == "--write") {
            out.write = value;
        } else if (word == "--dump") {
            out.dump = value;
        } else {
            return std::nullopt;
        }
    }
    if (out.scene.empty() || out.runs <= 0 || out.engine.threads <= 0) return std::nullopt;
    return out;
}

/// For engines in other languages: a line of JSON, then the points (doubles) and corners (32 bits)
/// of every operand and of every tool.
void dump(const Scene& scene, Operation operation, const std::string& file) {
    std::vector<PolygonMesh> meshes = scene.operands;
    json steps = json::array();
    for (std::size_t i = 0; i < scene.steps; ++i) {
        bench::Step step = scene.step(i);
        steps.push_back(bench::name_of(step.operation));
        meshes.push_back(std::move(step.tool));
    }
    json sizes = json::array();
    for (const PolygonMesh& m : meshes) sizes.push_back({m.points.size(), m.face_count()});
    std::ofstream out(file, std::ios::binary);
    out << json{{"scene", scene.name},
                {"operation", bench::name_of(operation)},
                {"first_group", scene.first_group_in(operation)},
                {"steps", steps},
                {"untimed", scene.untimed},
                {"sizes", sizes}}
        << "\n";
    const auto put = [&](const auto& values) {
        const auto bytes = std::as_bytes(std::span(values));
        out.write(reinterpret_cast<const char*>(bytes.data()),
                  static_cast<std::streamsize>(bytes.size()));
    };
    for (const PolygonMesh& m : meshes) {
        put(m.points);
        put(m.corners);
    }
    if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

void serve(Job& job) {
    std::cout << json{{"ready", true}} << std::endl;
    for (std::string line; std::getline(std::cin, line);)
        std::cout << job.run().to_json() << std::endl;
}

int run(Options options) {
    Scene scene = bench::make_scene(options.scene);
    const auto& operations = scene.operations;
    if (!options.operation_given) options.operation = operations.front();
    if (std::ranges::find(operations, options.operation) == operations.end()) {
        std::cerr << options.scene << " has no " << bench::name_of(options.operation) << "\n";
        return 2;
    }
    if (!options.dump.empty()) {
        dump(scene, options.operation, options.dump);
        return 0;
    }
    const auto engine = bench::make_engine(options.engine);
    Job job(options, *engine, std::move(scene));
    if (options.serve) {
        serve(job);
    } else {
        const Stopwatch whole(CLOCK_MONOTONIC);
        for (int i = 0; i < options.runs; ++i) {
            job.run();
            if (options.limit > 0 && whole.milliseconds() > 1000 * options.limit) break;
        }
    }
    std::cout << job.summary() << std::endl;
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse(argc, argv);
    if (!options) {
        std::cerr
            << "usage: " << argv[0]
            << " --scene NAME [--op union|intersection|difference|xor] [--runs 5] [--threads 1] "
               "[--limit SECONDS] [--profile] [--clock wall|processor] [--serve] [--write "
               "FILE] [--dump FILE]\n";
        return 2;
    }
    try {
        return run(*options);
    } catch (const std::exception& e) {
        std::cout << json{{"scene", options->scene}, {"error", e.what()}} << std::endl;
        return 1;
    }
}
