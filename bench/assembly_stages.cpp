// SPDX-License-Identifier: Apache-2.0
//
// What it takes to turn the cells of a result into arrays (to_mesh) and into a B-rep, scene by
// scene, and a hash of everything that comes out: a change that only makes assembly faster leaves
// all hashes as they are.
//
//     assembly_stages [--runs 5] [--scene NAME]...
//
// The bunny and the armadillo come from the folder large/ of TRISECT_MODELS and are left out when
// they are absent.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "shapes.h"

namespace {

using trisect::Brep;
using trisect::Expression;
using trisect::PolygonMesh;
using trisect::Solid;
using Clock = std::chrono::steady_clock;

class Hash {
public:
    void add(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) h_ = (h_ ^ bytes[i]) * 0x100000001b3ULL;
    }
    template <class T>
    void add(const T& value) {
        add(&value, sizeof value);
    }
    [[nodiscard]] std::uint64_t value() const { return h_; }

private:
    std::uint64_t h_ = 0xcbf29ce484222325ULL;
};

std::uint64_t hash_of(const PolygonMesh& mesh) {
    Hash h;
    for (const auto& p : mesh.points) h.add(p);
    for (const std::uint32_t c : mesh.corners) h.add(c);
    for (const std::uint32_t f : mesh.face_begin) h.add(f);
    return h.value();
}

// Operands are named by the difference of their serials to the smallest one.
std::uint64_t hash_of(const Brep& brep) {
    Hash h;
    std::uint32_t first = ~0U;
    for (const auto f : brep.faces()) first = std::min(first, brep.source(f).operand);
    for (const auto v : brep.vertices()) {
        h.add(brep.point(v).nearest());
        h.add(brep.outgoing(v).index);
        for (const auto c : brep.copies(v)) h.add(c.index);
    }
    for (const auto e : brep.halfedges()) {
        h.add(brep.origin(e).index);
        h.add(brep.twin(e).index);
        h.add(brep.edge(e).index);
        h.add(brep.loop(e).index);
    }
    for (const auto e : brep.edges())
        for (const auto c : brep.copies(e)) h.add(c.index);
    for (const auto f : brep.faces()) {
        h.add(brep.source(f).operand - first);
        h.add(brep.source(f).face);
        h.add(brep.outer_loop(f).index);
        h.add(brep.shell(f).index);
        for (int k = 0; k < 3; ++k) h.add(brep.plane(f).approx_normal(k));
        h.add(brep.plane(f).approx_offset());
    }
    return h.value();
}

struct Scene {
    std::string name;
    std::function<Solid()> make;
};

Solid combine(const std::vector<Solid>& solids) {
    const std::vector<Expression> terms(solids.begin(), solids.end());
    return trisect::evaluate(Expression::any_of(terms));
}

Solid box(const trisect::Point3d& low, const trisect::Point3d& high) {
    return Solid::from_mesh(trisect::make_box(low, high));
}

Solid with_turned(const PolygonMesh& mesh, char operation) {
    const Solid a = Solid::from_mesh(mesh);
    const Solid b = Solid::from_mesh(shapes::turned(mesh));
    if (operation == '|') return trisect::evaluate(a | b);
    return trisect::evaluate(operation == '&' ? a & b : a - b);
}

Solid spheres(int level) {
    const PolygonMesh sphere = shapes::icosphere(level);
    return trisect::evaluate(Solid::from_mesh(sphere) |
                             Solid::from_mesh(shapes::moved(sphere, shapes::along_1_2_3(0.5))));
}

Solid touching_cubes(int n) {
    std::vector<Solid> cubes;
    for (int i = 0; i < n * n * n; ++i) {
        const double x = i % n;
        const double y = i / n % n;
        const double z = i / n / n;  // NOLINT(bugprone-integer-division)
        if (i % 3 != 1) cubes.push_back(box({x, y, z}, {x + 1, y + 1, z + 1}));
    }
    return combine(cubes);
}

Solid sponge(int level) {
    int side = 1;
    for (int i = 0; i < level; ++i) side *= 3;
    Solid solid = box({0, 0, 0}, {1.0 * side, 1.0 * side, 1.0 * side});
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<Solid> bars;
        for (int hole = side / 3; hole >= 1; hole /= 3) {
            for (int i = hole; i < side; i += 3 * hole) {
                for (int j = hole; j < side; j += 3 * hole) {
                    trisect::Point3d low{-1, -1, -1};
                    trisect::Point3d high{side + 1.0, side + 1.0, side + 1.0};
                    low[(axis + 1) % 3] = i;
                    high[(axis + 1) % 3] = i + hole;
                    low[(axis + 2) % 3] = j;
                    high[(axis + 2) % 3] = j + hole;
                    bars.push_back(box(low, high));
                }
            }
        }
        solid = trisect::evaluate(solid - combine(bars));
    }
    return solid;
}

