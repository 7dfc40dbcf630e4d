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
#include <map>
#include <optional>
#include <utility>
#include <vector>

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

// The faces of a hull as outlines, cut into triangles anew. Strips from one end of a face to the
// other, not fans: where translates of a face overlap in its plane, a triangle of a strip overlaps
// few of the other strip, a triangle of a fan many of the other fan.
class FacesOfHull {
public:
    FacesOfHull(std::span<const LatticePoint> points, Lattice lattice)
        : points_(points), names_(points.size(), none) {
        out_.lattice = lattice;
    }

    void add(const std::vector<SweptTriangle>& triangles) {
        const std::vector<std::uint32_t> outline = corners_of(triangles);
        std::size_t low = 0;
        std::size_t high = outline.size() - 1;
        for (bool at_low = true; high - low > 1; at_low = !at_low) {
            const std::size_t middle = at_low ? low + 1 : high - 1;
            add_triangle({outline[low], outline[middle], outline[high]});
            (at_low ? low : high) = middle;
        }
        ++face_;
    }
    LatticeMesh mesh() { return std::move(out_); }

private:
    // Counter-clockwise, without those where the outline goes straight on.
    [[nodiscard]] std::vector<std::uint32_t> corners_of(
        const std::vector<SweptTriangle>& triangles) const {
        std::map<std::uint32_t, std::uint32_t> next;
        const std::vector<SilhouetteEdge> edges = sorted_edges(triangles);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const SilhouetteEdge& e = edges[i];
            if (i + 1 < edges.size() && e.is_twin_of(edges[i + 1]))
                ++i;
            else
                next[e.ascends ? e.low : e.high] = e.ascends ? e.high : e.low;
        }
        std::vector<std::uint32_t> out;
        std::uint32_t at = next.begin()->first;
        for (std::size_t i = 0; i < next.size(); ++i) {
            const std::uint32_t middle = next.at(at);
            if (!are_collinear(points_[at], points_[middle], points_[next.at(middle)]))
                out.push_back(middle);
            at = middle;
        }
        return out;
    }
    void add_triangle(const SweptTriangle& corners) {
        SweptTriangle t{};
        for (std::size_t i = 0; i < 3; ++i) {
            std::uint32_t& name = names_[corners[i]];
            if (name == none) {
                name = static_cast<std::uint32_t>(out_.points.size());
                out_.points.push_back(points_[corners[i]]);
            }
            t[i] = name;
        }
        out_.triangles.push_back(t);
        out_.face_of_triangle.push_back(face_);
    }

    std::span<const LatticePoint> points_;
    std::vector<std::uint32_t> names_;  // in the result
    std::uint32_t face_ = 0;
    LatticeMesh out_;
};

// Four points that are not in one plane; nothing when all are.
std::optional<std::array<std::uint32_t, 4>> tetrahedron_of(std::span<const LatticePoint> points) {
    std::array<std::uint32_t, 4> out{};
    const auto find = [&](std::size_t k, const auto& condition) {
        for (std::uint32_t p = 0; p < points.size(); ++p)
            if (condition(points[p])) {
                out[k] = p;
                return true;
            }
        return false;
    };
    if (points.empty()) return std::nullopt;
    const LatticePoint& a = points[0];
    if (!find(1, [&](const LatticePoint& p) { return p != a; })) return std::nullopt;
    const LatticePoint& b = points[out[1]];
    if (!find(2, [&](const LatticePoint& p) { return !are_collinear(a, b, p); }))
        return std::nullopt;
    const Plane base = Plane::through(a, b, points[out[2]]);
    if (!find(3, [&](const LatticePoint& p) { return side_of(p, base) != Side::On; }))
        return std::nullopt;
    return out;
}

// The beneath-beyond method: each point outside replaces the triangles that it sees by those
// between it and their outline. A triangle whose plane holds the point is not seen; then no point
// is on the line of an edge of the outline, which lies in the plane of a triangle that is seen, so
// no triangle is degenerate.
class HullMaker {
public:
    /// `first`: four points that are not in one plane
    HullMaker(std::span<const LatticePoint> points, const std::array<std::uint32_t, 4>& first)
        : points_(points) {
        start(first);
        for (std::uint32_t p = 0; p < points.size(); ++p) add_point(p);
    }

