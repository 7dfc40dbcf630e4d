// SPDX-License-Identifier: Apache-2.0
//
// A program in OpenSCAD's evaluated form by evaluate_csg() and by Manifold, in one process.
//
//     csg_beside_manifold [--seconds S] [--rounds N] FILE
//
// Prints one JSON object: of either its volume, triangles, the least seconds of processors of up to
// N evaluations in turns with the other one, and the most memory of a process with one evaluation
// alone; or why there is no result. An evaluation begins with the tree that was read, and ends with
// the arrays of a mesh (of a region of the plane: its prism, and Manifold's polygons); files that
// it imports are read again each time. One thread each. S: processor seconds before a process is
// ended.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <trisect/brep/measure.h>
#include <trisect/bsp/csg/csg_evaluate.h>

#include "csg_manifold.h"

namespace {

using Json = nlohmann::ordered_json;

/// Of all threads. The clock of the process is behind where a limit of its seconds is set.
double processor_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

trisect::CsgOptions options() {
    trisect::CsgOptions out;
    out.evaluate.threads = 1;
    out.missing_files_are_empty = true;
    return out;
}

Json by_trisect(const trisect::CsgTree& tree) {
    const double begin = processor_seconds();
    const trisect::Solid solid = trisect::evaluate_csg(tree, options());
    const trisect::PolygonMesh mesh = solid.to_mesh(1);
    const double seconds = processor_seconds() - begin;
    return {{"seconds", seconds},
            {"triangles", mesh.face_count()},
            {"volume", trisect::volume(solid.to_exact_mesh())}};
}

Json by_manifold(const trisect::CsgTree& tree) {
    const double begin = processor_seconds();
    const bench::ManifoldOutcome outcome = bench::evaluate_by_manifold(tree, options());
    const double seconds = processor_seconds() - begin;
    return {{"seconds", seconds},
            {"triangles", outcome.triangles},
            {"volume", outcome.volume},
            {"approximate", outcome.approximate}};
}

/// What `work` returns, in a process of its own; with its most memory in MB, or why it ended.
template <class Work>
Json in_child(unsigned seconds, const Work& work) {
    int ends[2];
    if (pipe(ends) != 0) std::abort();
    const pid_t child = fork();
    if (child == 0) {
        const rlimit limit{seconds, seconds + 1};
        setrlimit(RLIMIT_CPU, &limit);
        Json out;
        try {
            out = work();
        } catch (const std::exception& error) {
            out = {{"error", error.what()}};
        }
        const std::string text = out.dump(-1, ' ', false, Json::error_handler_t::replace);
        const bool written =
            write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
        _exit(written ? 0 : 1);
    }
    close(ends[1]);
    std::string text;
    char part[4096];
    for (ssize_t n = 0; (n = read(ends[0], part, sizeof part)) > 0;)
        text.append(part, static_cast<std::size_t>(n));
    close(ends[0]);
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    if (WIFSIGNALED(status))
        return {{"error", WTERMSIG(status) == SIGXCPU
                              ? "too long"
                              : "signal " + std::to_string(WTERMSIG(status))}};
    Json out = Json::parse(text);
    out["memory"] = static_cast<double>(usage.ru_maxrss) / 1024;
    return out;
}

/// Both in turns, so that what else the machine does is the same for both.
Json in_turns(const trisect::CsgTree& tree, int rounds) {
    double ours = HUGE_VAL;
    double theirs = HUGE_VAL;
    const double begin = processor_seconds();
    for (int i = 0; i < rounds && (i < 2 || processor_seconds() - begin < 4); ++i) {
        ours = std::min(ours, by_trisect(tree)["seconds"].get<double>());
        theirs = std::min(theirs, by_manifold(tree)["seconds"].get<double>());
    }
    return {{"trisect", ours}, {"manifold", theirs}};
}

trisect::CsgTree read_program(const std::string& name) {
    std::ifstream file(name, std::ios::binary);
    return trisect::parse_csg(std::string(std::istreambuf_iterator<char>(file), {}), name);
}

}  // namespace

int main(int argc, char** argv) {
    unsigned seconds = 60;
    int rounds = 5;
    std::string file;
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        if (option == "--seconds" && i + 1 < argc)
            seconds = static_cast<unsigned>(std::atoi(argv[++i]));
        else if (option == "--rounds" && i + 1 < argc)
            rounds = std::atoi(argv[++i]);
        else
            file = option;
    }
    Json out;
    try {
        const trisect::CsgTree tree = read_program(file);
        out["trisect"] = in_child(seconds, [&] { return by_trisect(tree); });
        out["manifold"] = in_child(seconds, [&] { return by_manifold(tree); });
        if (!out["trisect"].contains("error") && !out["manifold"].contains("error")) {
            const Json both = in_child(4 * seconds, [&] { return in_turns(tree, rounds); });
            if (!both.contains("error"))
                for (const char* name : {"trisect", "manifold"}) out[name]["seconds"] = both[name];
        }
    } catch (const std::exception& error) {
        out["error"] = error.what();
    }
    std::printf("%s\n", out.dump(1, ' ', false, Json::error_handler_t::replace).c_str());
    return out.contains("error") ? 1 : 0;
}
