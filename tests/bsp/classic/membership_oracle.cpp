// SPDX-License-Identifier: Apache-2.0

#include "membership_oracle.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <trisect/kernel/wide_int.h>

#include "support/lattice_arithmetic.h"

namespace trisect::test {

namespace {

int orientation(const LatticePoint& p, const LatticePoint& q, const LatticePoint& r,
                const LatticePoint& s) {
    const LatticePoint a = q - p;
    const LatticePoint b = r - p;
    const LatticePoint c = s - p;
    const auto minor = [](Coordinate u, Coordinate v, Coordinate w, Coordinate x) {
        return Int128{u.to_integer()} * x.to_integer() - Int128{v.to_integer()} * w.to_integer();
    };
    const Int128 d = a.x.to_integer() * minor(b.y, b.z, c.y, c.z) -
                     a.y.to_integer() * minor(b.x, b.z, c.x, c.z) +
                     a.z.to_integer() * minor(b.x, b.y, c.x, c.y);
    return d > 0 ? 1 : (d < 0 ? -1 : 0);
}

using Corners = std::array<LatticePoint, 3>;

// Whether a point of the triangle's plane is in the closed triangle: seen from some point off the
// plane, it is never to the other side of an edge.
bool covers(const Corners& t, const LatticePoint& p) {
    LatticePoint eye = t[0] + LatticePoint{1, 0, 0};
    if (orientation(t[0], t[1], t[2], eye) == 0) eye = t[0] + LatticePoint{0, 1, 0};
    if (orientation(t[0], t[1], t[2], eye) == 0) eye = t[0] + LatticePoint{0, 0, 1};
    bool positive = false;
    bool negative = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const int o = orientation(eye, t[i], t[(i + 1) % 3], p);
        positive = positive || o > 0;
        negative = negative || o < 0;
    }
    return !(positive && negative);
}

/// Whether the segment crosses the triangle, or nothing when they are not in general position.
std::optional<bool> crosses(const Corners& t, const LatticePoint& p, const LatticePoint& q) {
    const int from = orientation(t[0], t[1], t[2], p);
    const int to = orientation(t[0], t[1], t[2], q);
    if (from == to && from != 0) return false;
    std::array<int, 3> turns{};
    for (std::size_t i = 0; i < 3; ++i) turns[i] = orientation(p, q, t[i], t[(i + 1) % 3]);
    const bool positive = turns[0] > 0 || turns[1] > 0 || turns[2] > 0;
    const bool negative = turns[0] < 0 || turns[1] < 0 || turns[2] < 0;
    if (positive && negative) return false;
    if (from == 0 || to == 0 || turns[0] == 0 || turns[1] == 0 || turns[2] == 0) return {};
    return true;
}

std::optional<bool> is_inside(const LatticeMesh& mesh, const LatticePoint& p,
                              const LatticePoint& far) {
    bool inside = false;
    for (const auto& t : mesh.triangles) {
        const auto c = crosses({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, p, far);
        if (!c) return {};
        if (*c) inside = !inside;
    }
    return inside;
}

}  // namespace

BspTree::Membership brute_force_membership(const LatticeMesh& mesh, const LatticePoint& p) {
    for (const auto& t : mesh.triangles) {
        const Corners corners{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
        if (orientation(corners[0], corners[1], corners[2], p) == 0 && covers(corners, p))
            return BspTree::Membership::OnBoundary;
    }
    std::int64_t k = 0;
    while (true) {
        ++k;
        const LatticePoint far{(std::int64_t{1} << 19) + 7919 * k, 104729 - 6101 * k * k,
                               -94261 + 3571 * k};
        if (const auto inside = is_inside(mesh, p, far))
            return *inside ? BspTree::Membership::Inside : BspTree::Membership::Outside;
    }
}

}  // namespace trisect::test
