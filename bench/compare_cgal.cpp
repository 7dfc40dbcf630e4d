// SPDX-License-Identifier: Apache-2.0
//
// Booleans beside CGAL's corefinement with exact points, on identical doubles, in one process and
// on one thread. Ours is timed from arrays to arrays: from_mesh of both operands, evaluate,
// to_mesh; and, beside that, to_brep. The peer's time is building both Surface_meshes and the
// operation; its export is listed and not counted. Runs alternate, the medians are printed.
//
//     compare_cgal [--runs 5] [--json FILE] [--scene NAME]...
//
// Scenes: bunny, armadillo (100k triangles against themselves, turned and moved; in the folder
// large/ of TRISECT_MODELS) and spheres (two of 82k triangles, half a radius apart). The operands
// are put on one lattice first, so that both engines get the same numbers and nothing is rounded.
// Exits with 1 if volume or area of the results differ by more than 1e-9.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <nlohmann/json.hpp>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/validate/defect.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/diagnostics.h>

#include "corefinement.h"
#include "shapes.h"

namespace {

using nlohmann::json;
using trisect::PolygonMesh;
using trisect::Solid;
using Clock = std::chrono::steady_clock;

constexpr std::array names{"union", "intersection", "difference"};

struct Options {
    int runs = 5;
    std::string json_file;
    std::vector<std::string> scenes;
};

struct Scene {
    std::string name;
    PolygonMesh a;
    PolygonMesh b;
};

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// The triangles of the mesh with its points on the lattice.
PolygonMesh on_lattice(const PolygonMesh& mesh, trisect::Lattice lattice) {
    trisect::ImportOptions options;
    options.lattice = lattice;
    const auto imported = trisect::import_mesh(mesh, options);
    PolygonMesh out;
    for (const auto& p : imported.mesh.points)
        out.points.push_back(trisect::to_user(p, imported.mesh.lattice));
    for (const auto& [a, b, c] : imported.mesh.triangles) out.add_triangle(a, b, c);
    return out;
}

Scene scene_of(const std::string& name, PolygonMesh a, PolygonMesh b) {
    auto points = a.points;
    points.insert(points.end(), b.points.begin(), b.points.end());
    const trisect::Lattice lattice = trisect::choose_lattice(points);
    return {name, on_lattice(a, lattice), on_lattice(b, lattice)};
}

/// Nothing when the model is absent.
std::optional<Scene> make_scene(const std::string& name) {
    if (name == "spheres") {
        PolygonMesh sphere = shapes::icosphere(6);
        return scene_of(name, sphere, shapes::moved(sphere, shapes::along_1_2_3(0.5)));
    }
    const char* models = std::getenv("TRISECT_MODELS");
    const std::filesystem::path path =
        std::filesystem::path(models == nullptr ? "../shared/models" : models) / "large" /
        (name == "bunny" ? "bunny100k.obj" : name + ".obj");
    if (!std::filesystem::exists(path)) {
        std::fprintf(stderr, "compare_cgal: %s is absent, set TRISECT_MODELS\n", path.c_str());
        return std::nullopt;
    }
    const PolygonMesh mesh = trisect::read_mesh(path);
    return scene_of(name, mesh, shapes::turned(mesh));
}

trisect::Expression expression(std::size_t operation, const Solid& a, const Solid& b) {
    if (operation == 0) return a | b;
    if (operation == 1) return a & b;
    return a - b;
}

/// Seconds of every run by stage, and what came out.
struct Times {
    std::vector<double> from_mesh, evaluate, to_mesh, to_brep, total;
    std::vector<double> peer_import, peer_operation, peer_export, peer_total;
};

struct Outcome {
    trisect::EvaluateCounters counters;
    int depth = 0;
    PolygonMesh ours;
    PolygonMesh peer;
    std::string refusal;
};

void run_ours(const Scene& scene, std::size_t operation, Times& times, Outcome& outcome) {
    auto start = Clock::now();
    const Solid a = Solid::from_mesh(scene.a);
    const Solid b = Solid::from_mesh(scene.b);
    times.from_mesh.push_back(seconds_since(start));
    start = Clock::now();
    const trisect::Diagnostics<trisect::EvaluateCounters> diagnostics;
    trisect::EvaluateReport report;
    const Solid result = trisect::evaluate(expression(operation, a, b), {}, &report);
    times.evaluate.push_back(seconds_since(start));
    outcome.counters = diagnostics.counters();
    outcome.depth = report.depth;
    start = Clock::now();
    outcome.ours = result.to_mesh();
    times.to_mesh.push_back(seconds_since(start));
    times.total.push_back(times.from_mesh.back() + times.evaluate.back() + times.to_mesh.back());
    start = Clock::now();
    const trisect::Brep brep = result.to_brep();
    times.to_brep.push_back(seconds_since(start));
}

void run_peer(const Scene& scene, std::size_t operation, Times& times, Outcome& outcome) {
    auto answer =
        corefinement::run(scene.a, scene.b, static_cast<corefinement::Operation>(operation));
    times.peer_import.push_back(answer.import_seconds);
    times.peer_operation.push_back(answer.operation_seconds);
    times.peer_export.push_back(answer.export_seconds);
    times.peer_total.push_back(answer.import_seconds + answer.operation_seconds);
    outcome.peer = std::move(answer.mesh);
    outcome.refusal = std::move(answer.refusal);
}

json stats_of(const trisect::EvaluateCounters& s, int depth) {
    return {{"cells", s.cells},
            {"shared_cells", s.shared_cells},
            {"constant_cells", s.constant_cells},
            {"mixed_leaves", s.mixed_leaves},
            {"listed_polygons", s.listed_polygons},
            {"pairs_boxes", s.pairs_boxes},
            {"pairs_cutting", s.pairs_cutting},
            {"pieces", s.pieces},
            {"traces", s.traces},
            {"traces_retried", s.traces_retried},
            {"depth", depth}};
}

double relative(double found, double wanted) {
    return found == wanted ? 0 : std::abs(found - wanted) / std::abs(wanted);
}

json measure(const Scene& scene, std::size_t operation, int runs) {
    Times times;
    Outcome outcome;
    for (int i = 0; i < runs; ++i) {
        run_ours(scene, operation, times, outcome);
        run_peer(scene, operation, times, outcome);
    }
    const shapes::Size ours = shapes::size_of(outcome.ours);
    json out{{"scene", scene.name},
             {"operation", names[operation]},
             {"triangles_in", scene.a.face_count() + scene.b.face_count()},
             {"triangles_out", outcome.ours.face_count()},
             {"runs", runs},
             {"trisect",
              {{"from_mesh", median(times.from_mesh)},
               {"evaluate", median(times.evaluate)},
               {"to_mesh", median(times.to_mesh)},
               {"total", median(times.total)},
               {"to_brep", median(times.to_brep)},
               {"stats", stats_of(outcome.counters, outcome.depth)}}},
             {"cgal",
              {{"import", median(times.peer_import)},
               {"operation", median(times.peer_operation)},
               {"export", median(times.peer_export)},
               {"total", median(times.peer_total)}}}};
    if (outcome.refusal.empty()) {
        const shapes::Size peer = shapes::size_of(outcome.peer);
        out["ratio"] = median(times.peer_total) / median(times.total);
        out["difference"] =
            std::max(relative(ours.volume, peer.volume), relative(ours.area, peer.area));
    } else {
        out["cgal"]["refusal"] = outcome.refusal;
    }
    return out;
}

void print_table(const std::vector<json>& results) {
    std::printf(
        "Milliseconds, medians.\n\n"
        "| scene | operation | triangles in | out | from_mesh | evaluate | to_mesh | total "
        "| to_brep | CGAL import | operation | total | ratio | difference |\n"
        "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const json& r : results) {
        const auto ms = [&](const char* engine, const char* stage) {
            return 1000 * r[engine][stage].get<double>();
        };
        std::printf(
            "| %s | %s | %d | %d | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f "
            "| %.2f | %.0e |\n",
            r["scene"].get<std::string>().c_str(), r["operation"].get<std::string>().c_str(),
            r["triangles_in"].get<int>(), r["triangles_out"].get<int>(), ms("trisect", "from_mesh"),
            ms("trisect", "evaluate"), ms("trisect", "to_mesh"), ms("trisect", "total"),
            ms("trisect", "to_brep"), ms("cgal", "import"), ms("cgal", "operation"),
            ms("cgal", "total"), r.value("ratio", 0.0), r.value("difference", 0.0));
    }
    if (results.empty()) return;
    std::printf("\nWhat evaluate did.\n\n| scene | operation |");
    for (const auto& [name, value] : results[0]["trisect"]["stats"].items())
        std::printf(" %s |", name.c_str());
    std::printf("\n|---|---|");
    for (std::size_t i = 0; i < results[0]["trisect"]["stats"].size(); ++i) std::printf("---:|");
    for (const json& r : results) {
        std::printf("\n| %s | %s |", r["scene"].get<std::string>().c_str(),
                    r["operation"].get<std::string>().c_str());
        for (const auto& [name, value] : r["trisect"]["stats"].items())
            std::printf(" %s |", value.dump().c_str());
    }
    std::printf("\n");
}

std::optional<Options> parse(int argc, char** argv) {
    Options out;
    for (int i = 1; i < argc; i += 2) {
        if (i + 1 == argc) return std::nullopt;
        const std::string word = argv[i];
        if (word == "--runs")
            out.runs = std::atoi(argv[i + 1]);
        else if (word == "--json")
            out.json_file = argv[i + 1];
        else if (word == "--scene")
            out.scenes.emplace_back(argv[i + 1]);
        else
            return std::nullopt;
    }
    if (out.scenes.empty()) out.scenes = {"bunny", "armadillo", "spheres"};
    if (out.runs <= 0) return std::nullopt;
    return out;
}

int run(const Options& options) {
    const oneapi::tbb::global_control one_thread(
        oneapi::tbb::global_control::max_allowed_parallelism, 1);
    std::ofstream lines;
    if (!options.json_file.empty()) lines.open(options.json_file);
    std::vector<json> results;
    bool agree = true;
    for (const std::string& name : options.scenes) {
        const auto scene = make_scene(name);
        if (!scene) continue;
        for (std::size_t operation = 0; operation < names.size(); ++operation) {
            results.push_back(measure(*scene, operation, options.runs));
            if (lines.is_open()) lines << results.back().dump() << std::endl;
            agree = agree && results.back().value("difference", 0.0) <= 1e-9;
        }
    }
    print_table(results);
    return agree ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse(argc, argv);
    if (!options) {
        std::fprintf(stderr, "usage: %s [--runs N] [--json FILE] [--scene NAME]...\n", argv[0]);
        return 2;
    }
    try {
        return run(*options);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "compare_cgal: %s\n", e.what());
        return 1;
    }
}
