// SPDX-License-Identifier: Apache-2.0
//
// Tests, cheapest first: a line through an edge that separates the triangles in a projection
// (the caps of machined parts are fans of needles whose boxes all overlap); the corners of one
// triangle on one side of the other's plane; what a wall has in the plane of a cap across an axis,
// a corner or an edge, beside the cap's triangle; and the intervals in which the planes' common
// line passes through the triangles, seen along an axis. An end of an interval is a quotient of
// numbers with proved errors; none is divided. Last, a plane between them is searched for, which
// triangles of one rounded face have.

#include <trisect/brep/contact/contact_filter.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <trisect/brep/contact/embedding_counters.h>
#include <trisect/kernel/number/ball.h>
#include <trisect/kernel/number/ball_determinant.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/separating_plane.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Flat = std::array<double, 2>;

// -1, 1, or 0 for unknown. Differences round once.
int turn(const Flat& p, const Flat& q, const Flat& r) {
    const double left = (q[0] - p[0]) * (r[1] - p[1]);
    const double right = (q[1] - p[1]) * (r[0] - p[0]);
    const double bound = minor_rounding * (std::fabs(left) + std::fabs(right));
    const double t = left - right;
    return t > bound ? 1 : (t < -bound ? -1 : 0);
}

// Whether the line of some edge keeps the triangles apart in the projection along the axis in which
// a is largest, but for a shared corner on that line. Only a yes means something. The doubles are
// exact; differences round once, so a turn is within 4·2^-53 of the sum of its products.
class ProjectedFilter {
public:
    ProjectedFilter(std::span<const LatticePoint> points, const Triangle& a, const Triangle& b) {
        const int axis = largest_normal_axis(points, a);
        u_ = (axis + 1) % 3;
        v_ = (axis + 2) % 3;
        for (std::size_t i = 0; i < 3; ++i) {
            a_[i] = flat(points[a[i]]);
            b_[i] = flat(points[b[i]]);
            a_shared_[i] = a[i] == b[0] || a[i] == b[1] || a[i] == b[2];
            b_shared_[i] = b[i] == a[0] || b[i] == a[1] || b[i] == a[2];
        }
    }
    [[nodiscard]] bool is_apart() const {
        for (std::size_t i = 0; i < 3; ++i)
            if (separates(a_, i, b_, b_shared_) || separates(b_, i, a_, a_shared_)) return true;
        return false;
    }

private:
    static int largest_normal_axis(std::span<const LatticePoint> points, const Triangle& t) {
        const Vector3 p = minus(points[t[1]].doubles(), points[t[0]].doubles());
        const Vector3 q = minus(points[t[2]].doubles(), points[t[0]].doubles());
        const std::array<double, 3> n{std::fabs(p[1] * q[2] - p[2] * q[1]),
                                      std::fabs(p[2] * q[0] - p[0] * q[2]),
                                      std::fabs(p[0] * q[1] - p[1] * q[0])};
        return n[0] >= n[1] ? (n[0] >= n[2] ? 0 : 2) : (n[1] >= n[2] ? 1 : 2);
    }
    [[nodiscard]] Flat flat(const LatticePoint& p) const {
        return {p[u_].to_double(), p[v_].to_double()};
    }
    // The third corner of x strictly on one side of edge i, the corners of y strictly on the other,
    // except for one that is an end of the edge.
    static bool separates(const std::array<Flat, 3>& x, std::size_t i, const std::array<Flat, 3>& y,
                          const std::array<bool, 3>& y_shared) {
        const Flat& p = x[i];
        const Flat& q = x[(i + 1) % 3];
        const int inner = turn(p, q, x[(i + 2) % 3]);
        if (inner == 0) return false;
        for (std::size_t k = 0; k < 3; ++k) {
            if (y_shared[k] && (y[k] == p || y[k] == q)) continue;
            if (turn(p, q, y[k]) != -inner) return false;
        }
        return true;
    }

    std::array<Flat, 3> a_, b_;
    std::array<bool, 3> a_shared_{}, b_shared_{};
    int u_ = 0, v_ = 0;
};