    LatticeMesh mesh(Lattice lattice) const {
        FacesOfHull faces(points_, lattice);
        const std::vector<std::uint32_t> names = names_of_faces();
        std::vector<std::vector<SweptTriangle>> triangles;
        for (std::size_t f = 0; f < facets_.size(); ++f) {
            if (names[f] == triangles.size()) triangles.emplace_back();
            triangles[names[f]].push_back(facets_[f].corners);
        }
        for (const auto& face : triangles) faces.add(face);
        return faces.mesh();
    }

private:
    struct Facet {
        SweptTriangle corners;
        Plane plane;
        bool is_seen = false;
    };

    // For each facet the number of its face, in the order of first facets. Facets of one plane are
    // connected by edges.
    [[nodiscard]] std::vector<std::uint32_t> names_of_faces() const {
        std::vector<SweptTriangle> all;
        for (const Facet& f : facets_) all.push_back(f.corners);
        const std::vector<SilhouetteEdge> edges = sorted_edges(all);
        std::vector<std::uint32_t> root(facets_.size());
        for (std::uint32_t f = 0; f < root.size(); ++f) root[f] = f;
        const auto find = [&root](std::uint32_t f) {
            while (root[f] != f) f = root[f] = root[root[f]];
            return f;
        };
        for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {
            const std::uint32_t f = edges[i].triangle;
            const std::uint32_t g = edges[i + 1].triangle;
            if (is_same_plane(facets_[f].plane, facets_[g].plane)) root[find(f)] = find(g);
        }
        std::vector<std::uint32_t> number(root.size(), none);
        std::vector<std::uint32_t> names;
        std::uint32_t next = 0;
        for (std::uint32_t f = 0; f < root.size(); ++f) {
            std::uint32_t& n = number[find(f)];
            if (n == none) n = next++;
            names.push_back(n);
        }
        return names;
    }

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        facets_.push_back({{a, b, c}, Plane::through(points_[a], points_[b], points_[c])});
    }
    void start(const std::array<std::uint32_t, 4>& first) {
        const auto [a, b, c, d] = first;
        const Plane base = Plane::through(points_[a], points_[b], points_[c]);
        const bool below = side_of(points_[d], base) == Side::Below;
        const std::uint32_t u = below ? b : c;
        const std::uint32_t v = below ? c : b;
        add(a, u, v);
        add(u, a, d);
        add(v, u, d);
        add(a, v, d);
    }
    void add_point(std::uint32_t p) {
        std::vector<SweptTriangle> seen;
        for (Facet& f : facets_) {
            f.is_seen = side_of(points_[p], f.plane) == Side::Above;
            if (f.is_seen) seen.push_back(f.corners);
        }
        if (seen.empty()) return;
        std::erase_if(facets_, [](const Facet& f) { return f.is_seen; });
        const std::vector<SilhouetteEdge> edges = sorted_edges(seen);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (i + 1 < edges.size() && edges[i].is_twin_of(edges[i + 1])) {
                ++i;  // within what is seen
                continue;
            }
            const SilhouetteEdge& e = edges[i];
            add(e.ascends ? e.low : e.high, e.ascends ? e.high : e.low, p);
        }
    }

    std::span<const LatticePoint> points_;
    std::vector<Facet> facets_;
};

}  // namespace

LatticeMesh hull_mesh(std::span<const LatticePoint> points, Lattice lattice) {
    const auto first = tetrahedron_of(points);
    if (!first) throw UsageError("a convex hull needs points that are not in one plane");
    return HullMaker(points, *first).mesh(lattice);
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
    if (!tetrahedron_of(corners)) return convex;
    return hull_mesh(corners, convex.lattice);
}

LatticeMesh moved(const LatticeMesh& mesh, const std::array<double, 3>& by) {
    LatticeMesh out = mesh;
    for (LatticePoint& p : out.points) p = moved_point(p, by);
    return out;
}

}  // namespace trisect
