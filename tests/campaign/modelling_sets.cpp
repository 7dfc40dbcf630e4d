// SPDX-License-Identifier: Apache-2.0
//
// Hulls, Minkowski sums and differences of random solids on a small grid, and the same with CGAL:
// convex_hull_3 and minkowski_sum_3 in rationals. The boundaries must be the same sets.
//
//     modelling_sets [--seed S] [--hulls N] [--sums M] [--only I]
//     modelling_sets MESH...
//
// Meshes are rounded to 1,024 steps along their longest side. The sum of each and of a tetrahedron,
// its difference and its hull are compared, as far as they do not meet themselves then and CGAL
// takes no more than a minute.
//
// Prints a line for each difference, with the number that repeats it; exits with 1 if there was
// any. Each case with CGAL is a process of its own, of a minute at most. The first N numbers are
// hulls of two solids, the next M sums and differences of two.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/convex_hull_3.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/modelling/hull_of_solids.h>
#include <trisect/bsp/modelling/minkowski.h>
#include <trisect/kernel/error.h>

#include "engines/engines.h"
#include "reference/nef_polyhedron.h"

// After Nef_polyhedron_3.h, which it does not include.
#include <CGAL/minkowski_sum_3.h>

namespace {

using reference::CanonicalBoundary;
using reference::Nef;
using reference::NefKernel;
using reference::Operand;
using reference::Random;
using Polyhedron = CGAL::Polyhedron_3<NefKernel>;

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t hulls = 1000;
    std::uint64_t sums = 100;
    std::uint64_t only = ~std::uint64_t{0};
    std::vector<std::string> meshes;
};

struct Counts {
    std::uint64_t results = 0;
    std::uint64_t empty = 0;
    std::uint64_t different = 0;
    std::uint64_t failed = 0;
    double ours = 0;
    double cgal = 0;
};

enum Status { Equal, Empty, Different, Failed };
constexpr unsigned most_seconds = 60;

// CGAL's overlays of Nef polyhedra crash now and then: that ends a child alone.
template <class Work>
int in_a_child(Work&& work) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        alarm(most_seconds);
        try {
            _exit(work());
        } catch (const std::exception&) {
            _exit(Failed);
        }
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) return Failed;
    return WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(Failed);
}

template <class Work>
auto timed(double& seconds, Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    auto out = work();
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return out;
}

CanonicalBoundary hull_by_cgal(const std::vector<Operand>& operands) {
    std::vector<NefKernel::Point_3> points;
    const auto number = [](std::int64_t x) { return CGAL::Gmpq(static_cast<int>(x)); };
    for (const Operand& operand : operands)
        for (const reference::Triangle& triangle : operand)
            for (const auto& [x, y, z] : triangle)
                points.emplace_back(number(x), number(y), number(z));
    Polyhedron hull;
    CGAL::convex_hull_3(points.begin(), points.end(), hull);
    Nef nef(hull);
    return reference::boundary_of(nef);
}

Operand turned_about(const Operand& operand) {
    Operand out = reference::reversed(operand);
    for (reference::Triangle& triangle : out)
        for (reference::LatticePoint& p : triangle) p = {-p[0], -p[1], -p[2]};
    return out;
}

Nef sum_by_cgal(const Operand& a, const Operand& b) {
    Nef first = reference::to_nef(a);
    Nef second = reference::to_nef(b);
    return CGAL::minkowski_sum_3(first, second);
}

// Where `b` can be moved: nowhere in the sum of the surroundings of `a`, in a box, and `b` turned
// about. That need not be in `a`, unless `b` has the origin.
Nef difference_by_cgal(const Operand& a, const Operand& b, std::int64_t reach) {
    const auto cube = [](std::int64_t r) {
        return reference::to_nef(reference::box({-r, -r, -r}, {r, r, r}));
    };
    Nef around = cube(2 * reach) - reference::to_nef(a);
    Nef turned = reference::to_nef(turned_about(b));
    const Nef everywhere = cube(reach);
    return everywhere - CGAL::minkowski_sum_3(around, turned);
}

