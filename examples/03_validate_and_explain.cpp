// SPDX-License-Identifier: Apache-2.0
//
// A mesh that bounds nothing is refused, with every reason and its place; nothing is repaired in
// silence. Two boxes in one mesh that overlap are a different matter: closed, but not embedded.

#include <iostream>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/trisect.h>

namespace {

using namespace trisect;

// A box whose first face is missing and whose last one is turned over.
PolygonMesh broken_box() {
    const PolygonMesh box = make_box({1, 1, 1});
    PolygonMesh broken;
    broken.points = box.points;
    for (std::size_t f = 1; f < box.face_count(); ++f) {
        std::vector<std::uint32_t> loop(box.face(f).begin(), box.face(f).end());
        if (f + 1 == box.face_count()) loop = {loop.rbegin(), loop.rend()};
        broken.add_face(loop);
    }
    return broken;
}

// Two boxes that overlap in a unit cube, in one mesh.
PolygonMesh overlapping_boxes() {
    PolygonMesh both = make_box({2, 2, 2});
    const PolygonMesh other = make_box({1, 1, 1}, {3, 3, 3});
    const auto first = static_cast<std::uint32_t>(both.points.size());
    both.points.insert(both.points.end(), other.points.begin(), other.points.end());
    for (std::size_t f = 0; f < other.face_count(); ++f) {
        std::vector<std::uint32_t> loop(other.face(f).begin(), other.face(f).end());
        for (std::uint32_t& corner : loop) corner += first;
        both.add_face(loop);
    }
    return both;
}

}  // namespace

int main() {
    bool refused = false;
    try {
        const Solid solid = Solid::from_mesh(broken_box());
    } catch (const InvalidSolid& e) {
        refused = true;
        std::cout << e.what() << "\n\n";
    }

    const ValidationReport report = validate(overlapping_boxes());
    std::cout << report.to_string();
    const bool found = report.count(DefectKind::SelfIntersection) != 0;

    // The winding number is positive in the union of the two boxes, so that is what this solid is.
    SolidOptions options;
    options.embedding = Embedding::Resolve;
    const Solid resolved = evaluate(Solid::from_mesh(overlapping_boxes(), options));
    const Brep brep = resolved.to_brep();
    std::cout << "\nresolved: volume " << volume(brep) << ", " << brep.counts().faces << " faces\n";
    return refused && found && exact_volume(brep) == ExactRational(15) ? 0 : 1;
}
