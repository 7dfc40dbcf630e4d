// SPDX-License-Identifier: Apache-2.0
//
// Six holes are drilled into a plate, one after the other and in one formula. Both ways lead to the
// same set, and every face of the result knows which face of which operand it came from.

#include <iostream>
#include <map>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/trisect.h>

namespace {

using namespace trisect;

// All operands on one lattice: none has to be moved to the lattice of another.
Solid solid_of(const PolygonMesh& mesh) {
    SolidOptions options;
    options.import.lattice = Lattice{-40};
    return Solid::from_mesh(mesh, options);
}

Solid drill_at(double x, double y) {
    const PolygonMesh drill = make_cylinder(0.5, 3, 24);
    return solid_of(transformed(drill, AffineMap::translation({x, y, -1})));
}

}  // namespace

int main() {
    const Solid plate = solid_of(make_box({8, 4, 1}));
    std::vector<Solid> drills;
    for (const double x : {1.5, 4.0, 6.5})
        for (const double y : {1.0, 3.0}) drills.push_back(drill_at(x, y));

    // Each step works on the cells of the one before and shares those that the drill does not
    // enter.
    Solid step_by_step = plate;
    EvaluateCounters last;
    for (const Solid& drill : drills) {
        const Diagnostics<EvaluateCounters> diagnostics;
        step_by_step = evaluate(step_by_step - drill);
        last = diagnostics.counters();
    }
    std::cout << "last step: " << last.cells << " cells, " << last.shared_cells << " shared\n";

    const std::vector<Expression> terms(drills.begin(), drills.end());
    const Solid at_once = evaluate(plate - Expression::any_of(terms));
    const bool same = evaluate(step_by_step ^ at_once).is_empty();
    std::cout << "step by step and at once: " << (same ? "the same set" : "different sets") << '\n';

    const Brep brep = at_once.to_brep();
    std::map<std::uint32_t, int> faces;  // by operand
    for (const FaceId f : brep.faces()) ++faces[brep.source(f).operand];
    std::cout << brep.counts().faces << " faces, " << faces[plate.source_id()]
              << " of them of the plate, genus " << brep.genus(ShellId(0)) << ", volume "
              << volume(brep) << '\n';

    write_mesh("expression_chain.off", at_once.to_mesh());
    return same && faces[plate.source_id()] == 6 && brep.genus(ShellId(0)) == 6 ? 0 : 1;
}
