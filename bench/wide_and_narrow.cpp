// SPDX-License-Identifier: Apache-2.0
//
// What coordinates with bits behind the point cost: each file as it is ("wide") beside the same on
// a lattice of 53 bits ("narrow"), in turns, on one thread. A line of a table for every file and
// question: the least milliseconds of all runs, and their ratio.
//
//     wide_and_narrow [--runs N] FILE...
//
// Questions: import of arrays; the union with itself, which resolves what may meet itself; of that
// the index, 100,000 points in its box, 100,000 near corners and on them, 20,000 rays; the model
// for interference, 300 placements of the solid beside itself, and these once more.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

namespace {

using trisect::BrepIndex;
using trisect::InterferenceModel;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Pose;
using trisect::Solid;

constexpr std::size_t question_count = 9;
constexpr std::array<const char*, question_count> questions{
    "import", "resolve", "index",           "points in the box", "points at corners",
    "rays",   "model",   "interfere first", "interfere again"};
using Times = std::array<double, question_count>;

template <class Work>
double milliseconds(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

struct Extent {
    Point3d low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    Point3d high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    [[nodiscard]] double largest() const {
        double out = 0;
        for (std::size_t k = 0; k < 3; ++k)
            out = std::max({out, std::fabs(low[k]), std::fabs(high[k])});
        return out;
    }
};

Extent extent_of(const PolygonMesh& mesh) {
    Extent out;
    for (const Point3d& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) {
            out.low[k] = std::min(out.low[k], p[k]);
            out.high[k] = std::max(out.high[k], p[k]);
        }
    return out;
}

/// The same questions for both copies.
struct Questions {
    std::vector<Point3d> in_box;
    std::vector<Point3d> at_corners;
    std::vector<trisect::Ray> rays;
    std::vector<Pose> poses;

    explicit Questions(const PolygonMesh& mesh) {
        const Extent box = extent_of(mesh);
        std::mt19937_64 random(1);
        const auto uniform = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        const auto in = [&] {
            Point3d p{};
            for (std::size_t k = 0; k < 3; ++k) p[k] = uniform(box.low[k], box.high[k]);
            return p;
        };
        for (int i = 0; i < 100'000; ++i) in_box.push_back(in());
        for (int i = 0; i < 100'000; ++i) {
            Point3d p = mesh.points[random() % mesh.points.size()];
            if (i % 2 == 0)
                for (double& c : p) c = std::nextafter(c, uniform(-1, 1) * HUGE_VAL);
            at_corners.push_back(p);
        }
        for (int i = 0; i < 20'000; ++i) {
            const Point3d from = in();
            const Point3d to = in();
            rays.push_back({from, {to[0] - from[0], to[1] - from[1], to[2] - from[2]}});
        }
        for (int i = 0; i < 300; ++i) {
            Point3d by{};
            for (std::size_t k = 0; k < 3; ++k)
                by[k] = uniform(-1.1, 1.1) * (box.high[k] - box.low[k]);
            poses.push_back(Pose::from_quaternion({20 + i % 7, 1, i % 5, 2}, by));
        }
    }
};

Times run(const PolygonMesh& mesh, const trisect::SolidOptions& options, const Questions& asked) {
    Times out{};
    std::optional<Solid> solid;
    std::optional<BrepIndex> index;
    std::optional<InterferenceModel> model;
    std::size_t sum = 0;
    std::size_t question = 0;
    const auto time = [&](const auto& work) { out[question++] = milliseconds(work); };
    time([&] { solid = Solid::from_mesh(mesh, options); });
    time([&] { solid = evaluate(trisect::Expression(*solid)); });
    time([&] { index.emplace(*solid); });
    for (const auto* points : {&asked.in_box, &asked.at_corners})
        time([&] {
            for (const Point3d& p : *points)
                sum += static_cast<std::size_t>(index->locate(p).location);
        });
    time([&] {
        for (const trisect::Ray& r : asked.rays) sum += index->first_hit(r) ? 1 : 0;
    });
    time([&] { model.emplace(*solid); });
    for (int again = 0; again < 2; ++again)
        time([&] {
            for (const Pose& p : asked.poses)
                sum += static_cast<std::size_t>(interfere(*model, Pose(), *model, p).relation);
        });
    if (sum == 0) std::puts("");
    return out;
}

void compare(const std::string& file, int runs) {
    const PolygonMesh mesh = trisect::read_mesh(file);
    const Questions asked(mesh);
    trisect::SolidOptions wide;
    wide.import.threads = 1;
    wide.embedding = trisect::Embedding::Resolve;
    trisect::SolidOptions narrow = wide;
    narrow.import.lattice = trisect::Lattice{std::ilogb(extent_of(mesh).largest()) - 51};
    std::array<Times, 2> best;
    for (Times& t : best) t.fill(HUGE_VAL);
    for (int i = 0; i < runs; ++i)
        for (const bool is_narrow : {false, true}) {
            const Times t = run(mesh, is_narrow ? narrow : wide, asked);
            for (std::size_t q = 0; q < question_count; ++q)
                best[is_narrow ? 1 : 0][q] = std::min(best[is_narrow ? 1 : 0][q], t[q]);
        }
    const std::string name = file.substr(file.find_last_of('/') + 1);
    for (std::size_t q = 0; q < question_count; ++q)
        std::printf("| %s | %s | %.2f | %.2f | %.2f |\n", name.c_str(), questions[q], best[0][q],
                    best[1][q], best[0][q] / best[1][q]);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        int runs = 3;
        std::puts("| file | question | wide ms | narrow ms | wide / narrow |");
        std::puts("|---|---|---:|---:|---:|");
        for (int i = 1; i < argc; ++i) {
            if (std::string(argv[i]) == "--runs" && i + 1 < argc) {
                runs = std::atoi(argv[++i]);
                continue;
            }
            compare(argv[i], runs);
        }
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "wide_and_narrow: %s\n", e.what());
        return 1;
    }
}
