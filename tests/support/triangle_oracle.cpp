// SPDX-License-Identifier: Apache-2.0

#include "triangle_oracle.h"

#include <algorithm>
#include <cstddef>

#include "reference/vector.h"

namespace brute {

using reference::cross;
using reference::dot;
using reference::subtracted;
namespace {

// Projection along an axis in which a plane is not seen edge on.
struct View {
    std::size_t u;
    std::size_t v;
    explicit View(const Point3& normal) {
        std::size_t axis = 0;
        while (sgn(normal[axis]) == 0) ++axis;
        u = (axis + 1) % 3;
        v = (axis + 2) % 3;
    }
    [[nodiscard]] int turn(const Point3& a, const Point3& b, const Point3& c) const {
        return sgn(Rational((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u])));
    }
    [[nodiscard]] bool between(const Point3& x, const Point3& a, const Point3& b) const {
        return turn(a, b, x) == 0 && (x[u] - a[u]) * (x[u] - b[u]) <= 0 &&
               (x[v] - a[v]) * (x[v] - b[v]) <= 0;
    }
};

// 1 inside, 0 on the boundary, -1 outside; the point is in the plane.
int place_in(const Triangle3& t, const Point3& x, const View& view) {
    std::array<int, 3> s{};
    for (std::size_t i = 0; i < 3; ++i) s[i] = view.turn(t[i], t[(i + 1) % 3], x);
    bool positive = false;
    bool negative = false;
    bool zero = false;
    for (const int i : s) {
        positive = positive || i > 0;
        negative = negative || i < 0;
        zero = zero || i == 0;
    }
    if (positive && negative) return -1;
    return zero ? 0 : 1;
}

bool segments_meet(const Point3& a, const Point3& b, const Point3& c, const Point3& d,
                   const View& view) {
    const int s = view.turn(a, b, c) * view.turn(a, b, d);
    const int r = view.turn(c, d, a) * view.turn(c, d, b);
    if (s < 0 && r < 0) return true;
    return view.between(c, a, b) || view.between(d, a, b) || view.between(a, c, d) ||
           view.between(b, c, d);
}

// -1: no common point, 0: some, 1: passes through the inside.
int segment_and_triangle(const Point3& a, const Point3& b, const Triangle3& t) {
    const Point3 n = cross(subtracted(t[1], t[0]), subtracted(t[2], t[0]));
    const View view(n);
    const Rational da = dot(n, subtracted(a, t[0]));
    const Rational db = dot(n, subtracted(b, t[0]));
    if (sgn(da) * sgn(db) > 0) return -1;
    if (sgn(da) == 0 && sgn(db) == 0) {
        if (place_in(t, a, view) >= 0 || place_in(t, b, view) >= 0) return 0;
        for (std::size_t i = 0; i < 3; ++i)
            if (segments_meet(a, b, t[i], t[(i + 1) % 3], view)) return 0;
        return -1;
    }
    const Rational s(da / (da - db));
    Point3 x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = a[k] + s * (b[k] - a[k]);
    const int place = place_in(t, x, view);
    return place > 0 && (sgn(da) == 0 || sgn(db) == 0) ? 0 : place;
}

int strongest(const Triangle3& p, const Triangle3& q) {
    int most = -1;
    for (std::size_t i = 0; i < 3; ++i) {
        most = std::max(most, segment_and_triangle(p[i], p[(i + 1) % 3], q));
        most = std::max(most, segment_and_triangle(q[i], q[(i + 1) % 3], p));
    }
    return most;
}

bool boxes_meet(const Triangle3& p, const Triangle3& q) {
    for (std::size_t k = 0; k < 3; ++k) {
        const auto by = [k](const Point3& a, const Point3& b) { return a[k] < b[k]; };
        const auto [p_lo, p_hi] = std::minmax_element(p.begin(), p.end(), by);
        const auto [q_lo, q_hi] = std::minmax_element(q.begin(), q.end(), by);
        if ((*p_hi)[k] < (*q_lo)[k] || (*q_hi)[k] < (*p_lo)[k]) return false;
    }
    return true;
}

}  // namespace

Point3 moved(const std::array<std::array<double, 3>, 3>& m, const std::array<double, 3>& t,
             const Point3& p) {
    Point3 r;
    for (std::size_t i = 0; i < 3; ++i)
        r[i] = Rational(m[i][0]) * p[0] + Rational(m[i][1]) * p[1] + Rational(m[i][2]) * p[2] +
               Rational(t[i]);
    return r;
}

bool meet(const Triangle3& p, const Triangle3& q) {
    return boxes_meet(p, q) && strongest(p, q) >= 0;
}
bool cross(const Triangle3& p, const Triangle3& q) {
    return boxes_meet(p, q) && strongest(p, q) > 0;
}

}  // namespace brute
