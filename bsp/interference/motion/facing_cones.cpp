// SPDX-License-Identifier: Apache-2.0
//
// Back-face culling of moving solids: Vanecek, "Back-face culling applied to collision detection of
// polyhedra" (1994); with cones of normals in a hierarchy: Redon, Kheddar and Coquillart,
// "Hierarchical back-face culling for collision detection" (2002). There it is a heuristic that
// leaves out half of the faces. Here nothing may be lost, so this is what it rests on.
//
// Let the solids be apart before time t, and let x be a common point at t. With v the velocity at
// t, relative to A, of the point of B that is at x, that point was at x - v s + O(s²) a little
// before. Suppose n · v > 0 for the outward normals n of all faces of A through x. Close to x, A is
// a cone C of x, which need not be convex. If -v were outside C, go from a generic point in the
// inside of C in direction -v: sooner or later that leaves C, through the inside of a face, with n
// · (-v) > 0. If -v were on the boundary of C, it would lie in a face, n · v = 0. Both contradict;
// so -v is inside C, and the point of B was inside A just before t. Hence some face of A through x
// has n · v <= 0, and by the same argument, seen from B, some face of B has m · v >= 0.
//
// So a first contact is never lost if a triangle is left out only where n · v > 0 for the normals
// of all faces at everything that events look at with it: its own, those around vertices that it
// owns, those on both sides of edges that it owns (EventModel). Where vertices have copies C is
// bounded by the faces of all copies, and the copy that has the face found above is not left out.
//
// v. With B's points at y = N(p) / w, of Bernstein coefficients N_k and w_k, v is (N' - y w') / w,
// and y is within the sweep of the map in the middle. So w v is a mean of n ((M_k+1 - M_k) - M
// (w_k+1 - w_k)) p and the same with shifts, within n sweep |w_k+1 - w_k|. The mean over k is taken
// and the largest deviation from it, over a ball around B. For a translation along a straight line
// nothing deviates.
//
// Seen from B normals are turned back instead: m · (M^-1 v), where M^-1 is within s² e of the
// inverse in the middle, s a bound on the stretch of M^-1 and e one on |M - middle|.

#include <trisect/bsp/interference/motion/facing_cones.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/inverse_matrix.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// More triangles than this bend too much.
constexpr std::uint32_t most_triangles = 96;
// All roundings here: each number is a sum of a few dozen products, relative to what bounds them.
constexpr double rounding = 0x1p-40;

Vector3 product(const Matrix& m, const Vector3& v) {
    return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
double norm(const Matrix& m) {
    return std::sqrt(dot(m[0], m[0]) + dot(m[1], m[1]) + dot(m[2], m[2]));
}

// The triangles below a box; of many only some more than `most_triangles`.
std::vector<std::uint32_t> triangles_below(const ObbTree& tree, ObbId box) {
    std::vector<std::uint32_t> r;
    std::vector<ObbChild> stack{tree.child(box)};
    while (!stack.empty() && r.size() <= most_triangles) {
        const ObbChild child = stack.back();
        stack.pop_back();
        if (child.is_leaf()) {
            for (std::uint32_t i = 0; i < child.count(); ++i)
                r.push_back(tree.order[child.first() + i]);
            continue;
        }
        const ObbNode& n = tree.nodes[child.node()];
        for (std::size_t lane = 0; lane < 4; ++lane)
            if (n.half[0][lane] >= 0) stack.push_back(n.child[lane]);
    }
    return r;
}

}  // namespace

// A ball around B.
struct RecedingFaces::Extent {
    Vector3 center{};
    double radius = 0;
};

// What two coefficients say of the velocity of a point p: turn p + way. `size` bounds what was
// added up for it.
struct RecedingFaces::Step {
    Matrix turn{};
    Vector3 way{};
    double size = 0;
};