// A triangle, and its corners' distances from the other one's plane, times a number.
class FilteredHalf {
public:
    FilteredHalf(std::span<const LatticePoint> points, const Triangle& own, const Triangle& other) {
        for (std::size_t i = 0; i < 3; ++i) {
            p_[i] = points[own[i]].doubles();
            is_shared_[i] = own[i] == other[0] || own[i] == other[1] || own[i] == other[2];
        }
    }
    [[nodiscard]] const Vector3& corner(std::size_t i) const { return p_[i]; }
    [[nodiscard]] bool is_shared(std::size_t i) const { return is_shared_[i]; }
    [[nodiscard]] const Vector3& shared_corner() const {
        return p_[is_shared_[0] ? 0 : is_shared_[1] ? 1 : 2];
    }
    /// \pre one corner is shared
    [[nodiscard]] std::array<Vector3, 2> own_corners() const {
        const std::size_t i = is_shared_[0] ? 0 : is_shared_[1] ? 1 : 2;
        return {p_[(i + 1) % 3], p_[(i + 2) % 3]};
    }
    void measure(const FilteredHalf& other) {
        const Vector3 a = minus(other.p_[1], other.p_[0]);
        const Vector3 b = minus(other.p_[2], other.p_[0]);
        for (std::size_t i = 0; i < 3; ++i) {
            if (is_shared_[i]) continue;
            distance_[i] = determinant(a, b, minus(p_[i], other.p_[0]));
            sign_[i] = distance_[i].sign();
        }
    }
    // All corners that are not shared.
    [[nodiscard]] bool is_one_sided() const {
        int all = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (is_shared_[i]) continue;
            if (sign_[i] == 0 || sign_[i] == -all) return false;
            all = sign_[i];
        }
        return true;
    }
    // Whether all signs are known.
    [[nodiscard]] bool is_clear() const {
        for (std::size_t i = 0; i < 3; ++i)
            if (!is_shared_[i] && sign_[i] == 0) return false;
        return true;
    }

    // A coordinate from an origin, as a quotient of positive divisor.
    struct Place {
        Ball over;
        Ball under;
    };
    // Where edges cross the other plane, and where a shared corner is.
    [[nodiscard]] std::array<Place, 2> ends(const Vector3& origin, std::size_t axis) const {
        std::array<Place, 2> out;
        std::size_t n = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t k = (i + 1) % 3;
            if (is_shared_[i] && n < 2) out[n++] = {from(origin, i, axis), Ball(1)};
            if (sign_[i] * sign_[k] < 0 && n < 2) {
                const Ball of_i = sign_[i] > 0 ? distance_[i] : -distance_[i];
                const Ball of_k = sign_[k] > 0 ? distance_[k] : -distance_[k];
                out[n++] = {from(origin, k, axis) * of_i + from(origin, i, axis) * of_k,
                            of_i + of_k};
            }
        }
        return out;
    }

private:
    [[nodiscard]] Ball from(const Vector3& origin, std::size_t corner, std::size_t axis) const {
        return Ball(p_[corner][axis]) - Ball(origin[axis]);
    }

    std::array<Vector3, 3> p_{};
    std::array<bool, 3> is_shared_{};
    std::array<Ball, 3> distance_{};
    std::array<int, 3> sign_{};  // 0 where it is shared, or not known
};

// Along which the planes' common line is longest, about.
std::size_t axis_of_line(const FilteredHalf& a, const FilteredHalf& b) {
    const auto normal = [](const FilteredHalf& h) {
        return cross(minus(h.corner(1), h.corner(0)), minus(h.corner(2), h.corner(0)));
    };
    const Vector3 along = cross(normal(a), normal(b));
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(along[k]) > std::fabs(along[axis])) axis = k;
    return axis;
}

// -1, 1, or 0 for unknown.
int order(const FilteredHalf::Place& a, const FilteredHalf::Place& b) {
    return (a.over * b.under - b.over * a.under).sign();
}

// Both triangles reach to either side of the other's plane, and all signs are known.
bool are_apart_on_line(const FilteredHalf& a, const FilteredHalf& b, int shared) {
    const std::size_t axis = axis_of_line(a, b);
    if (shared == 1) {
        // To either side of the shared corner, which is where both intervals begin.
        const Vector3 origin = a.shared_corner();
        const auto side = [&](const FilteredHalf& h) {
            const auto ends = h.ends(origin, axis);
            return ends[0].over.sign() + ends[1].over.sign();
        };
        return side(a) * side(b) < 0;
    }
    const Vector3 origin = a.corner(0);
    const auto of_a = a.ends(origin, axis);
    const auto of_b = b.ends(origin, axis);
    const int first = order(of_a[0], of_b[0]);
    return first != 0 && order(of_a[0], of_b[1]) == first && order(of_a[1], of_b[0]) == first &&
           order(of_a[1], of_b[1]) == first;
}

