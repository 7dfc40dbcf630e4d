// SPDX-License-Identifier: Apache-2.0
//
// Booleans of random mesh files by the library and by Manifold, in one process.
//
//     pairs_beside_manifold [--seed N] [--pairs N] [--operands N] [--boxes 1] [--rounds N] FILE...
//
// The second file of a pair is put where a random point of the first one's box is, to eighths of a
// unit; in half of the pairs it is turned by 90 degrees about the z axis, and in half it begins in
// the plane in which the first one's box begins, along one axis, so that faces are flush. One of
// union, difference and intersection. --operands N: 3 to N files in place of pairs, each of the
// others placed so by itself, and in place of an intersection every other one less the rest.
// --boxes 1: in place of the second file a box that has all of the first one on one side of a plane
// across an axis, in half of the pairs one through a vertex. Prints
// a line of tab-separated values for each formula: the operation, the placement, how many operands,
// triangles of these and of the result, least processor seconds of either in `rounds` turns from
// arrays to arrays with one thread, their ratio, volumes, files. Then for each placement, or
// operation on several, how many times as fast as Manifold the library is (least, tenth part,
// median), and how many volumes differ by more than 10^-8 of the first operand's or of the
// result's, the larger.
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
#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace {

using trisect::PolygonMesh;

constexpr std::array operations{"union", "difference", "intersection", "union less union"};
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

trisect::Expression formula_of(const std::vector<trisect::Solid>& solids, std::size_t operation) {
    trisect::Expression out = solids[0];
    if (operation == 3) {
        trisect::Expression less = solids[1];
        for (std::size_t i = 2; i < solids.size(); ++i)
            if (i % 2 != 0)
                less = less | solids[i];
            else
                out = out | solids[i];
        return out - less;
    }
    for (std::size_t i = 1; i < solids.size(); ++i)
        out = operation == 0 ? out | solids[i] : operation == 1 ? out - solids[i] : out & solids[i];
    return out;
}

