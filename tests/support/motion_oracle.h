// SPDX-License-Identifier: Apache-2.0
//
// Motions and contacts of solids in rationals at one time: positions come from the quaternion
// formula, contacts from all pairs of triangles. Nothing is shared with the library but the
// corners.
#pragma once

#include <array>
#include <vector>

#include <trisect/bsp/interference/motion.h>

#include "reference/naive_boolean.h"
#include "reference/triangle_contact.h"

namespace oracle {

using reference::Point3;
using reference::Rational;

// A screw after a placement by a quaternion and a vector.
struct Placement {
    std::array<std::int64_t, 4> quaternion{1, 0, 0, 0};
    std::array<double, 3> at{};
    trisect::Screw screw;

    [[nodiscard]] trisect::Motion motion() const {
        return trisect::Motion::screw(trisect::Pose::from_quaternion(quaternion, at), screw);
    }
};

inline Point3 rotated(const std::array<Rational, 4>& q, const Point3& p) {
    // p + 2 w (v × p) + 2 v × (v × p), over the square of the norm.
    const Point3 v{q[1], q[2], q[3]};
    const Rational norm = q[0] * q[0] + reference::dot(v, v);
    const Point3 once = reference::cross(v, p);
    const Point3 twice = reference::cross(v, once);
    Point3 r;
    for (std::size_t i = 0; i < 3; ++i) r[i] = p[i] + 2 * (q[0] * once[i] + twice[i]) / norm;
    return r;
}

inline Point3 place(const Placement& placement, const Rational& s, const Point3& p) {
    const auto rational = [](std::int64_t v) { return Rational(reference::to_integer(v)); };
    const auto& q = placement.quaternion;
    const auto& k = placement.screw.turn;
    Point3 r = rotated({rational(q[0]), rational(q[1]), rational(q[2]), rational(q[3])}, p);
    for (std::size_t i = 0; i < 3; ++i)
        r[i] += Rational(placement.at[i]) - Rational(placement.screw.center[i]);
    r = rotated({rational(k[0]), s * rational(k[1]), s * rational(k[2]), s * rational(k[3])}, r);
    for (std::size_t i = 0; i < 3; ++i)
        r[i] += Rational(placement.screw.center[i]) + s * Rational(placement.screw.shift[i]);
    return r;
}

inline std::vector<reference::Triangle3> place(const Placement& placement, const Rational& s,
                                               const reference::Operand& solid) {
    std::vector<reference::Triangle3> r;
    for (const auto& t : solid) {
        reference::Triangle3 moved;
        for (std::size_t i = 0; i < 3; ++i)
            moved[i] = place(placement, s, reference::to_point(t[i]));
        r.push_back(moved);
    }
    return r;
}

// Separated along an axis: saves most pairs.
inline bool apart(const reference::Triangle3& a, const reference::Triangle3& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto minmax = [i](const reference::Triangle3& t) {
            return std::minmax({t[0][i], t[1][i], t[2][i]});
        };
        const auto [la, ha] = minmax(a);
        const auto [lb, hb] = minmax(b);
        if (ha < lb || hb < la) return true;
    }
    return false;
}

inline bool boundaries_meet(const reference::Operand& a, const Placement& pa,
                            const reference::Operand& b, const Placement& pb, const Rational& s) {
    const auto ta = place(pa, s, a);
    const auto tb = place(pb, s, b);
    for (const auto& x : ta)
        for (const auto& y : tb)
            if (!apart(x, y) && !reference::contact(x, y).empty()) return true;
    return false;
}

}  // namespace oracle