// The triangle strictly on the inner side of an edge, all points strictly on the outer one.
bool is_beyond(const std::array<Flat, 3>& t, std::size_t edge, std::span<const Flat> points) {
    const Flat& p = t[edge];
    const Flat& q = t[(edge + 1) % 3];
    const int inner = turn(p, q, t[(edge + 2) % 3]);
    for (const Flat& r : points)
        if (inner == 0 || turn(p, q, r) != -inner) return false;
    return true;
}

// What of y, but for a shared corner, lies in the plane of x.
struct InPlane {
    std::array<Flat, 2> own{};
    std::size_t count = 0;
    std::optional<Flat> shared;
};

// Whether a point or a segment is apart from the triangle, or has but a shared corner of it: the
// line of an edge is between convex figures that are apart.
bool is_apart_in_plane(const std::array<Flat, 3>& x, const InPlane& y) {
    const auto own = std::span(y.own).first(y.count);
    if (y.shared) {
        if (own.empty()) return true;
        for (std::size_t i = 0; i < 3; ++i)
            if ((x[i] == *y.shared || x[(i + 1) % 3] == *y.shared) && is_beyond(x, i, own))
                return true;
        return false;
    }
    for (std::size_t i = 0; i < 3; ++i)
        if (is_beyond(x, i, own)) return true;
    if (own.size() < 2) return false;
    const int side = turn(own[0], own[1], x[0]);
    return side != 0 && turn(own[0], own[1], x[1]) == side && turn(own[0], own[1], x[2]) == side;
}

// Where x lies across an axis, and y is on one side of it but for a corner or an edge in its plane.
bool is_apart_across_axis(const FilteredHalf& x, const FilteredHalf& y) {
    for (std::size_t k = 0; k < 3; ++k) {
        const double at = x.corner(0)[k];
        if (x.corner(1)[k] != at || x.corner(2)[k] != at) continue;
        const auto flat = [k](const Vector3& p) { return Flat{p[(k + 1) % 3], p[(k + 2) % 3]}; };
        InPlane found;
        int side = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double c = y.corner(i)[k];
            if (c != at) {
                const int s = c > at ? 1 : -1;
                if (s == -side) return false;
                side = s;
            } else if (y.is_shared(i)) {
                found.shared = flat(y.corner(i));
            } else {
                if (found.count == 2) return false;
                found.own[found.count++] = flat(y.corner(i));
            }
        }
        return side != 0 &&
               is_apart_in_plane({flat(x.corner(0)), flat(x.corner(1)), flat(x.corner(2))}, found);
    }
    return false;
}

bool is_plane_between(const FilteredHalf& a, const FilteredHalf& b, int shared) {
    if (shared == 1) return have_plane_between(a.shared_corner(), a.own_corners(), b.own_corners());
    return have_plane_between({a.corner(0), a.corner(1), a.corner(2)},
                              {b.corner(0), b.corner(1), b.corner(2)});
}

}  // namespace

bool are_plainly_apart(std::span<const LatticePoint> points, const Triangle& a, const Triangle& b,
                       int shared) {
    EmbeddingCounters& counters = embedding_counters();
    const auto decided = [](std::uint64_t& count) {
        ++count;
        return true;
    };
    if (shared < 2 && ProjectedFilter(points, a, b).is_apart()) return decided(counters.edge_lines);
    FilteredHalf x(points, a, b);
    FilteredHalf y(points, b, a);
    y.measure(x);
    if (y.is_one_sided()) return decided(counters.own_planes);
    if (shared == 2) {
        // Nearly in one plane the shared edge is between them.
        if (ProjectedFilter(points, a, b).is_apart()) return decided(counters.edge_lines);
        ++counters.exact_pairs;
        return false;
    }
    x.measure(y);
    if (x.is_one_sided() || is_apart_across_axis(x, y) || is_apart_across_axis(y, x))
        return decided(counters.own_planes);
    if (x.is_clear() && y.is_clear() && are_apart_on_line(x, y, shared))
        return decided(counters.intervals);
    if (is_plane_between(x, y, shared)) return decided(counters.other_planes);
    ++counters.exact_pairs;
    return false;
}

}  // namespace trisect::detail
