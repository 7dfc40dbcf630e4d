// SPDX-License-Identifier: Apache-2.0
//
// Booleans of random pairs of mesh files by the library and by Manifold, in one process.
//
//     pairs_beside_manifold [--seed N] [--pairs N] [--rounds N] FILE...
//
// The second file of a pair is put where a random point of the first one's box is, to eighths of a
// unit; in half of the pairs it is turned by 90 degrees about the z axis, and in half it begins in
// the plane in which the first one's box begins, along one axis, so that faces are flush. One of
// union, difference and intersection. Prints a line of tab-separated values for each pair: the
// operation, the placement, triangles of both and of the result, least processor seconds of either
// in `rounds` turns from arrays to arrays with one thread, their ratio, volumes, files. Then for
// each placement how many times as fast as Manifold the library is (least, tenth part, median), and
// how many volumes differ by more than 10^-8 of the first operand's or of the result's, the larger.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <manifold/manifold.h>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace {

using trisect::PolygonMesh;

constexpr std::array operations{"union", "difference", "intersection"};
constexpr double accepted_difference = 1e-8;

double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Range {
    std::array<double, 3> lo;
    std::array<double, 3> hi;
};

Range range_of(const PolygonMesh& mesh) {
    constexpr double far = std::numeric_limits<double>::infinity();
    Range out{{far, far, far}, {-far, -far, -far}};
    for (const auto& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) {
            out.lo[k] = std::min(out.lo[k], p[k]);
            out.hi[k] = std::max(out.hi[k], p[k]);
        }
    return out;
}

struct Placement {
    bool turned = false;
    int flush_axis = -1;
    std::array<double, 3> at{};  // parts of the first box

    [[nodiscard]] std::string name() const {
        return std::string(turned ? "turned" : "moved") + (flush_axis < 0 ? "" : ", flush");
    }
};

PolygonMesh placed(PolygonMesh mesh, const Placement& placement, const Range& first) {
    if (placement.turned)
        for (auto& p : mesh.points) p = {-p[1], p[0], p[2]};
    const Range own = range_of(mesh);
    std::array<double, 3> move{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double middle = (own.lo[k] + own.hi[k]) / 2;
        const double to = first.lo[k] + placement.at[k] * (first.hi[k] - first.lo[k]);
        move[k] = static_cast<int>(k) == placement.flush_axis ? first.lo[k] - own.lo[k]
                                                              : std::round(8 * (to - middle)) / 8;
    }
    for (auto& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] += move[k];
    return mesh;
}

struct Outcome {
    double seconds = 0;
    double volume = 0;
    std::size_t triangles = 0;
};

Outcome by_trisect(const PolygonMesh& a, const PolygonMesh& b, std::size_t operation) {
    const double begin = processor_seconds();
    trisect::SolidOptions options;
    options.import.threads = 1;
    trisect::EvaluateOptions evaluating;
    evaluating.threads = 1;
    const auto first = trisect::Solid::from_mesh(a, options);
    const auto second = trisect::Solid::from_mesh(b, options);
    const auto result = operation == 0   ? evaluate(first | second, evaluating)
                        : operation == 1 ? evaluate(first - second, evaluating)
                                         : evaluate(first & second, evaluating);
    const PolygonMesh mesh = result.to_mesh(1);
    const double seconds = processor_seconds() - begin;
    return {seconds, trisect::volume(result.to_exact_mesh()), mesh.face_count()};
}

manifold::Manifold manifold_of(const PolygonMesh& mesh) {
    manifold::MeshGL64 out;
    out.numProp = 3;
    for (const auto& p : mesh.points)
        out.vertProperties.insert(out.vertProperties.end(), p.begin(), p.end());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.face(f);
        for (std::size_t k = 1; k + 1 < corners.size(); ++k)
            out.triVerts.insert(out.triVerts.end(), {corners[0], corners[k], corners[k + 1]});
    }
    out.Merge();
    return manifold::Manifold(out);
}

Outcome by_manifold(const PolygonMesh& a, const PolygonMesh& b, std::size_t operation) {
    using enum manifold::OpType;
    const double begin = processor_seconds();
    const manifold::Manifold result =
        manifold_of(a).Boolean(manifold_of(b), std::array{Add, Subtract, Intersect}[operation]);
    const std::size_t triangles = result.GetMeshGL64().NumTri();
    const double seconds = processor_seconds() - begin;
    if (result.Status() != manifold::Manifold::Error::NoError) return {seconds, NAN, 0};
    return {seconds, result.Volume(), triangles};
}

