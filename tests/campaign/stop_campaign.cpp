// SPDX-License-Identifier: Apache-2.0
//
// Calls that are stopped at random places, on several threads:
//
//     stop_campaign [--seed N] [--stops N] [--threads N]... [--call NAME]... [--kind NAME]...
//                   [--level L]
//
// For each call (import, evaluate, resolve, nary, mesh, brep, refine, index, interference, scene),
// each kind of stop and each number of threads: runs the call until it was stopped N times, each
// time at another place:
//
//   cancel     another thread sets the flag after a random part of the time that the call takes
//   work       a StopScope with a random part of the work
//   memory     a StopScope with a random part of what the call holds
//   exception  a random allocation, of whichever thread, throws std::bad_alloc
//
// A stopped call must end in the error of its kind. After every eighth stop the same call runs to
// its end on the same operands and must give the bytes that it gave at first. Blocks of memory that
// are not given back are counted: what the library keeps for the next call stays small, a leak
// grows with the stops. Prints a row for each case and leaves with 1 when something was wrong.

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <future>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include <trisect/brep/io/exact_boundary.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/interference_scene.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/stop_scope.h>

#include "bench/shapes.h"
#include "support/failing_new.h"

namespace {

using trisect::EvaluateOptions;
using trisect::PolygonMesh;
using trisect::Pose;
using trisect::Solid;
using trisect::test::allocations_anywhere;
using trisect::test::live_blocks_anywhere;
using Clock = std::chrono::steady_clock;

enum class Kind : std::uint8_t { Cancel, Work, Memory, Exception };
constexpr std::array<const char*, 4> kind_names{"cancel", "work", "memory", "exception"};

// What a run is limited by.
struct Limits {
    std::uint32_t threads = 1;
    trisect::StopLimits stop = {};

