// SPDX-License-Identifier: Apache-2.0
//
// Stacks of slices of files, by slices(), by section() for each plane, and by Manifold.
//
//     slice_stack FILE...
//
// Prints a table. Sums: of 200 layers, and by Simpson's rule between the heights of all corners,
// which is exact but for rounding, since areas of slices are quadratic there; both beside the
// volume. Samples: how many of 20 layers are what section() returns. Times are those of
// processors, on one thread, the least of three, of 1000 layers of a mesh that was imported before;
// those of section() are ten times what a tenth of the layers takes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/bsp/modelling/projection.h>
#include <trisect/bsp/modelling/slices.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#ifdef TRISECT_BENCH_MANIFOLD
#include <manifold/manifold.h>
#endif

namespace {

using trisect::PolygonMesh;
using trisect::Slice;
using trisect::Solid;

double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double least_seconds(int rounds, const Work& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < rounds; ++i) {
        const double begin = processor_seconds();
        work();
        least = std::min(least, processor_seconds() - begin);
    }
    return least;
}

trisect::SliceOptions on_one_thread(trisect::SliceRule rule = trisect::SliceRule::Closed) {
    trisect::SliceOptions options;
    options.rule = rule;
    options.evaluate.threads = 1;
    return options;
}

std::vector<double> middles(double low, double high, int count) {
    std::vector<double> out;
    for (int i = 0; i < count; ++i) out.push_back(low + (i + 0.5) * ((high - low) / count));
    return out;
}

/// Heights of all corners; nothing where there are too many.
std::vector<double> corner_heights(const PolygonMesh& mesh) {
    std::vector<double> out;
    for (const auto& p : mesh.points) out.push_back(p[2]);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

double volume_by_simpson(const Solid& solid, const std::vector<double>& ends) {
    std::vector<double> between;
    for (std::size_t i = 1; i < ends.size(); ++i)
        between.push_back(ends[i - 1] + (ends[i] - ends[i - 1]) / 2);
    const auto above = slices(solid, ends, on_one_thread(trisect::SliceRule::Above));
    const auto below = slices(solid, ends, on_one_thread(trisect::SliceRule::Below));
    const auto middle = slices(solid, between, on_one_thread());
    double sum = 0;
    for (std::size_t i = 0; i < between.size(); ++i)
        sum += (ends[i + 1] - ends[i]) / 6 *
               (area(above[i]) + 4 * area(middle[i]) + area(below[i + 1]));
    return sum;
}

int equal_sections(const Solid& solid, const std::vector<Slice>& layers) {
    int equal = 0;
    for (std::size_t i = 0; i < 20; ++i) {
        const Slice& layer = layers[i * (layers.size() - 1) / 19];
        const trisect::PlaneRegion one = section(solid, layer.height);
        equal += one.points == layer.points && one.loops == layer.loops ? 1 : 0;
    }
    return equal;
}

#ifdef TRISECT_BENCH_MANIFOLD
/// Seconds, and the sum of areas; nothing where it refuses the mesh.
std::array<double, 2> by_manifold(const PolygonMesh& mesh, const std::vector<double>& heights) {
    manifold::MeshGL64 gl;
    gl.numProp = 3;
    for (const auto& p : mesh.points)
        gl.vertProperties.insert(gl.vertProperties.end(), p.begin(), p.end());
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (const std::uint32_t v : mesh.face(f)) gl.triVerts.push_back(v);
    gl.Merge();
    const manifold::Manifold solid(gl);
    if (solid.Status() != manifold::Manifold::Error::NoError) return {NAN, NAN};
    double sum = 0;
    const double seconds = least_seconds(3, [&] {
        sum = 0;
        for (const double z : heights)
            for (const auto& loop : solid.Slice(z))
                for (std::size_t i = 0; i < loop.size(); ++i) {
                    const auto& p = loop[i];
                    const auto& q = loop[(i + 1) % loop.size()];
                    sum += (p.x * q.y - p.y * q.x) / 2;
                }
    });
    return {seconds, sum};
}
#endif

void add_row(const std::string& file) {
    const Solid given =
        Solid::from_mesh(trisect::read_mesh(file), {.embedding = trisect::Embedding::Check});
    const Solid solid = evaluate(given);
    const PolygonMesh mesh = solid.to_mesh(1);
    if (mesh.face_count() == 0) throw trisect::UsageError("is empty");
    const std::vector<double> corners = corner_heights(mesh);
    const double low = corners.front();
    const double high = corners.back();
    const double volume = trisect::volume(solid);
    const std::vector<double> few = middles(low, high, 200);
    const std::vector<Slice> layers = slices(solid, few, on_one_thread());
    double sum = 0;
    for (const Slice& layer : layers) sum += area(layer) * (high - low) / 200;
    const std::vector<double> many = middles(low, high, 1000);
    std::size_t sides = 0;
    const double one_walk = least_seconds(3, [&] {
        sides = 0;
        for (const Slice& layer : slices(solid, many, on_one_thread()))
            sides += layer.points.size();
    });
    trisect::EvaluateOptions single;
    single.threads = 1;
    const double one_by_one = 10 * least_seconds(1, [&] {
                                  for (std::size_t i = 0; i < many.size(); i += 10)
                                      static_cast<void>(section(solid, many[i], single));
                              });
    std::printf("| %s | %zu | %.6g | %.1e | ", std::filesystem::path(file).filename().c_str(),
                mesh.face_count(), volume, (sum - volume) / volume);
    if (corners.size() <= 20000)
        std::printf("%.1e", (volume_by_simpson(solid, corners) - volume) / volume);
    std::printf(" | %d | %zu | %.4f | %.2f | ", equal_sections(solid, layers), sides, one_walk,
                one_by_one);
#ifdef TRISECT_BENCH_MANIFOLD
    const auto [seconds, areas] = by_manifold(mesh, many);
    std::printf("%.4f | %.1f |\n", seconds, one_walk / seconds);
    static_cast<void>(areas);
#else
    std::printf("| |\n");
#endif
}

}  // namespace

int main(int argc, char** argv) {
    std::printf(
        "| file | triangles | volume | 200 layers | Simpson | equal, of 20 | corners of 1000 "
        "layers "
        "| one walk, s | section() each, s | Manifold, s | ratio |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n");
    int failures = 0;
    for (int i = 1; i < argc; ++i) try {
            add_row(argv[i]);
        } catch (const std::exception& e) {
            std::fprintf(stderr, "%s: %s\n", argv[i], e.what());
            ++failures;
        }
    return failures == 0 ? 0 : 1;
}