class Campaign {
public:
    explicit Campaign(const Options& options) : options_(options) {}

    void run(std::uint64_t number) {
        Random mix(options_.seed * 2 + 1);
        Random random(mix.next() + number);
        const std::vector<Operand> pair = random_family(random, 2, true);
        const std::vector<trisect::Solid> solids{
            engines::solid(pair[0], trisect::Embedding::Assume),
            engines::solid(pair[1], trisect::Embedding::Assume)};
        if (number < options_.hulls) {
            compare(
                number, "hull", [&] { return trisect::hull(solids); },
                [&] { return hull_by_cgal(pair); });
            return;
        }
        compare(
            number, "sum", [&] { return trisect::minkowski_sum(solids[0], solids[1]); },
            [&] { return reference::boundary_of(sum_by_cgal(pair[0], pair[1])); });
        compare(
            number, "difference",
            [&] { return trisect::minkowski_difference(solids[0], solids[1]); },
            [&] { return reference::boundary_of(difference_by_cgal(pair[0], pair[1], 100)); });
    }

    /// Prints a line for each mesh.
    void run(const std::string& file) {
        const std::optional<Operand> mesh = mesh_on_grid(file);
        if (!mesh) {
            std::printf("%s: not a solid without contact once rounded\n", file.c_str());
            return;
        }
        const Operand tetrahedron =
            reference::tetrahedron({-9, -7, -5}, {21, 2, 3}, {1, 19, 4}, {2, 3, 17});
        const trisect::Solid a = engines::solid(*mesh, trisect::Embedding::Assume);
        const trisect::Solid b = engines::solid(tetrahedron, trisect::Embedding::Assume);
        const Counts before = counts_;
        file_ = file;
        const std::vector<trisect::Solid> both{a, b};
        compare(
            0, "hull", [&] { return trisect::hull(both); },
            [&] {
                return hull_by_cgal({*mesh, tetrahedron});
            });
        compare(
            1, "sum", [&] { return trisect::minkowski_sum(a, b); },
            [&] { return reference::boundary_of(sum_by_cgal(*mesh, tetrahedron)); });
        compare(
            2, "difference", [&] { return trisect::minkowski_difference(a, b); },
            [&] { return reference::boundary_of(difference_by_cgal(*mesh, tetrahedron, 4096)); });
        std::printf("%s: %zu triangles, %llu of 3 compared, %llu different; %.2f s, CGAL %.1f s\n",
                    file.c_str(), mesh->size(),
                    static_cast<unsigned long long>(3 - (counts_.failed - before.failed)),
                    static_cast<unsigned long long>(counts_.different - before.different),
                    counts_.ours - before.ours, counts_.cgal - before.cgal);
        std::fflush(stdout);
    }
    [[nodiscard]] const Counts& counts() const { return counts_; }

private:
    static trisect::PolygonMesh mesh_in(const std::string& file) {
        try {
            return trisect::read_mesh(file);
        } catch (const trisect::Error& e) {
            std::printf("%s\n", e.what());
            return {};
        }
    }