struct Summary {
    std::vector<double> ratios;
    std::size_t different = 0;
    std::size_t declined = 0;  // by Manifold
};

void print(const std::map<std::string, Summary>& summaries) {
    std::puts("placement\tpairs\tleast\ttenth\tmedian\tbelow 3\tvolumes differ\tManifold declines");
    for (const auto& [name, s] : summaries) {
        std::vector<double> r = s.ratios;
        std::ranges::sort(r);
        const auto below = std::ranges::lower_bound(r, 3.0) - r.begin();
        std::printf("%s\t%zu\t%.2f\t%.2f\t%.2f\t%td\t%zu\t%zu\n", name.c_str(), r.size(), r.front(),
                    r[r.size() / 10], r[r.size() / 2], below, s.different, s.declined);
    }
}

class Pairs {
public:
    Pairs(std::vector<std::string> files, unsigned seed, int rounds)
        : files_(std::move(files)), random_(seed), rounds_(rounds) {}

    void compare_one() {
        const std::string& first = any_file();
        const std::string& second = any_file();
        const std::size_t operation = random_() % operations.size();
        Placement placement;
        placement.turned = random_() % 2 != 0;
        placement.flush_axis = random_() % 2 != 0 ? static_cast<int>(random_() % 3) : -1;
        for (double& at : placement.at) at = static_cast<double>(random_() % 1000) / 1000;
        const PolygonMesh& a = mesh_of(first);
        const PolygonMesh b = placed(mesh_of(second), placement, range_of(a));
        Outcome ours = by_trisect(a, b, operation);
        Outcome theirs = by_manifold(a, b, operation);
        for (int i = 1; i < rounds_; ++i) {
            ours.seconds = std::min(ours.seconds, by_trisect(a, b, operation).seconds);
            theirs.seconds = std::min(theirs.seconds, by_manifold(a, b, operation).seconds);
        }
        const double ratio = theirs.seconds / ours.seconds;
        std::printf("%s\t%s\t%zu\t%zu\t%zu\t%.5f\t%.5f\t%.2f\t%.12g\t%.12g\t%s\t%s\n",
                    operations[operation], placement.name().c_str(), a.face_count(), b.face_count(),
                    ours.triangles, ours.seconds, theirs.seconds, ratio, ours.volume, theirs.volume,
                    first.c_str(), second.c_str());
        std::fflush(stdout);
        Summary& s = summaries_[placement.name()];
        s.ratios.push_back(ratio);
        if (std::isnan(theirs.volume))
            ++s.declined;
        else if (std::abs(ours.volume - theirs.volume) >
                 accepted_difference * std::max(std::abs(ours.volume), volume_of(a)))
            ++s.different;
    }

    [[nodiscard]] const std::map<std::string, Summary>& summaries() const { return summaries_; }

private:
    const std::string& any_file() { return files_[random_() % files_.size()]; }
    static double volume_of(const PolygonMesh& mesh) {
        return std::abs(trisect::volume(trisect::Solid::from_mesh(mesh).to_exact_mesh()));
    }
    const PolygonMesh& mesh_of(const std::string& file) {
        const auto [it, is_new] = meshes_.try_emplace(file);
        if (is_new) it->second = trisect::read_mesh(file);
        return it->second;
    }

    std::vector<std::string> files_;
    std::mt19937 random_;
    int rounds_;
    std::map<std::string, PolygonMesh> meshes_;
    std::map<std::string, Summary> summaries_;
};

}  // namespace

int main(int argc, char** argv) {
    int seed = 1;
    int pairs = 100;
    int rounds = 2;
    std::vector<std::string> files;
    for (int i = 1; i < argc; ++i) {
        const std::string_view option = argv[i];
        int* value = option == "--seed"     ? &seed
                     : option == "--pairs"  ? &pairs
                     : option == "--rounds" ? &rounds
                                            : nullptr;
        if (value != nullptr && i + 1 < argc)
            *value = std::atoi(argv[++i]);
        else
            files.emplace_back(option);
    }
    if (files.empty()) {
        std::fprintf(stderr, "usage: %s [--seed N] [--pairs N] [--rounds N] FILE...\n", argv[0]);
        return 2;
    }
    Pairs all(files, static_cast<unsigned>(seed), rounds);
    for (int i = 0; i < pairs; ++i) {
        try {
            all.compare_one();
        } catch (const std::exception& error) {
            std::fprintf(stderr, "pair %d: %s\n", i, error.what());
            return 1;
        }
    }
    print(all.summaries());
    return 0;
}