RecedingFaces::Step RecedingFaces::step_between(const BallMotion::Maps& m0,
                                                const BallMotion::Maps& m1, const SweptMap& swept,
                                                const Extent& extent) {
    Step s;
    const double w = m1.weight.value - m0.weight.value;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const double part = swept.map.m[i][j] * w;
            s.turn[i][j] = (m1.matrix[i][j].value - m0.matrix[i][j].value) - part;
            s.size += (std::abs(m1.matrix[i][j].value) + m1.matrix[i][j].error +
                       m0.matrix[i][j].error + std::abs(part)) *
                      (std::abs(extent.center[j]) + extent.radius);
        }
        const double part = swept.map.t[i] * w;
        s.way[i] = (m1.shift[i].value - m0.shift[i].value) - part;
        s.size +=
            std::abs(m1.shift[i].value) + m1.shift[i].error + m0.shift[i].error + std::abs(part);
    }
    return s;
}

// Of the balls' errors in such a sum.
double RecedingFaces::errors_of(const BallMotion::Maps& m, const SweptMap& swept,
                                const Extent& extent) {
    double errors = m.weight.error * (norm(swept.map.m) * (length(extent.center) + extent.radius) +
                                      length(swept.map.t));
    for (std::size_t i = 0; i < 3; ++i) {
        errors += m.shift[i].error;
        for (std::size_t j = 0; j < 3; ++j)
            errors += m.matrix[i][j].error * (std::abs(extent.center[j]) + extent.radius);
    }
    return errors;
}

// For unit vectors at most α from the axis c, cos α > 0, and c · v > 0, the least product with v is
// at α: |v| cos(φ + α), with φ between c and v.
bool FacingCones::Cone::is_all_along(const std::array<double, 3>& v, double slack) const {
    const double along = dot(axis, v);
    if (!(cosine > 0) || !(along > 0)) return false;
    const double square = dot(v, v);
    const double across = std::sqrt(std::max(0.0, square - along * along) + rounding * square);
    return along * cosine - across * sine > slack + rounding * std::sqrt(square);
}

FacingCones::FacingCones(const ModelEvents& model)
    : model_(&model), place_(4 * model.data().boxes.nodes.size()), cones_(1) {}

const FacingCones::Cone& FacingCones::of(ObbId box) {
    std::uint32_t& place = place_[box.index];
    if (place == 0) {
        place = static_cast<std::uint32_t>(cones_.size());
        cones_.push_back(make(box));
    }
    return cones_[place];
}

FacingCones::Cone FacingCones::make(ObbId box) {
    const std::vector<std::uint32_t> triangles = triangles_below(model_->data().boxes, box);
    Cone cone;
    if (triangles.size() > most_triangles) return cone;
    normals_.clear();
    for (const std::uint32_t t : triangles) append_normals(t);
    for (const Normal& n : normals_)
        for (std::size_t k = 0; k < 3; ++k) cone.axis[k] += n[k];
    const double size = length(cone.axis);
    if (!(size > 0)) return cone;
    for (double& c : cone.axis) c /= size;
    double cosine = 1;
    for (const Normal& n : normals_) cosine = std::min(cosine, dot(cone.axis, n));
    cone.cosine = cosine - rounding;
    cone.sine = std::sqrt(std::max(0.0, 1 - cone.cosine * cone.cosine)) + rounding;
    return cone;
}

void FacingCones::append_normals(std::uint32_t triangle) {
    const ModelTriangle& t = model_->triangle(triangle);
    const Brep& brep = model_->data().brep;
    append_normal(t.face);
    for (std::size_t i = 0; i < 3; ++i) {
        if (model_->owns_vertex(triangle, i)) {
            const HalfedgeId start = brep.outgoing(t.vertex[i]);
            HalfedgeId h = start;
            do {
                append_normal(brep.face(h));
                h = brep.twin(brep.prev(h));
            } while (h != start);
        }
        if (t.edge[i].is_valid() && model_->owns_edge(triangle, i)) {
            const HalfedgeId h = brep.halfedge(t.edge[i]);
            append_normal(brep.face(h));
            append_normal(brep.face(brep.twin(h)));
        }
    }
}

void FacingCones::append_normal(FaceId face) {
    const Plane& plane = model_->data().brep.plane(face);
    Normal n{plane.approx_normal(0), plane.approx_normal(1), plane.approx_normal(2)};
    const double size = length(n);
    for (double& c : n) c /= size;
    normals_.push_back(n);
}

