// SPDX-License-Identifier: Apache-2.0
//
// Splits by a solid and by a plane: one call, two evaluations, and Manifold's Split and
// SplitByPlane, where there is Manifold, in turns in one process.
//
//     split_beside_manifold [--rounds N] [--only one|two|manifold] CASE...
//
// A case is a scene of two operands (b:82k; an operand and its first tool, c:82k), or a mesh file
// with a plane behind a '@' (part.stl@0,0,1,-2 or part.stl@z, which is through the middle of its
// box), or with a number of slabs across z (part.stl@50), which Manifold gets as so many cuts by a
// plane. Prints a row for each: triangles of the operands and of both parts, least processor
// milliseconds of `rounds` turns with one thread: of the evaluation, and from arrays to arrays.
// With --only one way is gone through once, for counting its instructions:
//
//     valgrind --tool=callgrind --instr-atstart=no --collect-atstart=no split_beside_manifold
//         --only one b:82k
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/split.h>

#include "instructions.h"
#include "scene.h"

#ifdef TRISECT_BENCH_HAS_MANIFOLD
#include <manifold/manifold.h>
#endif

namespace {

using trisect::PolygonMesh;
using trisect::Solid;

enum class Way { Two, One, Manifold };

struct SplitJob {
    std::string name;
    PolygonMesh first;
    std::optional<PolygonMesh> second;
    std::vector<std::array<double, 4>> planes;
};

struct Times {
    double evaluation = std::numeric_limits<double>::infinity();
    double whole = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> triangles;
};

double processor_milliseconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

trisect::EvaluateOptions one_thread() {
    trisect::EvaluateOptions options;
    options.threads = 1;
    return options;
}

// Each part by an evaluation of its own.
std::vector<Solid> evaluate_way_two(const SplitJob& job, const std::vector<Solid>& solids) {
    std::vector<Solid> out;
    if (job.second) {
        out.push_back(evaluate(solids[0] & solids[1], one_thread()));
        out.push_back(evaluate(solids[0] - solids[1], one_thread()));
        return out;
    }
    std::vector<Solid> below;
    for (const auto& plane : job.planes) below.push_back(Solid::half_space(plane));
    for (std::size_t i = 0; i <= below.size(); ++i) {
        trisect::Expression part = solids[0];
        if (i < below.size()) part = part & below[i];
        if (i > 0) part = part - below[i - 1];
        out.push_back(evaluate(part, one_thread()));
    }
    return out;
}

std::vector<Solid> evaluate_way_one(const SplitJob& job, const std::vector<Solid>& solids) {
    if (!job.second) return split(solids[0], job.planes, one_thread());
    trisect::SplitSolid parts = split(solids[0], solids[1], one_thread());
    return {std::move(parts.common), std::move(parts.rest)};
}

void run_ours(const SplitJob& job, Way way, Times& times, const CallgrindParts& counted) {
    trisect::SolidOptions import;
    import.import.threads = 1;
    const double begin = processor_milliseconds();
    std::vector<Solid> solids{Solid::from_mesh(job.first, import)};
    if (job.second) solids.push_back(Solid::from_mesh(*job.second, import));
    const double imported = processor_milliseconds();
    std::vector<Solid> parts;
    counted.count("evaluation", [&] {
        parts = way == Way::One ? evaluate_way_one(job, solids) : evaluate_way_two(job, solids);
    });
    const double evaluated = processor_milliseconds();
    times.triangles.clear();
    counted.count("meshes", [&] {
        for (const Solid& part : parts) times.triangles.push_back(part.to_mesh(1).face_count());
    });
    times.whole = std::min(times.whole, processor_milliseconds() - begin);
    times.evaluation = std::min(times.evaluation, evaluated - imported);
}

#ifdef TRISECT_BENCH_HAS_MANIFOLD
manifold::Manifold manifold_of(const PolygonMesh& mesh) {
    manifold::MeshGL64 arrays;
    arrays.numProp = 3;
    for (const trisect::Point3d& p : mesh.points)
        arrays.vertProperties.insert(arrays.vertProperties.end(), p.begin(), p.end());
    arrays.triVerts.assign(mesh.corners.begin(), mesh.corners.end());
    return manifold::Manifold(arrays);
}

std::vector<manifold::Manifold> evaluate_way_manifold(
    const SplitJob& job, const std::vector<manifold::Manifold>& solids) {
    if (job.second) {
        auto parts = solids[0].Split(solids[1]);
        static_cast<void>(parts.first.NumTri() + parts.second.NumTri());
        return {parts.first, parts.second};
    }
    std::vector<manifold::Manifold> out;
    manifold::Manifold rest = solids[0];
    for (const auto& p : job.planes) {
        const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        auto parts = rest.SplitByPlane({p[0], p[1], p[2]}, -p[3] / length);
        static_cast<void>(parts.first.NumTri() + parts.second.NumTri());
        out.push_back(parts.second);
        rest = parts.first;
    }
    out.push_back(rest);
    return out;
}

void run_manifold(const SplitJob& job, Times& times) {
    const double begin = processor_milliseconds();
    std::vector<manifold::Manifold> solids{manifold_of(job.first)};
    if (job.second) solids.push_back(manifold_of(*job.second));
    for (const auto& m : solids) static_cast<void>(m.NumTri());
    const double imported = processor_milliseconds();
    const auto parts = evaluate_way_manifold(job, solids);
    const double evaluated = processor_milliseconds();
    times.triangles.clear();
    for (const auto& part : parts) times.triangles.push_back(part.GetMeshGL64().NumTri());
    times.whole = std::min(times.whole, processor_milliseconds() - begin);
    times.evaluation = std::min(times.evaluation, evaluated - imported);
}
#else
void run_manifold(const SplitJob&, Times&) {}
#endif

void run(const SplitJob& job, Way way, Times& times, const CallgrindParts& counted) {
    if (way == Way::Manifold)
        run_manifold(job, times);
    else
        run_ours(job, way, times, counted);
}

std::vector<std::array<double, 4>> planes_of(const std::string& text, const PolygonMesh& mesh) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const auto& p : mesh.points) {
        low = std::min(low, p[2]);
        high = std::max(high, p[2]);
    }
    if (text == "z") return {{0, 0, 1, -(low + high) / 2}};
    std::vector<std::array<double, 4>> out;
    if (text.find(',') == std::string::npos) {
        const int n = std::atoi(text.c_str());
        for (int i = 1; i < n; ++i) out.push_back({0, 0, 1, -(low + (high - low) * i / n)});
        return out;
    }
    std::array<double, 4> plane{};
    const char* at = text.c_str();
    for (double& c : plane) {
        char* end = nullptr;
        c = std::strtod(at, &end);
        at = *end == ',' ? end + 1 : end;
    }
    out.push_back(plane);
    return out;
}

