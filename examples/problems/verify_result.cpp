// SPDX-License-Identifier: Apache-2.0
//
// Checks what another program computed: is this mesh the union of those two?
//
//     verify_result [a.obj b.obj result.obj]
//
// The answer is proved: equal, equal within a distance, or different with a point that anybody can
// check with a page of integer arithmetic.

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <vector>

#include <trisect/trisect.h>

namespace {

using namespace trisect;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

void print(const char* name, const VerifyReport& report) {
    std::cout << name << ": " << to_string(report.verdict);
    if (report.verdict == Verdict::Within)
        std::cout << ", no point is wrong by more than " << report.upper;
    if (report.verdict == Verdict::NotClosed)
        std::cout << ", " << report.result_defects.defects().at(0).sentence;
    if (report.witness) {
        const auto& [x, y, z] = report.witness->point;
        std::cout << ", "
                  << (report.witness->in_exact ? "the mesh lacks" : "the mesh has too much:")
                  << " (" << x.to_double() << ", " << y.to_double() << ", " << z.to_double() << ')';
    }
    std::cout << '\n';
}

VerifyReport verify_union(const std::vector<PolygonMesh>& operands, const PolygonMesh& result,
                          double within) {
    return verify(BooleanOperation::Union, operands, result, {.within = within});
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 4) {
        const std::vector<PolygonMesh> operands{read_mesh(argv[1]), read_mesh(argv[2])};
        print("result", verify(BooleanOperation::Union, operands, read_mesh(argv[3])));
        return 0;
    }
    // Two blocks, and what some kernels might make of their union.
    const PolygonMesh a = make_box({4, 3, 2});
    const PolygonMesh b = transformed(
        make_box({3, 3, 3}),
        compose(AffineMap::translation({1, 0.5, 0.25}), AffineMap::rotation({1, 2, 3}, 40)));
    const std::vector<PolygonMesh> operands{a, b};
    const auto solid = [](const PolygonMesh& mesh) { return Solid::from_mesh(mesh); };
    const PolygonMesh made = evaluate(solid(a) | solid(b)).to_mesh();

    // 1. Ours, rounded to doubles: no point is wrong by more than the last bits.
    const VerifyReport ours = verify_union(operands, made, 1e-14);
    print("in doubles      ", ours);
    expect(ours.verdict == Verdict::Within, "our own result");

    // 2. In floats, as in a binary STL. Is that good enough? For a printer, not for a proof.
    PolygonMesh floats = made;
    for (Point3d& p : floats.points)
        for (double& c : p) c = static_cast<float>(c);
    print("in floats       ", verify_union(operands, floats, 1e-6));
    expect(verify_union(operands, floats, 1e-6).verdict == Verdict::Within, "a millionth");
    expect(verify_union(operands, floats, 1e-9).verdict == Verdict::Different, "a billionth");

    // 3. A kernel that lost a small piece: a tip was flattened.
    PolygonMesh flat = made;
    std::ranges::max_element(flat.points, {}, [](const Point3d& p) { return p[2]; })->at(2) -= 0.01;
    const VerifyReport lost = verify_union(operands, flat, 1e-3);
    print("with a flat tip ", lost);
    expect(lost.verdict == Verdict::Different && lost.witness->in_exact && !lost.witness->in_result,
           "the tip is missing");
    // The witness by itself: it is in one of the operands, and not in the result.
    const std::vector<int>& winding = lost.witness->winding;
    expect((winding[0] != 0 || winding[1] != 0) && winding[2] == 0, "the witness");

    // 4. The wrong operation, and a mesh with a hole.
    print("the intersection", verify_union(operands, evaluate(solid(a) & solid(b)).to_mesh(), 0.1));
    PolygonMesh holed = made;
    holed.corners.resize(holed.corners.size() - 3);
    holed.face_begin.pop_back();
    const VerifyReport open = verify_union(operands, holed, 0.1);
    print("with a hole     ", open);
    expect(open.verdict == Verdict::NotClosed, "a hole");
    return 0;
}
