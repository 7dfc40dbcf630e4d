// SPDX-License-Identifier: Apache-2.0
//
// Divides a solid into convex parts, and proves that a decomposition is one.
//
// Physics engines take convex parts. Whether parts that some program made are convex, do not
// overlap, and fill the whole: each of these is a question with an exact answer.

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <trisect/trisect.h>

namespace {

using namespace trisect;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

bool is_convex(const Solid& solid) {
    const Solid hull = Solid::from_mesh(make_hull(solid.to_mesh().points));
    return evaluate(hull ^ solid).is_empty();
}

// A plane of a face with an edge at which the solid is not convex: the plane of a triangle, if the
// third corner of a neighbour is above it.
std::optional<std::array<double, 4>> reflex_plane(const PolygonMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> opposite;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            opposite[{mesh.face(f)[i], mesh.face(f)[(i + 1) % 3]}] = mesh.face(f)[(i + 2) % 3];
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.face(f);
        const Point3d& a = mesh.points[corners[0]];
        Point3d u{};
        Point3d v{};
        for (std::size_t k = 0; k < 3; ++k) {
            u[k] = mesh.points[corners[1]][k] - a[k];
            v[k] = mesh.points[corners[2]][k] - a[k];
        }
        const Point3d normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                             u[0] * v[1] - u[1] * v[0]};
        const double offset = -(normal[0] * a[0] + normal[1] * a[1] + normal[2] * a[2]);
        for (std::size_t i = 0; i < 3; ++i) {
            const Point3d& p = mesh.points[opposite.at({corners[(i + 1) % 3], corners[i]})];
            if (normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] + offset > 1e-9)
                return std::array<double, 4>{normal[0], normal[1], normal[2], offset};
        }
    }
    return std::nullopt;
}

// Cuts along planes of faces until all is convex. Doubles choose the planes; cuts are exact.
std::vector<Solid> convex_parts(const Solid& solid) {
    std::vector<Solid> parts;
    std::vector<Solid> open{solid};
    while (!open.empty()) {
        const Solid piece = open.back();
        open.pop_back();
        const auto plane = reflex_plane(piece.to_mesh());
        if (!plane) {
            parts.push_back(piece);
            continue;
        }
        const Solid below = Solid::half_space(*plane);
        for (const Solid& half : {evaluate(piece & below), evaluate(piece - below)})
            for (const Solid& c : components(half)) open.push_back(c);
    }
    return parts;
}

// Why the parts are no convex decomposition of the solid, or nothing.
std::optional<std::string> wrong(const Solid& solid, std::span<const Solid> parts) {
    Scene scene;
    for (const Solid& part : parts) {
        if (!is_convex(part)) return "a part is not convex";
        scene.add(part);
    }
    for (const ScenePair& pair : scene.interfering())
        if (interiors_meet(pair.relation)) return "parts overlap";
    const Expression all = Expression::any_of(parts);
    if (!evaluate(solid - all).is_empty()) return "some of the solid is in no part";
    if (!evaluate(all - solid).is_empty()) return "parts stick out";
    return std::nullopt;
}

// A U-profile with a window and a foot, on a grid, so that corners of parts are doubles.
Solid profile() {
    const auto box = [](const Point3d& low, const Point3d& high) {
        return Solid::from_mesh(make_box(low, high));
    };
    const Solid foot = Solid::from_mesh(make_extrusion({{8, 0}, {12, 0}, {8, 4}}, {}, 0, 6));
    return evaluate(
        ((box({0, 0, 0}, {8, 6, 6}) - box({2, -1, 2}, {6, 7, 7})) - box({-1, 2, 3}, {9, 4, 5})) |
        foot);
}

}  // namespace

int main() {
    const Solid solid = profile();
    std::vector<Solid> parts = convex_parts(solid);
    expect(!wrong(solid, parts), "a decomposition");
    ExactRational sum;
    std::size_t triangles = 0;
    for (const Solid& part : parts) {
        sum += exact_volume(part);
        triangles += counts(part).triangles;
        write_mesh("convex_part_" + std::to_string(&part - parts.data()) + ".stl", part.to_mesh());
    }
    expect(sum == exact_volume(solid), "volumes add up");

    // What is wrong is found: a part missing, one moved by a millionth, one that is not convex.
    expect(wrong(solid, std::span(parts).subspan(1)) == "some of the solid is in no part", "a gap");
    expect(wrong(solid, {&solid, 1}) == "a part is not convex", "not convex");
    std::cout << counts(solid).triangles << " triangles into " << parts.size()
              << " convex parts of " << triangles << '\n';
    parts[0] = transformed(parts[0], AffineMap::translation({std::ldexp(1, -20), 0, 0}));
    expect(wrong(solid, parts).has_value(), "moved by a millionth");
    return 0;
}
