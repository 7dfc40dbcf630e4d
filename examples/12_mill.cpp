// SPDX-License-Identifier: Apache-2.0
//
// Milling, step by step: a cutter goes round in a block, deeper with every turn. Each step is the
// solid that the cutter sweeps; it is subtracted, and at once the holder is checked against what is
// left. Everything is exact: the holder may rest on the block, but not enter it by any amount. The
// command `trisect mill` does this with programs in G-code.
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/convex_sweep.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/trisect.h>

namespace {

using trisect::LatticeMesh;
using trisect::Point3d;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;

// All coordinates are multiples of 2^-24, the stock's too: sums of two are exact, so all copies of
// the tool are congruent, and a cut costs what is near it.
constexpr trisect::Lattice lattice{-24};

double on_lattice(double v) { return std::round(std::ldexp(v, -lattice.exponent)); }

LatticeMesh on_lattice(const trisect::PolygonMesh& mesh) {
    trisect::ImportOptions options;
    options.lattice = lattice;
    return import_mesh(mesh, options).mesh;
}

}  // namespace

int main() {
    Solid stock = Solid::from_lattice_mesh(on_lattice(trisect::make_box({40, 40, 20})));
    // The hull takes back what rounding bent.
    const LatticeMesh cutter =
        hull_mesh(on_lattice(trisect::make_cylinder(3, 12, 24)).points, lattice);
    trisect::PolygonMesh above = trisect::make_cylinder(8, 10, 32);
    for (Point3d& p : above.points) p[2] += 12;
    const Solid holder = Solid::from_mesh(above);

    const double block = volume(stock);
    double removed = 0;
    std::array<double, 3> at{on_lattice(30), on_lattice(20), on_lattice(20)};
    for (int step = 1; step <= 120; ++step) {
        // A helix of radius 10, one unit deeper with each turn of 40 steps.
        const double angle = 2 * std::numbers::pi * step / 40;
        const std::array<double, 3> to{on_lattice(20 + 10 * std::cos(angle)),
                                       on_lattice(20 + 10 * std::sin(angle)),
                                       on_lattice(20 - step / 40.0)};
        const std::array<double, 3> way{to[0] - at[0], to[1] - at[1], to[2] - at[2]};
        // Where the cutter stands nothing is left of the block: its leading half is enough.
        const LatticeMesh part = step == 1 ? cutter : leading_part(cutter, way);
        const Solid swept = Solid::from_lattice_mesh(trisect::swept(moved(part, at), way));
        removed += volume(evaluate(stock & swept));
        stock = evaluate(stock - swept);
        at = to;

        const Pose pose = Pose::from_translation(
            {lattice.to_double(at[0]), lattice.to_double(at[1]), lattice.to_double(at[2])});
        const Relation relation = interfere(stock, Pose(), holder, pose).relation;
        if (relation == Relation::Disjoint || relation == Relation::Touching) continue;
        std::cout << "step " << step << ": the holder is in the stock\n";
        return 1;
    }
    std::cout << "removed " << removed << " of " << block << "\n";
    // Two sums that were rounded in different places.
    return std::abs(block - volume(stock) - removed) < 1e-9 * block ? 0 : 1;
}
