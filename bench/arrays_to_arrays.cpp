// SPDX-License-Identifier: Apache-2.0
//
// Times the union of two meshes, from arrays to arrays, in C++: what bindings are compared with.
//
//     bench_arrays A B
//
// A and B are mesh files. For each line "THREADS REPEATS" of standard input it takes that many
// turns and prints one line: the median in microseconds of wall time and of processor time. The
// meshes are there as PolygonMesh before the clock starts.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <iostream>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace {

using namespace trisect;  // NOLINT(google-build-using-namespace)

double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

std::size_t unite(const PolygonMesh& a, const PolygonMesh& b, std::uint32_t threads) {
    SolidOptions options;
    options.import.threads = threads;
    EvaluateOptions evaluating;
    evaluating.threads = threads;
    const Solid first = Solid::from_mesh(a, options);
    const Solid second = Solid::from_mesh(b, options);
    return evaluate(first | second, evaluating).to_mesh(threads).face_count();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: bench_arrays A B\n";
        return 2;
    }
    const PolygonMesh a = read_mesh(argv[1]);
    const PolygonMesh b = read_mesh(argv[2]);
    std::uint32_t threads = 0;
    std::size_t repeats = 0;
    while (std::cin >> threads >> repeats && repeats != 0) {
        std::vector<double> wall;
        std::vector<double> processor;
        std::size_t triangles = 0;
        for (std::size_t i = 0; i < repeats; ++i) {
            const auto begin = std::chrono::steady_clock::now();
            const double before = processor_seconds();
            triangles += unite(a, b, threads);
            processor.push_back(1e6 * (processor_seconds() - before));
            wall.push_back(
                std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
                    .count());
        }
        std::cout << median(wall) << ' ' << median(processor) << ' ' << triangles / repeats
                  << std::endl;
    }
}
