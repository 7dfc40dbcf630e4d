// SPDX-License-Identifier: Apache-2.0
//
// The union of all translates of a convex polyhedron along a segment is the hull of the first and
// the last one. No hull need be searched: its boundary is the part of the first copy that looks
// back, the part of the last copy that looks forward, and the parallelograms that the silhouette,
// the edges between both parts, leaves behind.
//
// A triangle that is parallel to the segment is on neither side. It is taken to look forward. Its
// facet F then sweeps, within its plane, a polygon that consists of F moved and of parallelograms
// over the edges of F behind which the boundary looks back. That these are exactly the trailing
// edges of F: the normal of a neighbour across an edge is a combination of that of F, which is
// perpendicular to the segment, and of the edge's outward normal in F's plane, with a positive
// factor of the latter. So no triangle of the result covers another one, in any position.
#include <trisect/brep/primitives/convex_sweep.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/hull_faces.h>
#include <trisect/brep/primitives/hull_facets.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

namespace trisect {

namespace {

// A double that is the sum, or nothing is returned.
double exact_sum(double a, double b) {
    const double sum = a + b;
    const double rest = sum - a;
    const bool is_exact = (a - (sum - rest)) + (b - rest) == 0;
    if (!is_exact || !(std::abs(sum) < static_cast<double>(coordinate_limit)))
        throw LimitError("a solid that is moved along a vector leaves its lattice");
    return sum;
}

LatticePoint moved_point(const LatticePoint& p, const std::array<double, 3>& by) {
    const std::array<double, 3> c = p.doubles();
    return {Coordinate(exact_sum(c[0], by[0])), Coordinate(exact_sum(c[1], by[1])),
            Coordinate(exact_sum(c[2], by[2]))};
}

using SweptTriangle = std::array<std::uint32_t, 3>;

constexpr std::uint32_t none = 0xffffffff;

// An edge of a triangle by its ends; edges of both directions are neighbours when sorted.
struct SilhouetteEdge {
    std::uint32_t low, high;
    bool ascends;
    std::uint32_t triangle;

    SilhouetteEdge(std::uint32_t from, std::uint32_t to, std::uint32_t t)
        : low(std::min(from, to)), high(std::max(from, to)), ascends(from < to), triangle(t) {}
    [[nodiscard]] bool is_twin_of(const SilhouetteEdge& o) const {
        return low == o.low && high == o.high && ascends != o.ascends;
    }
    friend bool operator<(const SilhouetteEdge& a, const SilhouetteEdge& b) {
        if (a.low != b.low) return a.low < b.low;
        return a.high != b.high ? a.high < b.high : a.ascends < b.ascends;
    }
};

std::vector<SilhouetteEdge> sorted_edges(const std::vector<SweptTriangle>& triangles) {
    std::vector<SilhouetteEdge> edges;
    edges.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            edges.emplace_back(triangles[t][i], triangles[t][(i + 1) % 3], t);
    std::sort(edges.begin(), edges.end());
    return edges;
}

class Sweeper {
public:
    Sweeper(const LatticeMesh& mesh, const std::array<double, 3>& by)
        : mesh_(mesh), stays_(mesh.points.size(), none), moves_(mesh.points.size(), none) {
        moved_.reserve(mesh.points.size());
        for (const LatticePoint& p : mesh.points) moved_.push_back(moved_point(p, by));
        out_.lattice = mesh.lattice;
    }

    LatticeMesh run() {
        std::vector<bool> looks_back(mesh_.triangles.size());
        std::uint32_t face_count = 0;
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto& [a, b, c] = mesh_.triangles[t];
            const Plane plane = Plane::through(mesh_.points[a], mesh_.points[b], mesh_.points[c]);
            looks_back[t] = side_of(moved_[a], plane) == Side::Below;
            const auto corner = [&](std::uint32_t v) { return looks_back[t] ? stay(v) : move(v); };
            add({corner(a), corner(b), corner(c)}, mesh_.face_of(t));
            face_count = std::max(face_count, mesh_.face_of(t) + 1);
        }
        add_sides(looks_back, face_count);
        return std::move(out_);
    }

private:
    std::uint32_t named(std::vector<std::uint32_t>& names, std::uint32_t v, const LatticePoint& p) {
        if (names[v] == none) {
            names[v] = static_cast<std::uint32_t>(out_.points.size());
            out_.points.push_back(p);
        }
        return names[v];
    }
    std::uint32_t stay(std::uint32_t v) { return named(stays_, v, mesh_.points[v]); }
    std::uint32_t move(std::uint32_t v) { return named(moves_, v, moved_[v]); }

