// SPDX-License-Identifier: Apache-2.0

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <manifold/manifold.h>

#include "node.h"
#include "originals.h"
#include "planar.h"

namespace manifold {

using Error = Manifold::Error;

Manifold new_original(TriMesh mesh) {
    const int id = static_cast<int>(Manifold::ReserveIDs(1));
    mesh.run.assign(mesh.corners.size(), 0);
    mesh.runs.assign(1, {.original = id});
    mesh.face = flat_faces(mesh);
    return Manifold(ManifoldNode::of_mesh(std::move(mesh), id));
}

namespace {

Manifold failed() { return Manifold(ManifoldNode::of_error(Error::InvalidConstruction)); }

Polygons circle(double radius, int sides) {
    SimplePolygon points;
    for (int i = 0; i < sides; ++i) {
        const double angle = 360.0 * i / sides;
        points.push_back({radius * cosd(angle), radius * sind(angle)});
    }
    return {points};
}

}  // namespace

Manifold Manifold::Tetrahedron() {
    TriMesh mesh;
    mesh.points = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    mesh.corners = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return new_original(std::move(mesh));
}

Manifold Manifold::Cube(vec3 size, bool center) {
    if (!(la::minelem(size) > 0) || !std::isfinite(la::maxelem(size))) return failed();
    TriMesh mesh;
    const vec3 low = center ? size * -0.5 : vec3();
    for (int corner = 0; corner < 8; ++corner)
        mesh.points.push_back(low + size * vec3(corner & 1, corner >> 1 & 1, corner >> 2));
    // Two of each face, along one of its diagonals.
    mesh.corners = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 7, 5}, {1, 3, 7}};
    return new_original(std::move(mesh));
}

Manifold Manifold::Cylinder(double height, double radiusLow, double radiusHigh,
                            int circularSegments, bool center) {
    const double top = radiusHigh < 0 ? radiusLow : radiusHigh;
    if (!(height > 0 && radiusLow >= 0 && radiusLow + top > 0)) return failed();
    const double radius = std::max(radiusLow, top);
    const int sides =
        circularSegments > 2 ? circularSegments : Quality::GetCircularSegments(radius);
    const Manifold standing =
        radiusLow > 0 ? Extrude(circle(radiusLow, sides), height, 0, 0, vec2(top / radiusLow))
                      : Extrude(circle(top, sides), height, 0, 0, vec2(0.0))
                            .Mirror({0, 0, 1})
                            .Translate({0, 0, height});
    const TriMesh& mesh = standing.node()->mesh();
    mat3x4 place = la::identity;
    if (center) place[3].z = -height / 2;
    TriMesh made = moved(mesh, place);
    return new_original(std::move(made));
}

Manifold Manifold::Sphere(double radius, int circularSegments) {
    if (!(radius > 0)) return failed();
    const int segments =
        circularSegments > 0 ? circularSegments : Quality::GetCircularSegments(radius);
    const int n = (segments + 3) / 4;
    TriMesh mesh;
    std::map<std::array<int, 3>, std::uint32_t> number;
    // Where steps along the three axes lead: circles about the axes are regular.
    const auto vertex = [&](int i, int j, int k, const std::array<int, 3>& sign) {
        const std::array<int, 3> key{i * sign[0], j * sign[1], k * sign[2]};
        const auto [at, is_new] =
            number.try_emplace(key, static_cast<std::uint32_t>(mesh.points.size()));
        if (is_new) {
            const auto along = [&](int steps) { return sind(90.0 * steps / n); };
            mesh.points.push_back(la::normalize(vec3(along(key[0]), along(key[1]), along(key[2]))) *
                                  radius);
        }
        return at->second;
    };
    for (int octant = 0; octant < 8; ++octant) {
        const std::array<int, 3> sign{(octant & 1) != 0 ? -1 : 1, (octant & 2) != 0 ? -1 : 1,
                                      (octant & 4) != 0 ? -1 : 1};
        const bool turned = sign[0] * sign[1] * sign[2] < 0;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            mesh.corners.push_back(turned ? Triple{a, c, b} : Triple{a, b, c});
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                const int k = n - i - j;
                const std::uint32_t a = vertex(i, j, k, sign);
                const std::uint32_t b = vertex(i + 1, j, k - 1, sign);
                const std::uint32_t c = vertex(i, j + 1, k - 1, sign);
                add(a, b, c);
                if (k > 1) add(b, vertex(i + 1, j + 1, k - 2, sign), c);
            }
    }
    return new_original(std::move(mesh));
}

