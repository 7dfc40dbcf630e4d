// SPDX-License-Identifier: Apache-2.0
//
// A few points spread over the facet are located in the face, by the edges that a ray crosses in
// the face's projection. Doubles with a bound decide; a point that comes near an edge or a vertex
// is given up for the next one. The bound of a turn is that of outline_meetings.cpp.

#include <trisect/bsp/assembly/outline_names.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <trisect/kernel/point.h>

namespace trisect::detail {

namespace {

constexpr int most_samples = 32;

// A point in the projection.
struct Flat {
    double u = 0;
    double v = 0;
    double error = 0;
};

struct FlatEdge {
    Flat from;
    Flat to;
};

// Whether p is to the left of the way from a to b: 1, to the right: -1; 0: not sure.
int turn(const Flat& a, const Flat& b, const Flat& p) {
    const double du = b.u - a.u;
    const double dv = b.v - a.v;
    const double x = p.u - a.u;
    const double y = p.v - a.v;
    const double s = du * y;
    const double t = dv * x;
    const double e = std::max({a.error, b.error, p.error});
    const double error =
        2.001 * e * (std::fabs(du) + std::fabs(dv) + std::fabs(x) + std::fabs(y) + 4 * e) +
        0x1p-50 * (std::fabs(s) + std::fabs(t));
    return s - t > error ? 1 : (t - s > error ? -1 : 0);
}

// 1: above p along v; 0: not sure.
int height(const Flat& a, const Flat& p) {
    if (a.v - a.error > p.v) return 1;
    return a.v + a.error < p.v ? -1 : 0;
}

// Nothing where that is not sure.
std::optional<bool> is_inside(const std::vector<FlatEdge>& edges, const Flat& p) {
    bool inside = false;
    for (const FlatEdge& e : edges) {
        const int from = height(e.from, p);
        const int to = height(e.to, p);
        if (from == 0 || to == 0) return std::nullopt;
        if (from == to) continue;
        const int side = turn(e.from, e.to, p);
        if (side == 0) return std::nullopt;
        // The ray goes along u: an edge that goes up is met where p is on its left.
        if ((to > 0) == (side > 0)) inside = !inside;
    }
    return inside;
}

class FlatFace {
public:
    FlatFace(const Brep& brep, FaceId face) : axis_(brep.plane(face).dominant_axis()) {
        for (const HalfedgeId h : brep.halfedges(face))
            edges_.push_back({flat(brep.point(brep.origin(h)).approximation()),
                              flat(brep.point(brep.target(h)).approximation())});
    }
    /// Whether a point of the facet is surely in the face.
    [[nodiscard]] bool has_part_of(const Source& source, std::uint32_t facet) const {
        std::array<Flat, 3> corners;
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = flat({source.corner(facet, static_cast<int>(i)).doubles(), 0});
        for (int i = 0; i < most_samples; ++i) {
            const Flat p = sample(corners, i);
            const int first = turn(corners[0], corners[1], p);
            if (first == 0 || turn(corners[1], corners[2], p) != first ||
                turn(corners[2], corners[0], p) != first)
                continue;
            if (is_inside(edges_, p).value_or(false)) return true;
        }
        return false;
    }

private:
    [[nodiscard]] Flat flat(const Approximation& a) const {
        const auto u = static_cast<std::size_t>((axis_ + 1) % 3);
        const auto v = static_cast<std::size_t>((axis_ + 2) % 3);
        return {a.c[u], a.c[v], a.error};
    }
    // Any point, as it is in doubles: spread by multiples of two irrational numbers.
    [[nodiscard]] static Flat sample(const std::array<Flat, 3>& corners, int number) {
        double s = std::fmod(0.5 + 0.7548776662466927 * number, 1.0);
        double t = std::fmod(0.5 + 0.5698402909980532 * number, 1.0);
        if (s + t > 1) {
            s = 1 - s;
            t = 1 - t;
        }
        const double r = 1 - s - t;
        return {r * corners[0].u + s * corners[1].u + t * corners[2].u,
                r * corners[0].v + s * corners[1].v + t * corners[2].v, 0};
    }

    int axis_;
    std::vector<FlatEdge> edges_;
};

}  // namespace

bool names_are_proved(const Brep& brep, const NamedOutlines& outlines) {
    for (const FaceId face : brep.faces()) {
        const FaceSource name = brep.source(face);
        for (const NamedOutlines::Face& f : outlines.first_facets)
            if (f.source->name_of(f.facet) == name &&
                !FlatFace(brep, face).has_part_of(*f.source, f.facet))
                return false;
    }
    return true;
}

}  // namespace trisect::detail
