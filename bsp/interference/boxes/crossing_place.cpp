// SPDX-License-Identifier: Apache-2.0
//
// Both planes meet in a line, which runs through each triangle from one of its sides to another.
// Where the two intervals overlap is the common segment; its ends are the second and third of their
// four ends along the line.
//
// An end is x = a + t (b - a) on a side ab of one triangle, t = v / (v - w), v and w the values of
// a and b at the other one's plane, each off by less than B (error_bounds.h). With |v - w| > 64 B,
// t is off by less than 2.1 B / |v - w| + 4 u. The line's direction is that of the longer chord.
// Ends that are as near to each other as they are off may be taken for each other, which moves the
// middle by a few times that.

#include <trisect/bsp/interference/boxes/crossing_place.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

struct End {
    Vector3 at{};
    double along = 0;
};

// The two places where a triangle passes through the plane of the other one.
class Chord {
public:
    Chord(const TriangleCorners& t, const TriangleCorners& other, double g, double error) {
        const Vector3 n = cross(minus(other[1], other[0]), minus(other[2], other[0]));
        const double bound = difference_determinant_bound(g, 2 * error);
        std::array<int, 3> side{};
        for (std::size_t i = 0; i < 3; ++i)
            side[i] = certain_sign(dot(n, minus(t[i], other[0])), bound);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            if (side[i] == 0 || side[j] == 0) return;
            if (side[i] == side[j]) continue;
            const auto end = side_in_plane(t[i], t[j], other, g, error);
            if (!end || count_ == 2) return;
            ends_[count_++].at = end->at;
            error_ = std::max(error_, end->error);
        }
        is_good_ = count_ == 2;
    }
    [[nodiscard]] bool is_good() const { return is_good_; }
    [[nodiscard]] const std::array<End, 2>& ends() const { return ends_; }
    [[nodiscard]] double error() const { return error_; }

private:
    std::array<End, 2> ends_{};
    std::size_t count_ = 0;
    double error_ = 0;
    bool is_good_ = false;
};

}  // namespace

std::optional<CrossingPlace> side_in_plane(const Vector3& p, const Vector3& q,
                                           const TriangleCorners& t, double g, double error) {
    const Vector3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const double bound = difference_determinant_bound(g, 2 * error);
    const double from = dot(n, minus(p, t[0]));
    const double way = from - dot(n, minus(q, t[0]));
    if (!(std::fabs(way) > 64 * bound)) return std::nullopt;
    const double s = from / way;
    if (!(s > -1 && s < 2)) return std::nullopt;
    const Vector3 side = minus(q, p);
    const double length = largest_component(side);
    CrossingPlace place;
    for (std::size_t k = 0; k < 3; ++k) place.at[k] = p[k] + s * side[k];
    place.error = bound_slack * (length * (4.2 * bound / std::fabs(way) + 4 * unit_roundoff) +
                                 3 * error + 4 * unit_roundoff * (largest_component(p) + length));
    return place;
}

// p + t (q - p) with t = n / m, minors of the directions and of r - p along one axis, each off by
// less than B, and 0 <= t <= 1. So t is off by less than 2 B / |m|, and its rounding.
std::optional<CrossingPlace> sides_crossing(const Vector3& p, const Vector3& q, const Vector3& r,
                                            const Vector3& s, double g, double error) {
    const Vector3 u = minus(q, p);
    const Vector3 v = minus(s, r);
    const Vector3 w = minus(r, p);
    const Vector3 m = cross(u, v);
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::fabs(m[i]) > std::fabs(m[k])) k = i;
    const double bound = difference_minor_bound(g, 2 * error);
    if (!(std::fabs(m[k]) > 64 * bound)) return std::nullopt;
    const double t = cross(w, v)[k] / m[k];
    const double length = largest_component(u);
    CrossingPlace place;
    for (std::size_t i = 0; i < 3; ++i) place.at[i] = p[i] + t * u[i];
    place.error = bound_slack * (length * (4.2 * bound / std::fabs(m[k]) + 4 * unit_roundoff) +
                                 3 * error + 4 * unit_roundoff * (largest_component(p) + length));
    return place;
}

std::optional<CrossingPlace> crossing_place(const TriangleCorners& p, const TriangleCorners& q,
                                            double error) {
    double g = 0;
    for (const auto& a : p)
        for (const auto& b : q) g = std::max(g, largest_component(minus(a, b)));
    g = std::max(
        {2 * g, largest_component(minus(p[1], p[0])), largest_component(minus(p[2], p[0]))});
    const Chord of_p(p, q, g, error);
    const Chord of_q(q, p, g, error);
    if (!of_p.is_good() || !of_q.is_good()) return std::nullopt;
    std::array<End, 4> ends{of_p.ends()[0], of_p.ends()[1], of_q.ends()[0], of_q.ends()[1]};
    const auto way = [](const Chord& c) { return minus(c.ends()[1].at, c.ends()[0].at); };
    const Vector3 along_p = way(of_p);
    const Vector3 along_q = way(of_q);
    const Vector3& line = dot(along_p, along_p) > dot(along_q, along_q) ? along_p : along_q;
    for (End& e : ends) e.along = dot(line, minus(e.at, ends[0].at));
    std::ranges::sort(ends, {}, &End::along);
    const double end_error = std::max(of_p.error(), of_q.error());
    const Vector3 segment = minus(ends[2].at, ends[1].at);
    // A segment that may be none has no inside.
    if (!(largest_component(segment) > 32 * end_error)) return std::nullopt;
    CrossingPlace place;
    for (std::size_t k = 0; k < 3; ++k) place.at[k] = ends[1].at[k] + 0.5 * segment[k];
    place.error = 8 * end_error;
    return place;
}

}  // namespace trisect::detail
