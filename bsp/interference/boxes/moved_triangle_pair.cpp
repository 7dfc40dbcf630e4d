// SPDX-License-Identifier: Apache-2.0
//
// The corners of the intersection of two triangles that do not lie in one plane are ends of what
// each cuts out of the line that their planes share: a corner in the other's plane, or the point
// where a side passes through it. Where such a point lies in the other triangle is decided by
// orientations alone: of a corner, in the plane; of a side's point, by the side's orientation to
// the three sides of the other triangle (Guigue and Devillers 2003 decide by the same signs). No
// point is ever computed. Signs are zero where features meet, and then name the feature.
//
// In one plane the corners of the intersection are corners in the other triangle and proper
// crossings of sides. The numbers of points give the dimension, since different pairs of features
// are different points.
//
// B may be mirrored. Then the images of its corners run clockwise about the image of its outward
// normal; the one place where that matters has the factor `turn`.

#include <trisect/bsp/interference/boxes/moved_triangle_pair.h>

#include <cstddef>
#include <optional>

#include <trisect/kernel/counters.h>

namespace trisect::detail {

namespace {

using Signs = std::array<int, 3>;

std::optional<std::size_t> only_corner_in_plane(const Signs& s) {
    for (std::size_t k = 0; k < 3; ++k)
        if (s[k] == 0 && s[(k + 1) % 3] * s[(k + 2) % 3] > 0) return k;
    return std::nullopt;
}

constexpr std::size_t next(std::size_t i) { return i == 2 ? 0 : i + 1; }

bool all_of_one_side(const Signs& s) {
    return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0);
}

// Everything about one pair; signs of several uses are computed once.
class Pair {
public:
    Pair(const PosedTriangle& a, const PosedTriangle& b, const PosedPair& poses)
        : a_(a),
          b_(b),
          moved_a_{MovedPoint(*a.corner[0], poses.to_b), MovedPoint(*a.corner[1], poses.to_b),
                   MovedPoint(*a.corner[2], poses.to_b)},
          moved_b_{MovedPoint(*b.corner[0], poses.to_a), MovedPoint(*b.corner[1], poses.to_a),
                   MovedPoint(*b.corner[2], poses.to_a)},
          turn_(poses.to_a.is_mirror() ? -1 : 1) {
        for (auto& row : edges_) row.fill(unknown);
    }

    void meet_across(const Signs& of_a, const Signs& of_b) {
        // A triangle with a corner in the other's plane and the rest on one side of it meets that
        // plane in this point alone. Most pairs at fine flush surfaces are of two such.
        const std::optional<std::size_t> at_a = only_corner_in_plane(of_a);
        const std::optional<std::size_t> at_b = only_corner_in_plane(of_b);
        if (at_a && at_b) {
            if (moved_b_[*at_b].is_at(*a_.corner[*at_a]))
                note(Feature::corner(*at_a), Feature::corner(*at_b));
            return;
        }
        if (at_a) return note(Feature::corner(*at_a), corner_of_a(*at_a));
        if (at_b) return note(corner_of_b(*at_b), Feature::corner(*at_b));
        for (std::size_t k = 0; k < 3; ++k) {
            if (of_a[k] == 0) note(Feature::corner(k), corner_of_a(k));
            if (of_b[k] == 0) note(corner_of_b(k), Feature::corner(k));
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (of_a[k] * of_a[next(k)] < 0) note(Feature::side(k), side_of_a(k, of_a[k]));
            if (of_b[k] * of_b[next(k)] < 0) note(side_of_b(k, of_b[k]), Feature::side(k));
        }
        contact_.crossing = contact_.count == 2 && is_chord();
    }

    void meet_in_plane(int sense) {
        contact_.coplanar = true;
        contact_.opposite = sense < 0;
        std::array<Signs, 3> of_b;  // corner k of B to the sides of A
        std::array<Signs, 3> of_a;
        if (is_beyond_a_side(a_, moved_b_, of_b) || is_beyond_a_side(b_, moved_a_, of_a)) return;
        for (std::size_t k = 0; k < 3; ++k) {
            note(Feature::corner(k), feature_from_signs(of_a[k]));
            note(feature_from_signs(of_b[k]), Feature::corner(k));
        }
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                if (of_b[j][i] * of_b[next(j)][i] < 0 && of_a[i][j] * of_a[next(i)][j] < 0)
                    note(Feature::side(i), Feature::side(j));
    }

    [[nodiscard]] const TriangleContact& contact() const { return contact_; }

private:
    static constexpr int unknown = 2;