void RecedingFaces::set(const BallMotion& over, const SweptMap& swept) {
    error_ = HUGE_VAL;
    inverse_error_ = HUGE_VAL;
    if (over.degree == 0) return;
    double least_weight = HUGE_VAL;
    for (std::size_t k = 0; k <= over.degree; ++k)
        least_weight = std::min(least_weight, over.maps[k].weight.lower());
    if (!(least_weight > 0)) return;
    set_velocity(over, swept);
    set_inverse(over, swept, least_weight);
}

void RecedingFaces::set_velocity(const BallMotion& over, const SweptMap& swept) {
    const InterferenceModelData& b = b_.data();
    const Extent extent{b.boxes.origin, b.boxes.radius * b.boxes.unit};
    // The mean over k telescopes to the last coefficient minus the first.
    const auto n = static_cast<double>(over.degree);
    const Step whole = step_between(over.maps[0], over.maps[over.degree], swept, extent);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) turn_[i][j] = whole.turn[i][j] / n;
        way_[i] = whole.way[i] / n;
    }
    double size = whole.size;
    double deviation = 0;
    double weight_step = 0;
    double errors = errors_of(over.maps[0], swept, extent);
    for (std::size_t k = 0; k < over.degree; ++k) {
        const BallMotion::Maps& next = over.maps[k + 1];
        const Step step = step_between(over.maps[k], next, swept, extent);
        size = std::max(size, step.size);
        deviation = std::max(deviation, deviation_of(step, extent));
        weight_step =
            std::max(weight_step, std::abs(next.weight.value - over.maps[k].weight.value) +
                                      next.weight.error + over.maps[k].weight.error);
        errors = std::max(errors, errors_of(next, swept, extent));
    }
    turn_norm_ = norm(turn_);
    error_ = bound_slack * (deviation + weight_step * swept.sweep + 4 * errors) + 0x1p-46 * size;
}

// Of all points of B.
double RecedingFaces::deviation_of(const Step& step, const Extent& extent) const {
    Matrix turn = step.turn;
    Vector3 way = step.way;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) turn[i][j] -= turn_[i][j];
        way[i] = way[i] - way_[i] + dot(turn[i], extent.center);
    }
    return norm(turn) * extent.radius + length(way);
}

// Entries of M are those of the map in the middle within what the coefficients deviate from it.
void RecedingFaces::set_inverse(const BallMotion& over, const SweptMap& swept,
                                double least_weight) {
    double squares = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            double most = 0;
            for (std::size_t k = 0; k <= over.degree; ++k) {
                const BallMotion::Maps& m = over.maps[k];
                const Ball rest = m.matrix[i][j] - Ball(swept.map.m[i][j]) * m.weight;
                most = std::max(most, std::abs(rest.value) + rest.error);
            }
            squares += most * most;
        }
    const double reach = std::sqrt(squares) / least_weight;
    inverse_ = inverse_of(swept.map.m);
    inverse_norm_ = norm(inverse_);
    const double rest = std::sqrt(square_off_identity(inverse_, swept.map.m));
    const double stretch = inverse_stretch(over);
    inverse_error_ = bound_slack * (stretch * stretch * reach + stretch * rest) +
                     0x1p-46 * inverse_norm_ * inverse_norm_ * norm(swept.map.m);
}

bool RecedingFaces::operator()(ObbId a, ObbId b) {
    if (!(error_ < HUGE_VAL)) return false;
    const ObbTree& tree = b_.data().boxes;
    const ObbNode& node = tree.nodes[b.node()];
    Vector3 p{};
    Vector3 half{};
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = tree.origin[k] + tree.unit * static_cast<double>(node.center[k][b.lane()]);
        half[k] = tree.unit * static_cast<double>(node.half[k][b.lane()]);
    }
    Vector3 v = product(turn_, p);
    for (std::size_t k = 0; k < 3; ++k) v[k] += way_[k];
    const double slack = error_ + bound_slack * turn_norm_ * length(half);
    const auto is_separating = [&] {
        if (cones_a_.of(a).is_all_along(v, slack)) return true;
        if (!(inverse_error_ < HUGE_VAL)) return false;
        Vector3 back = product(inverse_, v);
        for (double& c : back) c = -c;
        return cones_b_.of(b).is_all_along(
            back, inverse_norm_ * slack + inverse_error_ * (length(v) + slack));
    };
    if (!is_separating()) return false;
    ++left_out_;
    return true;
}

}  // namespace trisect::detail
