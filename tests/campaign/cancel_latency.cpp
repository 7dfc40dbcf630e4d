// SPDX-License-Identifier: Apache-2.0
//
// How long a call goes on after it was asked to stop:
//
//     cancel_latency [--trials N] [--level L] [--threads T]
//
// Two spheres of 20 · 4^L triangles that cross (L 7: 330,000 each) are imported, validated, united
// and assembled; N times each, another thread sets the flag after a part of the time that the whole
// call takes, and the time until the call is left is noted. Prints a row an operation: the time of
// the whole call, and the median, 99th percentile and largest latency in milliseconds.

#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "bench/shapes.h"

namespace {

using Clock = std::chrono::steady_clock;
using trisect::PolygonMesh;
using trisect::Solid;

struct Options {
    int trials = 100;
    int level = 7;
    std::uint32_t threads = 0;
};

bool parse(int argc, char** argv, Options& o) {
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        if (name == "--trials")
            o.trials = std::atoi(argv[i + 1]);
        else if (name == "--level")
            o.level = std::atoi(argv[i + 1]);
        else if (name == "--threads")
            o.threads = static_cast<std::uint32_t>(std::atoi(argv[i + 1]));
        else
            return false;
    }
    return argc % 2 == 1 && o.trials > 0;
}

double milliseconds(Clock::duration d) {
    return std::chrono::duration<double, std::milli>(d).count();
}

// From the wish to the end of the call; nothing when the call was done before.
bool latency(const std::function<void()>& call, Clock::duration after, double& out) {
    std::atomic<bool> cancel = false;
    Clock::time_point asked;
    std::thread other([&] {
        std::this_thread::sleep_for(after);
        asked = Clock::now();
        cancel = true;
    });
    Clock::time_point left;
    bool stopped = false;
    try {
        const trisect::StopScope scope(&cancel);
        call();
    } catch (const trisect::CancelledError&) {
        stopped = true;
        left = Clock::now();
    }
    other.join();
    if (stopped) out = milliseconds(left - asked);
    return stopped;
}

void measure(const char* name, const Options& o, const std::function<void()>& call) {
    const auto start = Clock::now();
    call();
    const auto whole = Clock::now() - start;
    std::vector<double> times;
    for (int k = 0; k < o.trials; ++k) {
        double ms = 0;
        // Evenly spread over the call, not at its very end.
        if (latency(call, whole * (2 * k + 1) / (2 * o.trials + 2), ms)) times.push_back(ms);
    }
    std::ranges::sort(times);
    const auto at = [&](double part) {
        if (times.empty()) return 0.0;
        return times[std::min(times.size() - 1,
                              static_cast<std::size_t>(part * static_cast<double>(times.size())))];
    };
    std::printf("| %s | %.0f | %zu | %.2f | %.2f | %.2f |\n", name, milliseconds(whole),
                times.size(), at(0.5), at(0.99), times.empty() ? 0.0 : times.back());
    std::fflush(stdout);
}

int run(const Options& o) {
    const PolygonMesh a = shapes::icosphere(o.level);
    const PolygonMesh b = shapes::moved(a, trisect::Point3d{0.3, 0.2, 0.1});
    const std::string text = trisect::format_mesh(a, {.format = trisect::MeshFormat::Obj}).bytes;
    const Solid solid_a = Solid::from_mesh(a);
    const Solid solid_b = Solid::from_mesh(b);
    trisect::EvaluateOptions options;
    options.threads = o.threads;
    const Solid result = evaluate(solid_a | solid_b, options);
    std::printf(
        "| call | whole, ms | stopped | median, ms | p99, ms | largest, ms |\n"
        "|---|---:|---:|---:|---:|---:|\n");
    measure("read OBJ", o,
            [&] { (void)trisect::read_mesh(text, trisect::MeshFormat::Obj, "memory"); });
    measure("import", o, [&] { (void)Solid::from_mesh(a); });
    measure("validate", o, [&] { (void)trisect::validate(a); });
    measure("evaluate", o, [&] { (void)evaluate(solid_a | solid_b, options); });
    measure("to_mesh", o, [&] { (void)result.to_mesh(); });
    measure("to_brep", o, [&] { (void)result.to_brep(); });
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    if (!parse(argc, argv, o)) {
        std::fprintf(stderr, "usage: cancel_latency [--trials N] [--level L] [--threads T]\n");
        return 2;
    }
    return run(o);
}
