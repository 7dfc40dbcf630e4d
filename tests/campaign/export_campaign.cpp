// SPDX-License-Identifier: Apache-2.0
//
// Certified exports: results of booleans are rounded, certified, and repaired where plain rounding
// fails.
//
//     export_campaign [--count N] [--seed S] [--minutes M] [MESH...]
//
// N results, doubles and floats in turn. Most are of random solids on a small grid under rational
// turns, two or three operands; every 16th is of the meshes given, if any: one with itself, turned
// and moved. Prints a line for each kind with the numbers of plain, gridded, repaired and failed
// roundings; exits with 1 when one is failed. The same seed gives the same results.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/bsp/certified_rounding.h>
#include <trisect/bsp/solid.h>

#include "engines/engines.h"
#include "reference/random_solids.h"

namespace {

using trisect::CertifiedRounding;
using trisect::Expression;
using trisect::PolygonMesh;
using trisect::Solid;
using Outcome = CertifiedRounding::Outcome;

struct Options {
    std::uint64_t count = 1000;
    std::uint64_t seed = 1;
    double minutes = 1e9;
    std::vector<PolygonMesh> meshes;
};

Options options_of(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        const auto value = [&] {
            if (++i >= argc) {
                std::fprintf(stderr, "%s: a number is missing\n", name.c_str());
                std::exit(2);
            }
            return argv[i];
        };
        if (name == "--count")
            o.count = std::strtoull(value(), nullptr, 10);
        else if (name == "--seed")
            o.seed = std::strtoull(value(), nullptr, 10);
        else if (name == "--minutes")
            o.minutes = std::strtod(value(), nullptr);
        else
            o.meshes.push_back(trisect::read_mesh(name));
    }
    return o;
}

// Turned by a quaternion of small integers and moved: coordinates fill their doubles.
PolygonMesh moved(PolygonMesh mesh, reference::Random& random, double step) {
    std::array<double, 4> q{};
    for (double& x : q) x = static_cast<double>(random.between(-3, 3));
    q[0] += 4;
    const double n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    const auto [w, x, y, z] = q;
    const std::array<std::array<double, 3>, 3> m{
        {{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
         {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
         {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}};
    std::array<double, 3> by{};
    for (double& b : by) b = step * static_cast<double>(random.between(-4, 4));
    for (trisect::Point3d& p : mesh.points) {
        trisect::Point3d r{};
        for (std::size_t i = 0; i < 3; ++i)
            r[i] = (m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2]) / n + by[i];
        p = r;
    }
    return mesh;
}

PolygonMesh mesh_of(const reference::Operand& operand) {
    const trisect::LatticeMesh lattice = engines::lattice_mesh(operand);
    PolygonMesh mesh;
    for (const trisect::LatticePoint& p : lattice.points)
        mesh.points.push_back(to_user(p, lattice.lattice));
    for (const auto& t : lattice.triangles) mesh.add_triangle(t[0], t[1], t[2]);
    return mesh;
}

Solid grid_solid(reference::Random& random, bool turned) {
    const reference::Operand operand = reference::random_embedded_solid(random);
    if (!turned) return engines::solid(operand);
    trisect::SolidOptions options;
    options.embedding = trisect::Embedding::Resolve;
    return Solid::from_mesh(moved(mesh_of(operand), random, 0.5), options);
}

Expression combined(const Expression& a, const Expression& b, std::uint64_t how) {
    switch (how % 4) {
        case 0:
            return a | b;
        case 1:
            return a & b;
        case 2:
            return a - b;
        default:
            return a ^ b;
    }
}

double extent_of(const PolygonMesh& mesh) {
    double largest = 0;
    for (const trisect::Point3d& p : mesh.points)
        for (const double c : p) largest = std::max(largest, std::abs(c));
    return largest;
}

struct Tally {
    std::array<std::uint64_t, 4> outcomes{};
    std::uint64_t plain_meets = 0;  // faces meet after rounding to one unit
    std::size_t rounds = 0;
    double radius = 0;  // relative to the extent

    void add(const CertifiedRounding& r) {
        ++outcomes[static_cast<std::size_t>(r.outcome)];
        plain_meets += r.first_pairs > 0 ? 1 : 0;
        rounds = std::max(rounds, r.rounds);
        const double extent = extent_of(r.mesh);
        if (extent > 0) radius = std::max(radius, r.radius / extent);
    }
    void print(const char* name) const {
        std::uint64_t all = 0;
        for (const std::uint64_t n : outcomes) all += n;
        std::printf("%-22s %7llu %7llu %7llu %7llu %7llu   %2zu   %.2g\n", name,
                    static_cast<unsigned long long>(all),
                    static_cast<unsigned long long>(outcomes[0]),
                    static_cast<unsigned long long>(outcomes[1]),
                    static_cast<unsigned long long>(outcomes[2]),
                    static_cast<unsigned long long>(outcomes[3]), rounds, radius);
    }
};

Expression result(std::uint64_t i, const Options& o, bool is_mesh) {
    reference::Random random(o.seed * 1000003 + i);
    if (is_mesh) {
        const PolygonMesh& mesh = o.meshes[i / 16 % o.meshes.size()];
        const Solid a = Solid::from_mesh(mesh);
        const Solid b = Solid::from_mesh(moved(mesh, random, extent_of(mesh) / 16));
        return combined(Expression(a), Expression(b), i / 32);
    }
    const bool turned = i % 4 != 0;
    const Solid a = grid_solid(random, false);
    const Solid b = grid_solid(random, turned);
    const Expression e = combined(Expression(a), Expression(b), random.below(4));
    if (random.chance(1, 2)) return e;
    return combined(e, Expression(grid_solid(random, turned)), random.below(4));
}

}  // namespace

int main(int argc, char** argv) {
    const Options o = options_of(argc, argv);
    const auto start = std::chrono::steady_clock::now();
    std::array<std::array<Tally, 2>, 2> tallies;
    std::uint64_t failed = 0;
    for (std::uint64_t i = 0; i < o.count; ++i) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        if (spent.count() > o.minutes * 60) break;
        const bool is_mesh = !o.meshes.empty() && i % 16 == 15;
        trisect::RoundingOptions rounding;
        const bool floats = (is_mesh ? i / 16 : i / 2) % 2 == 1;
        if (floats) rounding.precision = trisect::Precision::Float;
        const trisect::Brep brep = evaluate(result(i, o, is_mesh)).to_brep();
        const CertifiedRounding r = certified_rounding(brep, rounding);
        tallies[is_mesh ? 1 : 0][floats ? 1 : 0].add(r);
        if (r.outcome == Outcome::Failed) {
            ++failed;
            std::printf("failed: number %llu, %zu pairs left after %zu rounds\n",
                        static_cast<unsigned long long>(i),
                        r.certificate.self_intersecting_pairs.value_or(0), r.rounds);
        }
    }
    std::printf("%-22s %7s %7s %7s %7s %7s %s %s\n", "", "results", "plain", "gridded", "repair",
                "failed", "rounds", "radius/extent");
    tallies[0][0].print("small grid, doubles");
    tallies[0][1].print("small grid, floats");
    if (!o.meshes.empty()) {
        tallies[1][0].print("meshes, doubles");
        tallies[1][1].print("meshes, floats");
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    std::printf("%.0f s\n", spent.count());
    return failed == 0 ? 0 : 1;
}