    [[nodiscard]] EvaluateOptions evaluation() const {
        EvaluateOptions options;
        options.threads = threads;
        return options;
    }
};

// The bytes of a result, as one number (FNV-1a).
class Digest {
public:
    void add(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3ULL;
    }
    template <class T>
    void add_all(const std::vector<T>& values) {
        add(values.data(), values.size() * sizeof(T));
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

std::uint64_t digest_of(const PolygonMesh& mesh) {
    Digest digest;
    digest.add_all(mesh.points);
    digest.add_all(mesh.corners);
    return digest.value();
}

std::uint64_t digest_of(const std::string& text) {
    Digest digest;
    digest.add(text.data(), text.size());
    return digest.value();
}

// Sees to the limits of a result too, so that a digest is never taken of what was stopped.
std::uint64_t digest_of(const Solid& solid) { return digest_of(solid.to_mesh(1)); }

/// A call on operands that it must leave as they are.
struct Call {
    const char* name;
    std::function<std::uint64_t(const Limits&)> run;
    bool counts_work = false;    ///< looks at StopLimits::max_work
    bool counts_memory = false;  ///< looks at StopLimits::max_memory
};

Solid sphere(int level, const trisect::Point3d& by) {
    return Solid::from_mesh(shapes::moved(shapes::icosphere(level), by));
}

std::vector<Call> calls(int level) {
    const PolygonMesh mesh = shapes::icosphere(level + 1);
    const Solid a = sphere(level, {0, 0, 0});
    const Solid b = sphere(level, shapes::along_1_2_3(0.7));
    const Solid c = sphere(level, {-0.4, 0.31, 0.2});
    // Cells with few polygons are no tasks of their own.
    const Solid large_a = sphere(level + 1, {0, 0, 0});
    const Solid large_b = sphere(level + 1, shapes::along_1_2_3(0.7));
    const Solid large_c = sphere(level + 1, {-0.4, 0.31, 0.2});
    PolygonMesh crossing = shapes::icosphere(level);
    shapes::append(crossing, shapes::moved(shapes::icosphere(level), {0.51, 0.32, 0.13}));
    const Solid unresolved =
        Solid::from_mesh(crossing, {.import = {}, .embedding = trisect::Embedding::Resolve});
    const Solid cut = evaluate(a - b - c);

    std::vector<Call> all;
    all.push_back({"import",
                   [mesh](const Limits& limits) {
                       trisect::SolidOptions options;
                       options.import.threads = limits.threads;
                       return digest_of(Solid::from_mesh(mesh, options));
                   },
                   true});
    all.push_back(
        {"evaluate",
         [a, b](const Limits& limits) { return digest_of(evaluate(a | b, limits.evaluation())); },
         true, true});
    all.push_back({"resolve",
                   [a, unresolved](const Limits& limits) {
                       return digest_of(evaluate(unresolved - a, limits.evaluation()));
                   },
                   true, true});
    all.push_back({"nary",
                   [large_a, large_b, large_c](const Limits& limits) {
                       return digest_of(
                           evaluate((large_a ^ large_b) - large_c, limits.evaluation()));
                   },
                   true, true});
    all.push_back({"mesh",
                   [cut](const Limits& limits) { return digest_of(cut.to_mesh(limits.threads)); },
                   true});
    all.push_back({"brep",
                   [a, b](const Limits& limits) {
                       // In a thread without a scope: what is stopped comes after it.
                       const auto intersect = [&] { return evaluate(a & b, limits.evaluation()); };
                       const Solid result = std::async(std::launch::async, intersect).get();
                       return digest_of(trisect::exact_text(result.to_brep()));
                   },
                   true});
    all.push_back({"refine", [mesh](const Limits& limits) {
                       const Solid solid = Solid::from_mesh(mesh);
                       solid.refine(limits.threads);
                       return digest_of(solid);
                   }});
    std::vector<std::array<double, 3>> points;
    shapes::Random random(7);
    for (int i = 0; i < 5'000; ++i) {
        const trisect::Point3d p = random.in_unit_box();
        points.push_back({2.2 * p[0] - 1.1, 2.2 * p[1] - 1.1, 2.2 * p[2] - 1.1});
    }
    all.push_back({"index",
                   [cut, points](const Limits& limits) {
                       const trisect::BrepIndex index(cut);
                       std::vector<trisect::Location> places(points.size());
                       index.classify(points, places, limits.threads);
                       Digest digest;
                       digest.add_all(places);
                       return digest.value();
                   },
                   true});
    all.push_back({"interference",
                   [a, cut](const Limits&) {
                       const trisect::InterferenceModel first(cut);
                       const trisect::InterferenceModel second(a);
                       const auto result = interfere(first, Pose(), second, Pose());
                       return static_cast<std::uint64_t>(result.relation) +
                              16 * result.contacts.size();
                   },
                   true});
    const trisect::InterferenceModel model{sphere(2, {0, 0, 0})};
    all.push_back(
        {"scene", [model](const Limits& limits) {
             trisect::Scene scene;
             for (int i = 0; i < 60; ++i) {
                 const auto at = [&](int k) { return static_cast<double>((i * k) % 97) * 0.0625; };
                 scene.add(model, Pose::from_translation({at(31), at(17), at(53)}));
             }
             const auto pairs = scene.interfering({.contacts = true, .threads = limits.threads});
             Digest digest;
             for (const auto& p : pairs) {
                 digest.add(&p.a.index, sizeof p.a.index);
                 digest.add(&p.b.index, sizeof p.b.index);
                 const std::size_t n = p.contacts.size();
                 digest.add(&n, sizeof n);
             }
             return digest.value();
         }});
    return all;
}

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t stops = 20;
    int level = 4;
    std::vector<std::uint32_t> threads;
    std::vector<std::string> calls;
    std::vector<std::string> kinds;
};

bool parse(int argc, char** argv, Options& o) {
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        const char* value = argv[i + 1];
        if (name == "--seed")
            o.seed = std::strtoull(value, nullptr, 10);
        else if (name == "--stops")
            o.stops = std::strtoull(value, nullptr, 10);
        else if (name == "--level")
            o.level = std::atoi(value);
        else if (name == "--threads")
            o.threads.push_back(static_cast<std::uint32_t>(std::atoi(value)));
        else if (name == "--call")
            o.calls.emplace_back(value);
        else if (name == "--kind")
            o.kinds.emplace_back(value);
        else
            return false;
    }
    if (o.threads.empty()) o.threads = {2, 4, 8};
    return argc % 2 == 1;
}

bool is_wanted(const std::vector<std::string>& names, const char* name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

enum class Outcome : std::uint8_t { Finished, Stopped, Wrong };

// One call and one kind of stop on one number of threads.
class Case {
public:
    Case(const Call& call, Kind kind, std::uint32_t threads, shapes::Random& random)
        : call_(call), kind_(kind), threads_(threads), random_(random) {
        const Limits free{.threads = threads_};
        expected_ = call_.run(free);
        const auto start = Clock::now();
        const std::int64_t allocated = allocations_anywhere();
        trisect::StopScope counting(nullptr);
        if (call_.run(free) != expected_) wrong("another result");
        seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
        allocations_ = allocations_anywhere() - allocated;
        work_ = std::max<std::uint64_t>(counting.work(), 1'000);
    }

    // False when something was wrong.
    bool run(std::uint64_t stops) {
        const std::int64_t live = live_blocks_anywhere();
        std::uint64_t stopped = 0;
        std::uint64_t finished = 0;
        const std::uint64_t most = 20 * stops + 100;
        while (stopped < stops && stopped + finished < most && good_) {
            switch (stop_once()) {
                case Outcome::Finished:
                    ++finished;
                    break;
                case Outcome::Stopped:
                    ++stopped;
                    break;
                case Outcome::Wrong:
                    good_ = false;
                    break;
            }
            if (stopped % 8 == 0 && call_.run({.threads = threads_}) != expected_)
                wrong("another result after a stop");
        }
        if (call_.run({.threads = threads_}) != expected_) wrong("another result at the end");
        const std::int64_t kept = live_blocks_anywhere() - live;
        // Caches of threads that came later, a worker's scratch memory: bounded.
        if (kept > 2'000 + static_cast<std::int64_t>(stops / 4)) wrong("blocks are not given back");
        std::printf("| %-12s | %-9s | %u | %8.2f | %llu | %llu | %lld | %s |\n", call_.name,
                    kind_names[static_cast<std::size_t>(kind_)], threads_, 1e3 * seconds_,
                    static_cast<unsigned long long>(stopped),
                    static_cast<unsigned long long>(finished), static_cast<long long>(kept),
                    good_ ? "good" : "WRONG");
        std::fflush(stdout);
        return good_;
    }

private:
    void wrong(const char* what) {
        std::fprintf(stderr, "%s, %s, %u threads: %s\n", call_.name,
                     kind_names[static_cast<std::size_t>(kind_)], threads_, what);
        good_ = false;
    }
    std::uint64_t part_of(double all) {
        return 1 + static_cast<std::uint64_t>(random_.uniform() * all);
    }

    Outcome stop_once() {
        switch (kind_) {
            case Kind::Cancel:
                return cancel();
            case Kind::Work:
                return limit({.threads = threads_, .stop = {.max_work = next_work()}});
            case Kind::Memory:
                return limit({.threads = threads_, .stop = {.max_memory = next_memory()}});
            case Kind::Exception:
                break;
        }
        return fail_allocation();
    }

    // What is counted is not known beforehand: the range is that of the limits that were hit.
    std::uint64_t next_work() { return part_of(1.1 * static_cast<double>(work_)); }
    std::uint64_t next_memory() {
        const double most = 4e6;
        return part_of(most * random_.uniform() * random_.uniform());
    }

    template <class Expected, class Run>
    Outcome outcome_of(const Run& run) {
        try {
            if (run() == expected_) return Outcome::Finished;
            wrong("another result");
        } catch (const Expected&) {
            return Outcome::Stopped;
        } catch (const std::exception& e) {
            wrong(e.what());
        } catch (...) {
            wrong("an exception of another kind");
        }
        return Outcome::Wrong;
    }

    Outcome cancel() {
        std::atomic<bool> flag = false;
        std::atomic<bool> started = false;
        const auto after = std::chrono::duration<double>(random_.uniform() * seconds_);
        std::thread other([&] {
            while (!started) std::this_thread::yield();
            const auto end = Clock::now() + after;
            while (Clock::now() < end) std::this_thread::yield();
            flag = true;
        });
        const Outcome outcome = outcome_of<trisect::CancelledError>([&] {
            const trisect::StopScope scope(&flag);
            started = true;
            return call_.run({.threads = threads_});
        });
        started = true;
        other.join();
        return outcome;
    }

    Outcome limit(const Limits& limits) {
        return outcome_of<trisect::LimitError>([&] {
            const trisect::StopScope scope(limits.stop);
            return call_.run(limits);
        });
    }

    Outcome fail_allocation() {
        const std::uint64_t n = part_of(1.05 * static_cast<double>(allocations_)) - 1;
        const Outcome outcome = outcome_of<std::bad_alloc>([&] {
            const trisect::test::FailingAllocationAnywhere failing(static_cast<std::int64_t>(n));
            return call_.run({.threads = threads_});
        });
        return outcome;
    }

    const Call& call_;
    Kind kind_;
    std::uint32_t threads_;
    shapes::Random& random_;
    std::uint64_t expected_ = 0;
    double seconds_ = 0;
    std::int64_t allocations_ = 0;
    std::uint64_t work_ = 0;
    bool good_ = true;
};

bool makes_sense(const Call& call, Kind kind) {
    if (kind == Kind::Work) return call.counts_work;
    if (kind == Kind::Memory) return call.counts_memory;
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    if (!parse(argc, argv, options)) {
        std::fprintf(stderr, "usage: see the head of the source\n");
        return 2;
    }
    const std::uint32_t most = *std::max_element(options.threads.begin(), options.threads.end());
    const oneapi::tbb::global_control as_many(oneapi::tbb::global_control::max_allowed_parallelism,
                                              std::max(most, 1U));
    shapes::Random random(options.seed);
    std::printf("| call | kind | threads | ms | stopped | finished | blocks kept | |\n");
    std::printf("|---|---|---|---|---|---|---|---|\n");
    bool good = true;
    for (const Call& call : calls(options.level)) {
        if (!is_wanted(options.calls, call.name)) continue;
        for (std::size_t k = 0; k < kind_names.size(); ++k) {
            if (!is_wanted(options.kinds, kind_names[k])) continue;
            const auto kind = static_cast<Kind>(k);
            if (!makes_sense(call, kind)) continue;
            for (const std::uint32_t threads : options.threads)
                good = Case(call, kind, threads, random).run(options.stops) && good;
        }
    }
    return good ? 0 : 1;
}
