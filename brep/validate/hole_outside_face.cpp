// SPDX-License-Identifier: Apache-2.0
//
// hole_outside_face: an inner loop that is not inside its face's outer loop.
//
// Corners of a Brep may be points of three planes, so the test uses signs of planes only. From a
// corner h of the inner loop a ray runs in the face's plane along the axis u; an edge p -> q of the
// outer loop is crossed if p and q are on different sides of h along the axis v, and h is to its
// left or right. The neighbouring face's plane decides which side that is: with n the face's
// normal, m the neighbour's and the edge running along s·(n × m), s = ±1, the face lies where m has
// the sign -s, because m · (n × (n × m)) = (n·m)² - n²m² < 0. Where the neighbour is coplanar, the
// plane through the edge is built if both ends are lattice points; otherwise the hole is left to
// the benefit of the doubt.

#include <compare>
#include <optional>

#include <trisect/brep/brep.h>
#include <trisect/brep/validate/checked_mesh.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

namespace {

int sign(std::strong_ordering o) { return o < 0 ? -1 : (o > 0 ? 1 : 0); }

class HoleTest {
public:
    HoleTest(const Brep& brep, FaceId face) : brep_(brep), face_(face), plane_(brep.plane(face)) {
        const int axis = plane_.dominant_axis();
        u_ = (axis + 1) % 3;
        v_ = (axis + 2) % 3;
        up_ = plane_.normal(axis) > 0;
    }

    // Location of h: 1 inside the outer loop, 0 on it, -1 outside, nothing when undecided.
    [[nodiscard]] std::optional<int> locate(const Point& h) const {
        bool inside = false;
        for (const HalfedgeId e : brep_.halfedges(brep_.outer_loop(face_))) {
            const Point& p = brep_.point(brep_.origin(e));
            const Point& q = brep_.point(brep_.target(e));
            if (p == h || q == h) return 0;
            const auto p_level = compare_coordinate(p, h, v_);
            const auto q_level = compare_coordinate(q, h, v_);
            const bool p_above = p_level > 0;
            const bool q_above = q_level > 0;
            if (p_level == 0 && q_level == 0 &&  // the edge runs along the ray
                (compare_coordinate(p, h, u_) > 0) != (compare_coordinate(q, h, u_) > 0))
                return 0;
            if (p_above == q_above) continue;
            const auto left = side(e, p, q, h);
            if (!left) return std::nullopt;
            if (*left == 0) return 0;
            // Left of an edge that goes up (seen with the normal towards the viewer) is the side
            // of smaller u: the ray towards larger u crosses it.
            if ((*left > 0) == (q_above == up_)) inside = !inside;
        }
        return inside ? 1 : -1;
    }

private:
    // 1 when h is to the left of the halfedge, seen from above the face.
    [[nodiscard]] std::optional<int> side(HalfedgeId e, const Point& p, const Point& q,
                                          const Point& h) const {
        const Plane& other = brep_.plane(brep_.face(brep_.twin(e)));
        for (int axis = 0; axis < 3; ++axis) {
            const int line = sign_of_cross(plane_, other, axis);
            if (line == 0) continue;
            const int s = line * sign(compare_coordinate(q, p, axis));
            return -s * sign_of(side_of(h, other));
        }
        if (!p.is_lattice() || !q.is_lattice()) return std::nullopt;
        const int axis = plane_.dominant_axis();
        // Normal (q - p) × e_axis points to the right of p -> q seen along +axis.
        const int right = sign_of(side_of(h, Plane::along_axis(p.lattice(), q.lattice(), axis)));
        return up_ ? -right : right;
    }

    const Brep& brep_;
    FaceId face_;
    const Plane& plane_;
    int u_ = 0;
    int v_ = 0;
    bool up_ = true;
};

}  // namespace

void check_holes(const Brep& brep, ValidationReport& report) {
    for (const FaceId f : brep.faces()) {
        const HoleTest test(brep, f);
        for (const LoopId l : brep.inner_loops(f)) {
            std::optional<int> where = 0;
            HalfedgeId at;
            for (const HalfedgeId e : brep.halfedges(l)) {  // the first corner off the outer loop
                at = e;
                where = test.locate(brep.point(brep.origin(e)));
                if (!where || *where != 0) break;
            }
            if (!where || *where >= 0) continue;
            report.add(DefectKind::HoleOutsideFace, [&] {
                const auto c = brep.point(brep.origin(at)).nearest();
                const Lattice lattice = brep.lattice();
                const Point3d place{lattice.to_double(c[0]), lattice.to_double(c[1]),
                                    lattice.to_double(c[2])};
                return Defect{DefectKind::HoleOutsideFace,
                              {brep.origin(at).index},
                              {f.index},
                              place,
                              "a hole of face " + std::to_string(f.index) + " at " +
                                  place_text(place) + " lies outside the face"};
            });
        }
    }
}

}  // namespace trisect::detail