    // Signs of points in the triangle's plane towards its sides; stops with true at a side that has
    // all of them beyond it.
    static bool is_beyond_a_side(const PosedTriangle& t, const std::array<MovedPoint, 3>& points,
                                 std::array<Signs, 3>& signs) {
        const int axis = t.plane->dominant_axis();
        const int up = t.plane->normal(axis) > 0 ? 1 : -1;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k)
                signs[k][i] =
                    up * planar_orientation(*t.corner[i], *t.corner[next(i)], points[k], axis);
            if (signs[0][i] < 0 && signs[1][i] < 0 && signs[2][i] < 0) return true;
        }
        return false;
    }

    // Corner k of A, known to be in B's plane, towards the sides of B; and the other way round.
    Signs signs_of_a(std::size_t k) const { return planar_signs(b_, moved_a_[k]); }
    Signs signs_of_b(std::size_t k) const { return planar_signs(a_, moved_b_[k]); }
    static Signs planar_signs(const PosedTriangle& t, const MovedPoint& p) {
        const int axis = t.plane->dominant_axis();
        const int up = t.plane->normal(axis) > 0 ? 1 : -1;
        Signs s{};
        for (std::size_t i = 0; i < 3; ++i)
            s[i] = up * planar_orientation(*t.corner[i], *t.corner[next(i)], p, axis);
        return s;
    }
    std::optional<Feature> corner_of_a(std::size_t k) const {
        return feature_from_signs(signs_of_a(k));
    }
    std::optional<Feature> corner_of_b(std::size_t k) const {
        return feature_from_signs(signs_of_b(k));
    }

    // The point where side i of A, whose first end is on the side `from` of B's plane, passes
    // through that plane: where is it in B?
    std::optional<Feature> side_of_a(std::size_t i, int from) {
        Signs s{};
        for (std::size_t j = 0; j < 3; ++j) {
            s[j] = turn_ * from * edge_sign(i, j);
            if (s[j] < 0) return std::nullopt;
        }
        return feature_from_signs(s);
    }
    std::optional<Feature> side_of_b(std::size_t j, int from) {
        Signs s{};
        for (std::size_t i = 0; i < 3; ++i) {
            s[i] = from * edge_sign(i, j);
            if (s[i] < 0) return std::nullopt;
        }
        return feature_from_signs(s);
    }
    int edge_sign(std::size_t i, std::size_t j) {
        int& sign = edges_[i][j];
        if (sign == unknown)
            sign = orientation(*a_.corner[i], *a_.corner[next(i)], moved_b_[j], moved_b_[next(j)]);
        return sign;
    }

    void note(std::optional<Feature> a, std::optional<Feature> b) {
        if (!a || !b) return;
        const MeetingPoint p{*a, *b};
        for (const MeetingPoint& q : contact_.corners())
            if (p == q) return;
        contact_.points[contact_.count++] = p;
    }

    // Whether the segment between the two points runs through the interiors of both: between points
    // of a triangle's border it does unless one side carries both.
    bool is_chord() const {
        const MeetingPoint& p = contact_.points[0];
        const MeetingPoint& q = contact_.points[1];
        for (std::size_t i = 0; i < 3; ++i)
            if ((p.a.is_on_side(i) && q.a.is_on_side(i)) ||
                (p.b.is_on_side(i) && q.b.is_on_side(i)))
                return false;
        return true;
    }

    const PosedTriangle& a_;
    const PosedTriangle& b_;
    std::array<MovedPoint, 3> moved_a_;
    std::array<MovedPoint, 3> moved_b_;
    int turn_;
    std::array<Signs, 3> edges_{};
    TriangleContact contact_;
};

}  // namespace

std::optional<Feature> feature_from_signs(const std::array<int, 3>& s) {
    if (s[0] < 0 || s[1] < 0 || s[2] < 0) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i) {
        if (s[i] != 0) continue;
        if (s[next(i)] == 0) return Feature::corner(next(i));
        if (s[next(next(i))] == 0) return Feature::corner(i);
        return Feature::side(i);
    }
    return Feature::interior();
}

const PulledPlane& TrianglePairTest::Planes::get(const Plane& plane, const RelativePose& pose) {
    Entry& e = entries_[reinterpret_cast<std::uintptr_t>(&plane) / sizeof(Plane) % entries_.size()];
    if (e.plane != &plane) {
        e.pulled.emplace(plane, pose);
        e.plane = &plane;
    }
    return *e.pulled;
}

TriangleContact TrianglePairTest::operator()(const PosedTriangle& a, const PosedTriangle& b) {
    if (a.plane == coplanar_a_ && b.plane == coplanar_b_) {
        detail::counters_of_thread<PredicateCounters>.symbolic += 3;
        Pair pair(a, b, *poses_);
        pair.meet_in_plane(sense_);
        return pair.contact();
    }
    const PulledPlane& plane_a = planes_a_.get(*a.plane, poses_->to_a);
    Signs of_b{};
    for (std::size_t k = 0; k < 3; ++k) of_b[k] = plane_a.side_of(*b.corner[k]);
    if (all_of_one_side(of_b)) return {};
    if (of_b == Signs{}) {
        coplanar_a_ = a.plane;
        coplanar_b_ = b.plane;
        sense_ = plane_a.sense_of(*b.plane);
        Pair pair(a, b, *poses_);
        pair.meet_in_plane(sense_);
        return pair.contact();
    }
    const PulledPlane& plane_b = planes_b_.get(*b.plane, poses_->to_b);
    Signs of_a{};
    for (std::size_t k = 0; k < 3; ++k) of_a[k] = plane_b.side_of(*a.corner[k]);
    if (all_of_one_side(of_a)) return {};
    Pair pair(a, b, *poses_);
    pair.meet_across(of_a, of_b);
    return pair.contact();
}

}  // namespace trisect::detail
