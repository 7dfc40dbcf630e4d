// SPDX-License-Identifier: Apache-2.0
//
// What may be asked of a solid right after it was cut: a sphere of many triangles, cut by balls one
// after the other, each of which meets some 300 facets. After each cut come the first point, ray,
// nearest point and placement of another solid; from time to time many points of the version as it
// is.
//
//     chain_queries [--level N] [--cuts N] [--every N] [--path] [--unrefined]
//                   [--no-interference]
//
// --level: the stock has 20 · 4^N triangles. --unrefined: it is not divided beforehand. --path:
// cuts follow each other instead of lying all over the stock. --every: after so many cuts 20,000
// points, and a fresh index beside.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

#include "shapes.h"

namespace {

using trisect::BrepIndex;
using trisect::Expression;
using trisect::InterferenceModel;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Pose;
using trisect::Solid;

/// Instructions of this thread in user space; 0 where the machine does not count them.
class Instructions {
public:
    Instructions() {
        perf_event_attr a{};
        a.type = PERF_TYPE_HARDWARE;
        a.size = sizeof a;
        a.config = PERF_COUNT_HW_INSTRUCTIONS;
        a.exclude_kernel = 1;
        a.exclude_hv = 1;
        file_ = static_cast<int>(syscall(SYS_perf_event_open, &a, 0, -1, -1, 0));
    }
    ~Instructions() {
        if (file_ >= 0) close(file_);
    }
    Instructions(const Instructions&) = delete;
    Instructions& operator=(const Instructions&) = delete;
    [[nodiscard]] double now() const {
        std::uint64_t count = 0;
        if (file_ < 0 || read(file_, &count, sizeof count) != sizeof count) return 0;
        return static_cast<double>(count);
    }

private:
    int file_ = -1;
};

/// What one question took, cut by cut.
class Series {
public:
    explicit Series(const char* name) : name_(name) {}

    template <class Work>
    void add(const Instructions& counter, const Work& work) {
        const double before = counter.now();
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::milli> t =
            std::chrono::steady_clock::now() - start;
        milliseconds_.push_back(t.count());
        instructions_.push_back(counter.now() - before);
    }
    void print() const {
        if (milliseconds_.empty()) return;
        std::vector<double> sorted = milliseconds_;
        std::ranges::sort(sorted);
        const auto n = sorted.size();
        std::printf("| %s | %.3f | %.3f | %.3f | %.0f | %.0f |\n", name_, mean(milliseconds_, 0, n),
                    sorted[n * 99 / 100], sorted[n - 1],
                    mean(instructions_, 0, std::min<std::size_t>(n, 20)) / 1000,
                    mean(instructions_, n - std::min<std::size_t>(n, 20), n) / 1000);
    }

private:
    static double mean(const std::vector<double>& v, std::size_t first, std::size_t end) {
        double sum = 0;
        for (std::size_t i = first; i < end; ++i) sum += v[i];
        return sum / static_cast<double>(end - first);
    }
    const char* name_;
    std::vector<double> milliseconds_;
    std::vector<double> instructions_;
};

struct Options {
    int level = 6;
    int cuts = 300;
    int every = 100;
    bool path = false;
    bool refined = true;
    bool interference = true;
};

Options parsed(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string arg = argv[i];
        const auto number = [&] { return i + 1 < argc ? std::atoi(argv[++i]) : 0; };
        if (arg == "--level") {
            o.level = number();
        } else if (arg == "--cuts") {
            o.cuts = number();
        } else if (arg == "--every") {
            o.every = std::max(1, number());
        } else if (arg == "--path") {
            o.path = true;
        } else if (arg == "--unrefined") {
            o.refined = false;
        } else if (arg == "--no-interference") {
            o.interference = false;
        } else {
            throw std::runtime_error("unknown option " + arg);
        }
    }
    return o;
}

constexpr double unit = 0x1p-30;

double on_unit(double v) { return std::round(v / unit) * unit; }

/// On multiples of 2^-30, as a user's data on one grid is.
PolygonMesh on_grid(PolygonMesh m) {
    for (Point3d& p : m.points)
        for (double& c : p) c = on_unit(c);
    return m;
}

Solid solid_of(const PolygonMesh& mesh) {
    trisect::SolidOptions options;
    options.embedding = trisect::Embedding::Assume;
    return Solid::from_mesh(mesh, options);
}

trisect::EvaluateOptions one_thread() {
    trisect::EvaluateOptions o;
    o.threads = 1;
    return o;
}

class Chain {
public:
    explicit Chain(const Options& o)
        : options_(o),
          random_(1),
          stock_(solid_of(on_grid(shapes::icosphere(o.level)))),
          // Meets about 300 facets, whatever their number.
          radius_(std::sqrt(300.0 / (5 * std::pow(4, o.level)))),
          ball_(shapes::icosphere(3)),
          holder_(solid_of(on_grid(scaled(shapes::icosphere(4), 0.25)))) {
        if (o.refined) stock_.refine();
        (void)BrepIndex(stock_);
        if (o.interference) holder_model_.emplace(holder_);
    }

