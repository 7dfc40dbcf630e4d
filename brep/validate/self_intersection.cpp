// SPDX-License-Identifier: Apache-2.0
//
// self_intersection and faces_touch: pairs of faces whose triangles meet in more than they share.
// Candidates come from a tree of boxes; each is decided exactly. Triangles of one planar, simple
// face are neighbours by construction and are not compared, nor are those of a sheet (sheets.h);
// those of a face that is not planar may fold onto each other and are. A face that crosses itself
// is reported as a pair of equal indices.

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include <trisect/brep/contact/triangle_contact.h>
#include <trisect/brep/validate/checked_mesh.h>
#include <trisect/brep/validate/sheets.h>
#include <trisect/brep/validate/triangle_tree.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

constexpr std::size_t found_limit = std::size_t{1} << 24;

struct FoundPair {
    std::uint32_t face_a, face_b;
    bool touch_only;
    std::uint32_t triangle_a, triangle_b;

    [[nodiscard]] auto key() const {
        return std::tuple(face_a, face_b, touch_only, triangle_a, triangle_b);
    }
};

std::vector<FoundPair> find_pairs(const CheckedMesh& m, const ValidateOptions& options) {
    const PreparedMesh& mesh = m.mesh;
    TriangleTree tree(mesh.points, mesh.triangles, find_sheets(mesh));
    std::vector<FoundPair> found;
    std::uint64_t pairs = 0;
    tree.for_each_pair([&](std::uint32_t a, std::uint32_t b) {
        check_stop();
        if (++pairs > options.pair_limit)
            throw LimitError("validation stopped after " + std::to_string(options.pair_limit) +
                             " pairs of faces");
        std::uint32_t fa = mesh.face_of_triangle[a];
        std::uint32_t fb = mesh.face_of_triangle[b];
        if (fa == fb &&
            !std::binary_search(mesh.nonplanar_faces.begin(), mesh.nonplanar_faces.end(), fa))
            return true;
        const auto kind = find_contact(mesh.points, mesh.triangles[a], mesh.triangles[b]).kind;
        if (kind == ContactKind::None) return true;
        if (fa > fb) std::swap(fa, fb);
        found.push_back({fa, fb, kind == ContactKind::Touch, a, b});
        if (found.size() > found_limit)
            throw LimitError("validation stopped after " + std::to_string(found_limit) +
                             " intersecting pairs of triangles");
        return !options.until_first;
    });
    // One report for a pair of faces, the worst one.
    std::sort(found.begin(), found.end(),
              [](const FoundPair& x, const FoundPair& y) { return x.key() < y.key(); });
    found.erase(std::unique(found.begin(), found.end(),
                            [](const FoundPair& x, const FoundPair& y) {
                                return x.face_a == y.face_a && x.face_b == y.face_b;
                            }),
                found.end());
    return found;
}

Defect describe(const CheckedMesh& m, const FoundPair& p, DefectKind kind) {
    const auto contact =
        find_contact(m.mesh.points, m.mesh.triangles[p.triangle_a], m.mesh.triangles[p.triangle_b]);
    const auto c = contact.witness.nearest();
    const Lattice lattice = m.mesh.report.lattice;
    const Point3d place{lattice.to_double(c[0]), lattice.to_double(c[1]), lattice.to_double(c[2])};
    std::string s;
    if (p.face_a == p.face_b) {
        s = "face " + std::to_string(p.face_a) + " meets itself";
    } else {
        s = "faces " + std::to_string(p.face_a) + " and " + std::to_string(p.face_b);
        s += contact.kind == ContactKind::Touch
                 ? " touch"
                 : (contact.kind == ContactKind::Overlap ? " overlap in their plane" : " cross");
    }
    return Defect{kind, {}, {p.face_a, p.face_b}, place, s + " at " + place_text(place)};
}

}  // namespace

void check_self_intersections(const CheckedMesh& m, const ValidateOptions& options,
                              ValidationReport& report) {
    if (!options.self_intersection) return;
    for (const FoundPair& p : find_pairs(m, options)) {
        const auto kind = p.touch_only ? DefectKind::FacesTouch : DefectKind::SelfIntersection;
        report.add(kind, [&] { return describe(m, p, kind); });
    }
}

}  // namespace trisect::detail
