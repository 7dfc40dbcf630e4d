// SPDX-License-Identifier: Apache-2.0

#include "triangle_contact.h"

namespace reference {

namespace {

constexpr std::size_t next(std::size_t i) { return (i + 1) % 3; }

Point3 normal(const Triangle3& t) { return cross(subtracted(t[1], t[0]), subtracted(t[2], t[0])); }

// Whether all of s is strictly on one side of the plane of t.
bool is_beyond(const Triangle3& s, const Triangle3& t) {
    const Point3 n = normal(t);
    int sum = 0;
    for (const Point3& p : s) sum += sign(Rational(dot(n, subtracted(p, t[0]))));
    return sum == 3 || sum == -3;
}

// from + s (to - from)
Point3 along(const Point3& from, const Point3& to, const Rational& s) {
    const Point3 d = subtracted(to, from);
    return {from[0] + s * d[0], from[1] + s * d[1], from[2] + s * d[2]};
}

}  // namespace

std::optional<int> part_at(const Triangle3& t, const Point3& p) {
    const Point3 n = normal(t);
    if (dot(n, subtracted(p, t[0])) != 0) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i)
        if (t[i] == p) return static_cast<int>(i);
    std::optional<int> side;
    for (std::size_t i = 0; i < 3; ++i) {
        const int s =
            sign(Rational(dot(n, cross(subtracted(t[next(i)], t[i]), subtracted(p, t[i])))));
        if (s < 0) return std::nullopt;
        if (s == 0) side = static_cast<int>(3 + i);
    }
    return side ? side : 6;
}

std::map<Point3, std::pair<int, int>> contact(const Triangle3& a, const Triangle3& b) {
    std::map<Point3, std::pair<int, int>> found;
    if (is_beyond(a, b) || is_beyond(b, a)) return found;
    const auto note = [&](const Point3& p) {
        const auto in_a = part_at(a, p);
        const auto in_b = part_at(b, p);
        if (in_a && in_b) found[p] = {*in_a, *in_b};
    };
    for (const Point3& p : a) note(p);
    for (const Point3& p : b) note(p);
    const auto sides_through = [&](const Triangle3& s, const Triangle3& t) {
        const Point3 n = normal(t);
        for (std::size_t i = 0; i < 3; ++i) {
            const Rational u = dot(n, subtracted(s[i], t[0]));
            const Rational v = dot(n, subtracted(s[next(i)], t[0]));
            if (sign(u) * sign(v) < 0) note(along(s[i], s[next(i)], Rational(u / (u - v))));
        }
    };
    sides_through(a, b);
    sides_through(b, a);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const Point3 u = subtracted(a[next(i)], a[i]);
            const Point3 v = subtracted(b[next(j)], b[j]);
            const Point3 w = subtracted(b[j], a[i]);
            const Point3 uv = cross(u, v);
            const Rational size = dot(uv, uv);
            if (size == 0 || dot(uv, w) != 0) continue;
            // a_i + s u = b_j + r v; with w = s u - r v: s = (w × v)·(u × v) / |u × v|²
            const Rational s = dot(cross(w, v), uv) / size;
            const Rational r = dot(cross(w, u), uv) / size;
            if (s >= 0 && s <= 1 && r >= 0 && r <= 1) note(along(a[i], a[next(i)], s));
        }
    return found;
}

}  // namespace reference