Solid turned_cubes(int n) {
    std::vector<Solid> cubes;
    for (int i = 0; i < n; ++i)
        cubes.push_back(Solid::from_mesh(
            trisect::transformed(trisect::make_box({-1, -1, -1}, {1, 1, 1}),
                                 trisect::AffineMap::rotation({0, 0, 1}, 90.0 * i / n))));
    return combine(cubes);
}

Solid milled_block(int cuts) {
    Solid block = box({0, 0, 0}, {1, 1, 1});
    const PolygonMesh tool =
        trisect::transformed(shapes::icosphere(2), trisect::AffineMap::scaling({0.05, 0.05, 0.05}));
    for (int i = 0; i < cuts; ++i)
        block = trisect::evaluate(
            block - Solid::from_mesh(shapes::moved(
                        tool, {0.1 + 0.0123 * (i % 20), 0.1 + 0.0311 * (i / 20), 1.0})));
    return block;
}

Solid engraved_plate(int n) {
    std::vector<Solid> tools;
    for (int i = 0; i < n * n; ++i) {
        const double x = 4.0 * (i % n) + 1;
        const double y = 4.0 * (i / n) + 1;  // NOLINT(bugprone-integer-division)
        tools.push_back(box({x, y, 1}, {x + 2, y + 2, 3}));
    }
    return trisect::evaluate(box({0, 0, 0}, {4.0 * n, 4.0 * n, 2}) - combine(tools));
}

std::vector<Scene> all_scenes() {
    std::vector<Scene> out;
    const char* models = std::getenv("TRISECT_MODELS");
    const std::filesystem::path folder =
        std::filesystem::path(models == nullptr ? "../shared/models" : models) / "large";
    for (const char* name : {"bunny100k", "armadillo"}) {
        const auto path = folder / (std::string(name) + ".obj");
        if (!std::filesystem::exists(path)) continue;
        for (const char operation : {'|', '&', '-'})
            out.push_back(
                {std::string(name) + (operation == '|'   ? "-union"
                                      : operation == '&' ? "-both"
                                                         : "-minus"),
                 [path, operation] { return with_turned(trisect::read_mesh(path), operation); }});
    }
    out.push_back({"spheres", [] { return spheres(6); }});
    out.push_back({"cubes", [] { return touching_cubes(6); }});
    out.push_back({"sponge", [] { return sponge(3); }});
    out.push_back({"turned", [] { return turned_cubes(20); }});
    out.push_back({"mill", [] { return milled_block(100); }});
    out.push_back({"plate", [] { return engraved_plate(100); }});
    return out;
}

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

void measure(const Scene& scene, int runs) {
    const Solid solid = scene.make();
    std::vector<double> mesh_times;
    std::vector<double> brep_times;
    PolygonMesh mesh;
    Brep brep;
    for (int i = 0; i < runs; ++i) {
        auto start = Clock::now();
        mesh = trisect::detail::assemble_mesh(*trisect::detail::state_of(solid));
        mesh_times.push_back(milliseconds_since(start));
        start = Clock::now();
        brep = trisect::detail::assemble_brep(*trisect::detail::state_of(solid), {});
        brep_times.push_back(milliseconds_since(start));
    }
    const Brep faces =
        trisect::detail::assemble_brep(*trisect::detail::state_of(solid), {.maximal_faces = false});
    std::printf("| %s | %zu | %.2f | %016llx | %zu | %.2f | %016llx | %016llx |\n",
                scene.name.c_str(), mesh.face_count(), median(mesh_times),
                static_cast<unsigned long long>(hash_of(mesh)), brep.counts().faces,
                median(brep_times), static_cast<unsigned long long>(hash_of(brep)),
                static_cast<unsigned long long>(hash_of(faces)));
    std::fflush(stdout);
}

int run(int runs, const std::vector<std::string>& names) {
    std::printf(
        "| scene | triangles | to_mesh ms | hash | faces | to_brep ms | hash | hash of "
        "operand faces |\n|---|---:|---:|---|---:|---:|---|---|\n");
    for (const Scene& scene : all_scenes())
        if (names.empty() || std::ranges::find(names, scene.name) != names.end())
            measure(scene, runs);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    int runs = 5;
    std::vector<std::string> names;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (std::strcmp(argv[i], "--runs") == 0) runs = std::max(1, std::atoi(argv[i + 1]));
        if (std::strcmp(argv[i], "--scene") == 0) names.emplace_back(argv[i + 1]);
    }
    try {
        return run(runs, names);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "assembly_stages: %s\n", e.what());
        return 1;
    }
}
