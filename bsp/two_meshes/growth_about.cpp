// SPDX-License-Identifier: Apache-2.0
//
// A mesh that grows about c moves each of its planes away from c. So c has to lie on a given side
// of every plane, the same for a mesh that shrinks with the sides changed: a point of a polyhedron
// is looked for, far from its faces. From a point outside, the reflection beyond the plane that is
// violated most comes nearer to all points inside (Motzkin and Schoenberg, "The relaxation method
// for linear inequalities", 1954).

#include <trisect/bsp/two_meshes/growth_about.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

// Points with normal · x < offset.
struct HalfSpace {
    Vector3 normal{};
    double offset = 0;
    [[nodiscard]] double depth(const Vector3& x) const {
        return offset - (normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2]);
    }
};

// Positions are relative to `origin`.
struct Constraints {
    std::vector<HalfSpace> halves;
    Vector3 origin{};
    double size = 0;

    Constraints(const LatticeMesh& mesh, std::span<const WantedSide> sides, bool with_wishes) {
        const auto corner = [&](const WantedSide& s, std::size_t i) {
            return mesh.points[mesh.triangles[s.facet][i]].doubles();
        };
        if (sides.empty()) return;
        Vector3 low = corner(sides[0], 0);
        Vector3 high = low;
        for (const WantedSide& s : sides)
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], corner(s, 0)[k]);
                high[k] = std::max(high[k], corner(s, 0)[k]);
            }
        for (std::size_t k = 0; k < 3; ++k) {
            origin[k] = low[k] + (high[k] - low[k]) / 2;
            size = std::max(size, high[k] - low[k]);
        }
        for (const WantedSide& s : sides)
            if (with_wishes || !s.is_wish) add(corner(s, 0), corner(s, 1), corner(s, 2), s.above);
    }

    void add(const Vector3& a, const Vector3& b, const Vector3& c, bool above) {
        HalfSpace h;
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3;
            const std::size_t j = (k + 2) % 3;
            h.normal[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
            square += h.normal[k] * h.normal[k];
        }
        const double length = (above ? 1 : -1) * std::sqrt(square);
        for (std::size_t k = 0; k < 3; ++k) {
            h.normal[k] /= length;
            h.offset += h.normal[k] * (a[k] - origin[k]);
        }
        if (square > 0) halves.push_back(h);
    }
};

// A point in all half-spaces, each of which is turned over where `side` is -1, and its depth.
struct Inside {
    Vector3 x{};
    double depth = -std::numeric_limits<double>::infinity();

    Inside(const Constraints& c, double side) {
        Vector3 y{};
        double margin = c.size / 4;
        constexpr int rounds = 6;
        constexpr int steps = 24;
        for (int round = 0; round < rounds; ++round, margin /= 16)
            for (int step = 0; step < steps; ++step) {
                const HalfSpace* worst = nullptr;
                double least = std::numeric_limits<double>::infinity();
                for (const HalfSpace& h : c.halves) {
                    const double at = side * h.depth(y);
                    if (at >= least) continue;
                    least = at;
                    worst = &h;
                }
                if (least > depth) {
                    depth = least;
                    x = y;
                }
                if (worst == nullptr || least >= margin) return;
                for (std::size_t k = 0; k < 3; ++k)
                    y[k] -= side * worst->normal[k] * (margin - least) * 1.5;
            }
    }
};

// Rounded to few bits, by less than the depth.
std::optional<LatticePoint> centre_at(const Constraints& c, const Inside& inside) {
    LatticePoint out;
    const double grid = std::ldexp(1.0, std::ilogb(inside.depth) - 2);
    std::array<Coordinate*, 3> to{&out.x, &out.y, &out.z};
    for (std::size_t k = 0; k < 3; ++k) {
        const double at = std::round((c.origin[k] + inside.x[k]) / grid) * grid;
        if (std::fabs(at) >= static_cast<double>(coordinate_limit) ||
            std::fabs(at / grid) >= static_cast<double>(coordinate_limit))
            return std::nullopt;
        *to[k] = Coordinate(at);
    }
    return out;
}

}  // namespace

std::optional<InfinitesimalShift> growth_about(const LatticeMesh& first,
                                               std::span<const WantedSide> sides) {
    const double finest = std::ldexp(1.0, 8 - fraction_limit);
    for (const bool with_wishes : {true, false}) {
        const Constraints constraints(first, sides, with_wishes);
        const Inside larger(constraints, 1);
        const Inside smaller(constraints, -1);
        const Inside& best = larger.depth >= smaller.depth ? larger : smaller;
        if (!(best.depth > std::max(finest, constraints.size * 0x1p-30))) continue;
        const auto centre = centre_at(constraints, best);
        if (!centre) continue;
        InfinitesimalShift shift;
        shift.growth = static_cast<std::int8_t>(&best == &larger ? 1 : -1);
        shift.centre = *centre;
        return shift;
    }
    return std::nullopt;
}

}  // namespace trisect::detail