Manifold Manifold::Extrude(const Polygons& crossSection, double height, int nDivisions,
                           double twistDegrees, vec2 scaleTop) {
    if (!(height > 0) || crossSection.empty() || nDivisions < 0) return failed();
    const auto caps = triangulated(crossSection);
    if (!caps || caps->empty()) return failed();
    const bool cone = scaleTop.x == 0 && scaleTop.y == 0;
    TriMesh mesh;
    const int layers = nDivisions + 1;
    std::size_t width = 0;
    for (const SimplePolygon& polygon : crossSection) width += polygon.size();
    for (int layer = 0; layer <= layers - (cone ? 1 : 0); ++layer) {
        const double part = static_cast<double>(layer) / layers;
        const vec2 scale = la::lerp(vec2(1.0), scaleTop, part);
        const double c = cosd(twistDegrees * part);
        const double s = sind(twistDegrees * part);
        for (const SimplePolygon& polygon : crossSection)
            for (const vec2& p : polygon) {
                const vec2 q = p * scale;
                mesh.points.emplace_back(q.x * c - q.y * s, q.x * s + q.y * c, height * part);
            }
    }
    if (cone)
        for (std::size_t i = 0; i < crossSection.size(); ++i)
            mesh.points.emplace_back(0.0, 0.0, height);
    const auto number = [](std::size_t i) { return static_cast<std::uint32_t>(i); };
    for (int layer = 0; layer < layers; ++layer) {
        const std::size_t below = static_cast<std::size_t>(layer) * width;
        const bool to_apex = cone && layer + 1 == layers;
        std::size_t begin = 0;
        for (std::size_t ring = 0; ring < crossSection.size(); ++ring) {
            const std::size_t n = crossSection[ring].size();
            for (std::size_t i = 0; i < n; ++i) {
                const std::size_t a = below + begin + i;
                const std::size_t b = below + begin + (i + 1) % n;
                if (to_apex) {
                    mesh.corners.push_back({number(a), number(b), number(below + width + ring)});
                    continue;
                }
                mesh.corners.push_back({number(a), number(b), number(b + width)});
                mesh.corners.push_back({number(a), number(b + width), number(a + width)});
            }
            begin += n;
        }
    }
    const std::size_t top = static_cast<std::size_t>(layers) * width;
    for (const Triple& t : *caps) {
        mesh.corners.push_back({t[0], t[2], t[1]});
        if (!cone)
            mesh.corners.push_back({number(t[0] + top), number(t[1] + top), number(t[2] + top)});
    }
    return new_original(std::move(mesh));
}

namespace {

// What is on the right of the axis.
Polygons right_half(const Polygons& polygons) {
    Polygons half;
    for (const SimplePolygon& polygon : polygons) {
        SimplePolygon kept;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const vec2 p = polygon[i];
            const vec2 q = polygon[(i + 1) % polygon.size()];
            if (p.x >= 0) kept.push_back(p);
            if ((p.x < 0 && q.x > 0) || (p.x > 0 && q.x < 0))
                kept.push_back({0, p.y + (q.y - p.y) * (p.x / (p.x - q.x))});
        }
        const bool is_flat = std::ranges::all_of(kept, [](const vec2& p) { return p.x == 0; });
        if (!is_flat) half.push_back(std::move(kept));
    }
    return half;
}

}  // namespace

Manifold Manifold::Revolve(const Polygons& crossSection, int circularSegments,
                           double revolveDegrees) {
    const Polygons profile = right_half(crossSection);
    double radius = 0;
    for (const SimplePolygon& polygon : profile)
        for (const vec2& p : polygon) radius = std::max(radius, p.x);
    if (profile.empty() || !(revolveDegrees > 0)) return failed();
    const double degrees = std::min(revolveDegrees, 360.0);
    const bool whole = degrees == 360.0;
    const int sides =
        circularSegments > 2
            ? circularSegments
            : std::max(3, static_cast<int>(Quality::GetCircularSegments(radius) * degrees / 360));
    const int rings = whole ? sides : sides + 1;
    TriMesh mesh;
    std::vector<std::uint32_t> first;  // by corner of the profile: its first point
    std::vector<bool> on_axis;
    for (const SimplePolygon& polygon : profile)
        for (const vec2& p : polygon) {
            first.push_back(static_cast<std::uint32_t>(mesh.points.size()));
            on_axis.push_back(p.x == 0);
            for (int i = 0; i < (p.x == 0 ? 1 : rings); ++i) {
                const double angle = degrees * i / sides;
                mesh.points.emplace_back(p.x * cosd(angle), p.x * sind(angle), p.y);
            }
        }
    const auto at = [&](std::size_t corner, int i) {
        return on_axis[corner] ? first[corner]
                               : first[corner] + static_cast<std::uint32_t>(i % rings);
    };
    std::size_t begin = 0;
    for (const SimplePolygon& polygon : profile) {
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const std::size_t a = begin + k;
            const std::size_t b = begin + (k + 1) % polygon.size();
            for (int i = 0; i < sides; ++i) {
                if (!on_axis[a]) mesh.corners.push_back({at(a, i), at(a, i + 1), at(b, i + 1)});
                if (!on_axis[b]) mesh.corners.push_back({at(a, i), at(b, i + 1), at(b, i)});
            }
        }
        begin += polygon.size();
    }
    if (!whole) {
        const auto caps = triangulated(profile);
        if (!caps) return failed();
        for (const Triple& t : *caps) {
            mesh.corners.push_back({at(t[0], 0), at(t[1], 0), at(t[2], 0)});
            mesh.corners.push_back({at(t[0], sides), at(t[2], sides), at(t[1], sides)});
        }
    }
    return new_original(std::move(mesh));
}

}  // namespace manifold