    void run() {
        for (int i = 1; i <= options_.cuts; ++i) {
            step(i);
            if (i % options_.every == 0) warm(i);
        }
        std::puts(
            "\n| first after a cut | mean ms | 99 % | worst | 10^3 instructions, first 20 | last "
            "20 |");
        std::puts("|---|---:|---:|---:|---:|---:|");
        for (const Series* s : {&cut_, &index_, &locate_, &ray_, &nearest_, &model_, &interfere_})
            s->print();
    }

private:
    static PolygonMesh scaled(PolygonMesh m, double by) {
        for (Point3d& p : m.points)
            for (double& c : p) c *= by;
        return m;
    }

    [[nodiscard]] Point3d on_sphere(double radius) {
        const double z = 2 * random_.uniform() - 1;
        const double a = 2 * M_PI * random_.uniform();
        const double r = std::sqrt(1 - z * z);
        return {radius * r * std::cos(a), radius * r * std::sin(a), radius * z};
    }
    [[nodiscard]] Point3d place(int i) {
        if (!options_.path) return on_sphere(1);
        const double t = 0.7 * radius_ * i;  // along a spiral
        const double z = 1 - std::fmod(2.0 * t * radius_ / (2 * M_PI), 2.0);
        const double r = std::sqrt(std::max(0.0, 1 - z * z));
        return {r * std::cos(t), r * std::sin(t), z};
    }

    void step(int i) {
        const Point3d at = place(i);
        const PolygonMesh tool = on_grid(shapes::moved(scaled(ball_, radius_), at));
        cut_.add(counter_, [&] {
            stock_ = evaluate(Expression(stock_) - Expression(solid_of(tool)), one_thread());
        });
        // A point beside the cut, a ray towards it, a point above it.
        Point3d near = at;
        for (double& c : near) c *= 1 - 0.9 * radius_;
        Point3d above = at;
        for (double& c : above) c *= 1 + 2 * radius_;
        Point3d far = at;
        for (double& c : far) c *= 3;
        std::optional<BrepIndex> index;
        index_.add(counter_, [&] { index.emplace(stock_); });
        locate_.add(counter_,
                    [&] { sum_ += static_cast<std::size_t>(index->locate(near).location); });
        ray_.add(counter_, [&] {
            sum_ += index->first_facet(trisect::Segment{far, {0, 0, 0}}) ? 1 : 0;
        });
        nearest_.add(counter_, [&] { sum_ += index->distance(above) ? 1 : 0; });
        if (!options_.interference) return;
        std::optional<InterferenceModel> model;
        model_.add(counter_, [&] { model.emplace(stock_); });
        // The holder above the tool, a little off the stock.
        Point3d by = at;
        for (double& c : by) c *= 1.25 + 0.1 * radius_;
        const Pose pose = Pose::from_translation(by);
        interfere_.add(counter_, [&] {
            sum_ +=
                static_cast<std::size_t>(interfere(*model, Pose(), *holder_model_, pose).relation);
        });
    }

    void warm(int i) {
        constexpr std::size_t count = 20'000;
        std::vector<Point3d> uniform;
        std::vector<Point3d> near;
        for (std::size_t k = 0; k < count; ++k) {
            Point3d p{};
            for (double& c : p) c = 2 * random_.uniform() - 1;
            uniform.push_back(p);
            near.push_back(on_sphere(1 + 0.01 * (random_.uniform() - 0.5)));
        }
        const BrepIndex index(stock_);
        const BrepIndex fresh(solid_of(index_mesh()));
        std::printf("| after %d cuts |", i);
        for (const auto* points : {&uniform, &near})
            for (const BrepIndex* b : {&index, &fresh}) {
                double best = HUGE_VAL;
                for (int again = 0; again < 4; ++again) {
                    const auto start = std::chrono::steady_clock::now();
                    for (const Point3d& p : *points)
                        sum_ += static_cast<std::size_t>(b->locate(p).location);
                    const std::chrono::duration<double, std::micro> t =
                        std::chrono::steady_clock::now() - start;
                    best = std::min(best, t.count() / static_cast<double>(count));
                }
                std::printf(" %s %s %.3f us |", points == &uniform ? "uniform" : "near",
                            b == &index ? "result" : "fresh", best);
            }
        std::printf(" %.1f MB |\n", static_cast<double>(index.stats().bytes) * 1e-6);
        std::fflush(stdout);
    }
    [[nodiscard]] PolygonMesh index_mesh() const { return stock_.to_mesh(); }

    Options options_;
    shapes::Random random_;
    Instructions counter_;
    Solid stock_;
    double radius_;
    PolygonMesh ball_;
    Solid holder_;
    std::optional<InterferenceModel> holder_model_;
    std::size_t sum_ = 0;
    Series cut_{"the cut"};
    Series index_{"BrepIndex"};
    Series locate_{"locate"};
    Series ray_{"first_facet"};
    Series nearest_{"distance"};
    Series model_{"InterferenceModel"};
    Series interfere_{"interfere"};
};

}  // namespace

int main(int argc, char** argv) {
    try {
        Chain(parsed(argc, argv)).run();
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "chain_queries: %s\n", e.what());
        return 1;
    }
}