SplitJob job_of(const std::string& name) {
    SplitJob job;
    job.name = name;
    const std::size_t at = name.find('@');
    if (at != std::string::npos) {
        job.first = trisect::read_mesh(name.substr(0, at));
        job.planes = planes_of(name.substr(at + 1), job.first);
        return job;
    }
    bench::Scene scene = bench::make_scene(name);
    job.first = std::move(scene.operands.at(0));
    job.second = scene.is_chain() ? scene.step(scene.untimed).tool : scene.operands.at(1);
    return job;
}

void print(const SplitJob& job, const std::array<Times, 3>& times) {
    std::size_t ours = 0;
    for (const std::size_t n : times[1].triangles) ours += n;
    std::printf("| %s | %zu | %zu |", job.name.c_str(),
                job.first.face_count() + (job.second ? job.second->face_count() : 0), ours);
    for (const Times& t : times) {
        if (t.triangles.empty())
            std::printf(" | |");
        else
            std::printf(" %.3g | %.3g |", t.evaluation, t.whole);
    }
    std::printf(" %.2f | %.2f |", times[0].evaluation / times[1].evaluation,
                times[0].whole / times[1].whole);
    if (!times[2].triangles.empty()) std::printf(" %.1f", times[2].whole / times[1].whole);
    std::printf(" |\n");
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
    int rounds = 5;
    std::optional<Way> only;
    std::vector<std::string> names;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--rounds" && i + 1 < argc) {
            rounds = std::atoi(argv[++i]);
        } else if (word == "--only" && i + 1 < argc) {
            const std::string way = argv[++i];
            only = way == "one" ? Way::One : way == "two" ? Way::Two : Way::Manifold;
        } else {
            names.push_back(word);
        }
    }
    if (!only)
        std::printf(
            "| case | triangles | of the parts | two: evaluation | arrays | one: evaluation | "
            "arrays | Manifold: evaluation | arrays | two : one, evaluation | arrays | Manifold : "
            "one |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    CallgrindParts counted;
    if (only) counted.begin();
    for (const std::string& name : names) {
        const SplitJob job = job_of(name);
        std::array<Times, 3> times;
        for (int i = 0; i < (only ? 1 : rounds); ++i)
            for (const Way way : {Way::Two, Way::One, Way::Manifold})
                if (!only || *only == way)
                    run(job, way, times[static_cast<std::size_t>(way)], counted);
        if (!only) print(job, times);
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