Outcome by_trisect(const std::vector<PolygonMesh>& meshes, std::size_t operation) {
    const double begin = processor_seconds();
    trisect::SolidOptions options;
    options.import.threads = 1;
    trisect::EvaluateOptions evaluating;
    evaluating.threads = 1;
    std::vector<trisect::Solid> solids;
    for (const PolygonMesh& m : meshes) solids.push_back(trisect::Solid::from_mesh(m, options));
    const trisect::Solid result = evaluate(formula_of(solids, operation), evaluating);
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

manifold::Manifold evaluate_by_manifold(const std::vector<manifold::Manifold>& operands,
                                        std::size_t operation) {
    using enum manifold::OpType;
    using manifold::Manifold;
    if (operation < 3)
        return Manifold::BatchBoolean(operands, std::array{Add, Subtract, Intersect}[operation]);
    std::array<std::vector<Manifold>, 2> terms;
    for (std::size_t i = 0; i < operands.size(); ++i) terms[i % 2].push_back(operands[i]);
    return Manifold::BatchBoolean(terms[0], Add) - Manifold::BatchBoolean(terms[1], Add);
}

Outcome by_manifold(const std::vector<PolygonMesh>& meshes, std::size_t operation) {
    const double begin = processor_seconds();
    std::vector<manifold::Manifold> operands;
    for (const PolygonMesh& m : meshes) operands.push_back(manifold_of(m));
    const manifold::Manifold result = evaluate_by_manifold(operands, operation);
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

// What is above `height` along an axis, and more.
PolygonMesh box_above(const Range& range, std::size_t axis, double height) {
    trisect::Point3d low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double extent = range.hi[k] - range.lo[k];
        low[k] = std::floor(range.lo[k] - extent / 2 - 1);
        high[k] = std::ceil(range.hi[k] + extent / 2 + 1);
    }
    low[axis] = height;
    return trisect::make_box(low, high);
}

class RandomFormulas {
public:
    RandomFormulas(std::vector<std::string> files, int seed, int rounds, int operands)
        : files_(std::move(files)),
          random_(static_cast<unsigned>(seed)),
          rounds_(rounds),
          operands_(static_cast<std::size_t>(operands)) {}

    void compare_one() {
        const std::size_t count = operands_ < 3 ? 2 : 3 + random_() % (operands_ - 2);
        std::size_t operation = random_() % 3;
        if (count > 2 && operation == 2) operation = 3;
        std::string files = any_file();
        std::string name;
        std::vector<PolygonMesh> meshes{mesh_of(files)};
        const Range first = range_of(meshes[0]);
        while (meshes.size() < count) {
            const std::string& file = any_file();
            const Placement placement = any_placement();
            meshes.push_back(placed(mesh_of(file), placement, first));
            files += '\t' + file;
            name = count > 2 ? operations[operation] : placement.name();
        }
        compare(meshes, operation, name, files);
    }

    void compare_one_with_box() {
        const std::size_t operation = random_() % 3;
        const std::string& file = any_file();
        const PolygonMesh& mesh = mesh_of(file);
        const std::size_t axis = random_() % 3;
        const Range range = range_of(mesh);
        const bool through_vertex = random_() % 2 != 0;
        const double part = static_cast<double>(200 + random_() % 600) / 1000;
        double height = range.lo[axis] + part * (range.hi[axis] - range.lo[axis]);
        if (through_vertex) {
            const auto far = [&](const trisect::Point3d& p) { return std::fabs(p[axis] - height); };
            height = (*std::ranges::min_element(mesh.points, {}, far))[axis];
        }
        compare({mesh, box_above(range, axis, height)}, operation,
                through_vertex ? "box from a vertex" : "box", file);
    }

    void compare(const std::vector<PolygonMesh>& meshes, std::size_t operation,
                 const std::string& name, const std::string& files) {
        Outcome ours = by_trisect(meshes, operation);
        Outcome theirs = by_manifold(meshes, operation);
        for (int i = 1; i < rounds_; ++i) {
            ours.seconds = std::min(ours.seconds, by_trisect(meshes, operation).seconds);
            theirs.seconds = std::min(theirs.seconds, by_manifold(meshes, operation).seconds);
        }
        std::size_t triangles = 0;
        for (const PolygonMesh& m : meshes) triangles += m.face_count();
        const double ratio = theirs.seconds / ours.seconds;
        std::printf("%s\t%s\t%zu\t%zu\t%zu\t%.5f\t%.5f\t%.2f\t%.12g\t%.12g\t%s\n",
                    operations[operation], name.c_str(), meshes.size(), triangles, ours.triangles,
                    ours.seconds, theirs.seconds, ratio, ours.volume, theirs.volume, files.c_str());
        std::fflush(stdout);
        Summary& s = summaries_[name];
        s.ratios.push_back(ratio);
        if (std::isnan(theirs.volume))
            ++s.declined;
        else if (std::abs(ours.volume - theirs.volume) >
                 accepted_difference * std::max(std::abs(ours.volume), volume_of(meshes[0])))
            ++s.different;
    }

    [[nodiscard]] const std::map<std::string, Summary>& summaries() const { return summaries_; }

private:
    const std::string& any_file() { return files_[random_() % files_.size()]; }
    Placement any_placement() {
        Placement out;
        out.turned = random_() % 2 != 0;
        out.flush_axis = random_() % 2 != 0 ? static_cast<int>(random_() % 3) : -1;
        for (double& at : out.at) at = static_cast<double>(random_() % 1000) / 1000;
        return out;
    }
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
    std::size_t operands_;
    std::map<std::string, PolygonMesh> meshes_;
    std::map<std::string, Summary> summaries_;
};

}  // namespace

int main(int argc, char** argv) {
    int seed = 1;
    int pairs = 100;
    int rounds = 2;
    int operands = 2;
    int boxes = 0;
    std::vector<std::string> files;
    for (int i = 1; i < argc; ++i) {
        const std::string_view option = argv[i];
        int* value = option == "--seed"       ? &seed
                     : option == "--pairs"    ? &pairs
                     : option == "--rounds"   ? &rounds
                     : option == "--operands" ? &operands
                     : option == "--boxes"    ? &boxes
                                              : nullptr;
        if (value != nullptr && i + 1 < argc)
            *value = std::atoi(argv[++i]);
        else
            files.emplace_back(option);
    }
    if (files.empty()) {
        std::fprintf(stderr,
                     "usage: %s [--seed N] [--pairs N] [--operands N] [--boxes 1] [--rounds N] "
                     "FILE...\n",
                     argv[0]);
        return 2;
    }
    RandomFormulas all(files, seed, rounds, operands);
    for (int i = 0; i < pairs; ++i) {
        try {
            boxes != 0 ? all.compare_one_with_box() : all.compare_one();
        } catch (const std::exception& error) {
            std::fprintf(stderr, "pair %d: %s\n", i, error.what());
            return 1;
        }
    }
    print(all.summaries());
    return 0;
}
