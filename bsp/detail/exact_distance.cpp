// SPDX-License-Identifier: Apache-2.0
//
// The exact distance of two triangles apart: all pairs of sides, and corners above insides, in
// rationals. Slow, and only for the pairs that are left when somebody asks for the exact number.

#include <array>
#include <cstddef>
#include <optional>

#include <trisect/bsp/detail/boundary_pairs.h>
#include <trisect/bsp/detail/distance_search.h>
#include <trisect/bsp/detail/exact_place.h>

namespace trisect::detail {

namespace {

using Vector = std::array<ExactRational, 3>;
using Corners = std::array<Vector, 3>;

Vector subtracted(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
ExactRational dotted(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector crossed(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool in_unit(const ExactRational& v) { return v.sign() >= 0 && v <= ExactRational(1); }

class Least {
public:
    void note(const ExactRational& v) {
        if (!least_ || v < *least_) least_ = v;
    }
    [[nodiscard]] const ExactRational& value() const { return *least_; }

private:
    std::optional<ExactRational> least_;
};

// Of a point and a segment.
void point_and_side(const Vector& x, const Vector& a, const Vector& b, Least& least) {
    const Vector d = subtracted(b, a);
    const Vector w = subtracted(x, a);
    const ExactRational t = dotted(d, w) / dotted(d, d);
    if (!in_unit(t)) return;  // an end, which is a corner of another side's question
    least.note(dotted(w, w) - t * dotted(d, w));
}

// Of the lines of two segments, where that is between their ends.
void sides(const Vector& a, const Vector& b, const Vector& c, const Vector& d, Least& least) {
    const Vector u = subtracted(b, a);
    const Vector v = subtracted(d, c);
    const Vector r = subtracted(a, c);
    const ExactRational uu = dotted(u, u);
    const ExactRational vv = dotted(v, v);
    const ExactRational uv = dotted(u, v);
    const ExactRational det = uu * vv - uv * uv;
    if (det.sign() == 0) return;  // parallel: ends do it
    const ExactRational s = (uv * dotted(v, r) - vv * dotted(u, r)) / det;
    const ExactRational t = (uu * dotted(v, r) - uv * dotted(u, r)) / det;
    if (!in_unit(s) || !in_unit(t)) return;
    const Vector n = crossed(u, v);
    const ExactRational height = dotted(n, r);
    least.note(height * height / dotted(n, n));
}

void point_and_inside(const Vector& x, const Corners& t, Least& least) {
    const Vector u = subtracted(t[1], t[0]);
    const Vector v = subtracted(t[2], t[0]);
    const Vector w = subtracted(x, t[0]);
    const Vector n = crossed(u, v);
    const ExactRational nn = dotted(n, n);
    const ExactRational beta = dotted(crossed(w, v), n) / nn;
    const ExactRational gamma = dotted(crossed(u, w), n) / nn;
    if (beta.sign() < 0 || gamma.sign() < 0 || beta + gamma > ExactRational(1)) return;
    const ExactRational height = dotted(n, w);
    least.note(height * height / nn);
}

Corners corners(const InterferenceModelData& m, const Pose& pose, std::uint32_t triangle) {
    Corners r;
    for (std::size_t i = 0; i < 3; ++i)
        r[i] = in_world(exact_place(m.brep.point(m.triangles[triangle].vertex[i])),
                        m.brep.lattice(), pose);
    return r;
}

}  // namespace

ExactRational exact_squared_distance(const InterferenceModelData& a, const Pose& pose_a,
                                     std::uint32_t triangle_a, const InterferenceModelData& b,
                                     const Pose& pose_b, std::uint32_t triangle_b) {
    ObbWalk::Stack stack;
    if (BoundaryPairs(a, pose_a, b, pose_b, stack).exact(triangle_a, triangle_b).meets()) return {};
    const Corners p = corners(a, pose_a, triangle_a);
    const Corners q = corners(b, pose_b, triangle_b);
    Least least;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const Vector w = subtracted(p[i], q[j]);
            least.note(dotted(w, w));
            point_and_side(p[i], q[j], q[(j + 1) % 3], least);
            point_and_side(q[j], p[i], p[(i + 1) % 3], least);
            sides(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3], least);
        }
        point_and_inside(p[i], q, least);
        point_and_inside(q[i], p, least);
    }
    return least.value();
}

}  // namespace trisect::detail