    static std::optional<Operand> mesh_on_grid(const std::string& file) {
        const trisect::PolygonMesh mesh = mesh_in(file);
        double lo[3]{HUGE_VAL, HUGE_VAL, HUGE_VAL};
        double side = 0;
        for (const trisect::Point3d& p : mesh.points)
            for (std::size_t k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]);
        for (const trisect::Point3d& p : mesh.points)
            for (std::size_t k = 0; k < 3; ++k) side = std::max(side, p[k] - lo[k]);
        trisect::PolygonMesh scaled = mesh;
        for (trisect::Point3d& p : scaled.points)
            for (std::size_t k = 0; k < 3; ++k) p[k] = std::nearbyint((p[k] - lo[k]) / side * 1024);
        trisect::ImportOptions options;
        options.require_closed = false;
        options.lattice = trisect::Lattice{0};
        const trisect::ImportedMesh imported = trisect::import_mesh(scaled, options);
        if (!imported.report.closed || imported.report.inside_out ||
            imported.mesh.triangles.empty() || !trisect::is_embedded(imported.mesh))
            return std::nullopt;
        Operand out;
        for (const auto& t : imported.mesh.triangles) {
            auto& triangle = out.emplace_back();
            for (std::size_t i = 0; i < 3; ++i) {
                const auto at = imported.mesh.points[t[i]].doubles();
                for (std::size_t k = 0; k < 3; ++k)
                    triangle[i][k] = static_cast<std::int64_t>(at[k]);
            }
        }
        return out;
    }

    template <class Ours, class Theirs>
    void compare(std::uint64_t number, const char* what, Ours&& ours, Theirs&& theirs) {
        ++counts_.results;
        const trisect::Brep brep = timed(counts_.ours, ours).to_brep();
        const int status = timed(counts_.cgal, [&] {
            return in_a_child([&] {
                const CanonicalBoundary expected = theirs();
                const std::string why = engines::difference(brep, expected);
                if (!why.empty()) print(number, what, why);
                return why.empty() ? (expected.empty() ? Empty : Equal) : Different;
            });
        });
        if (status == Empty) ++counts_.empty;
        if (status == Different) ++counts_.different;
        if (status == Failed) ++counts_.failed;
    }

    void print(std::uint64_t number, const char* what, const std::string& why) const {
        const auto n = [](std::uint64_t v) { return static_cast<unsigned long long>(v); };
        if (!file_.empty()) {
            std::printf("DIFFERENT %s, %s: %s\n", file_.c_str(), what, why.c_str());
            std::fflush(stdout);
            return;
        }
        std::printf("DIFFERENT --seed %llu --hulls %llu --sums %llu --only %llu, %s: %s\n",
                    n(options_.seed), n(options_.hulls), n(options_.sums), n(number), what,
                    why.c_str());
        std::fflush(stdout);
    }

    const Options& options_;
    Counts counts_;
    std::string file_;  ///< empty for random solids
};

bool parse(int argc, char** argv, Options& out) {
    for (int i = 1; i < argc; i += 2) {
        const std::string_view word = argv[i];
        if (!word.starts_with("--")) {
            out.meshes.emplace_back(word);
            --i;
            continue;
        }
        if (i + 1 == argc) return false;
        const std::uint64_t value = std::strtoull(argv[i + 1], nullptr, 10);
        if (word == "--seed")
            out.seed = value;
        else if (word == "--hulls")
            out.hulls = value;
        else if (word == "--sums")
            out.sums = value;
        else if (word == "--only")
            out.only = value;
        else
            return false;
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    if (!parse(argc, argv, options)) {
        std::fprintf(
            stderr,
            "usage: modelling_sets [--seed S] [--hulls N] [--sums M] [--only I] | MESH...\n");
        return 2;
    }
    Campaign campaign(options);
    const bool one = options.only != ~std::uint64_t{0};
    const std::uint64_t end = one ? options.only + 1 : options.hulls + options.sums;
    for (const std::string& mesh : options.meshes) campaign.run(mesh);
    for (std::uint64_t i = one ? options.only : 0; i < end && options.meshes.empty(); ++i)
        campaign.run(i);
    const Counts& c = campaign.counts();
    const auto n = [](std::uint64_t v) { return static_cast<unsigned long long>(v); };
    std::printf(
        "%llu results (seed %llu), %llu of them empty, %llu different, CGAL failed in %llu; %.1f "
        "s, "
        "CGAL %.1f s\n",
        n(c.results), n(options.seed), n(c.empty), n(c.different), n(c.failed), c.ours, c.cgal);
    return c.different == 0 ? 0 : 1;
}