    void add(const SweptTriangle& t, std::uint32_t face) {
        out_.triangles.push_back(t);
        out_.face_of_triangle.push_back(face);
    }
    // Over the edges between what stays and what moves.
    void add_sides(const std::vector<bool>& looks_back, std::uint32_t face) {
        const std::vector<SilhouetteEdge> edges = sorted_edges(mesh_.triangles);
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
            if (!edges[i].is_twin_of(edges[i + 1])) continue;
            const SilhouetteEdge& e = looks_back[edges[i].triangle] ? edges[i] : edges[i + 1];
            const SilhouetteEdge& other = &e == &edges[i] ? edges[i + 1] : edges[i];
            if (!looks_back[e.triangle] || looks_back[other.triangle]) continue;
            const std::uint32_t a = e.ascends ? e.low : e.high;
            const std::uint32_t b = e.ascends ? e.high : e.low;
            add({stay(b), stay(a), move(a)}, face);
            add({stay(b), move(a), move(b)}, face);
            ++face;
        }
    }

    const LatticeMesh& mesh_;
    std::vector<LatticePoint> moved_;
    std::vector<std::uint32_t> stays_, moves_;  // names in the result
    LatticeMesh out_;
};

// Whether all points lie in one plane.
bool are_coplanar(std::span<const LatticePoint> points) {
    if (points.empty()) return true;
    const LatticePoint& a = points.front();
    const auto b = std::ranges::find_if(points, [&](const LatticePoint& p) { return p != a; });
    if (b == points.end()) return true;
    const auto c = std::ranges::find_if(
        points, [&](const LatticePoint& p) { return !are_collinear(a, *b, p); });
    if (c == points.end()) return true;
    const Plane plane = Plane::through(a, *b, *c);
    return std::ranges::all_of(
        points, [&](const LatticePoint& p) { return side_of(p, plane) == Side::On; });
}

}  // namespace

LatticeMesh hull_mesh(std::span<const LatticePoint> points, Lattice lattice) {
    return detail::mesh_of_faces(points, detail::HullFacets(points).facets(), lattice);
}

bool is_convex(const LatticeMesh& mesh) {
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const SweptTriangle& t) {
        const Plane plane = Plane::through(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
        return std::none_of(mesh.points.begin(), mesh.points.end(), [&](const LatticePoint& p) {
            return side_of(p, plane) == Side::Above;
        });
    });
}

LatticeMesh swept(const LatticeMesh& convex, const std::array<double, 3>& by) {
    if (by == std::array<double, 3>{}) return convex;
    return Sweeper(convex, by).run();
}

std::vector<bool> leading_triangles(const LatticeMesh& convex, const std::array<double, 3>& by) {
    std::vector<bool> out;
    for (const auto& [a, b, c] : convex.triangles) {
        const Plane plane = Plane::through(convex.points[a], convex.points[b], convex.points[c]);
        out.push_back(side_of(moved_point(convex.points[a], by), plane) == Side::Above);
    }
    return out;
}

LatticeMesh leading_part(const LatticeMesh& convex, const std::array<double, 3>& by) {
    const std::vector<bool> leads = leading_triangles(convex, by);
    std::vector<LatticePoint> corners;
    for (std::size_t t = 0; t < leads.size(); ++t)
        if (leads[t])
            for (const std::uint32_t c : convex.triangles[t]) corners.push_back(convex.points[c]);
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (are_coplanar(corners)) return convex;
    return hull_mesh(corners, convex.lattice);
}

LatticeMesh moved(const LatticeMesh& mesh, const std::array<double, 3>& by) {
    LatticeMesh out = mesh;
    for (LatticePoint& p : out.points) p = moved_point(p, by);
    return out;
}

}  // namespace trisect
