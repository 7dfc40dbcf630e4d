// SPDX-License-Identifier: Apache-2.0
//
// Does a boundary touch itself? Its triangles under the identity against each other: two that meet
// anywhere but in common corners and sides are in contact; so are two with a common side that is an
// edge of the boundary for one of them and runs through the face of the other.
//
// Nearly all pairs that come near each other have one corner in common and nothing else. That is
// seen in doubles: the cones of both triangles about the corner are on different sides of a plane
// through it, which is the plane of one of them, or contains a side of each, or goes across the way
// between their middles.

#include <trisect/bsp/interference/relation/self_contact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/bsp/interference/boxes/obb_pose.h>
#include <trisect/bsp/interference/boxes/triangle_filter.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/meeting_pairs.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

namespace {

struct CommonCorners {
    int count = 0;
    std::size_t of_s = 0;  // the last one
    std::size_t of_t = 0;
};

CommonCorners common_corners(const InterferenceModelData& model, const ModelTriangle& s,
                             const ModelTriangle& t) {
    CommonCorners r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (model.place[s.vertex[i].index] == model.place[t.vertex[j].index])
                r = {r.count + 1, i, j};
    return r;
}

// Whether the side that two triangles have in common is an edge for one of them only.
bool has_edge_in_face(const InterferenceModelData& model, const ModelTriangle& s,
                      const ModelTriangle& t) {
    const auto place = [&](const ModelTriangle& m, std::size_t i) {
        return model.place[m.vertex[i % 3].index];
    };
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const bool ahead = place(s, i) == place(t, j) && place(s, i + 1) == place(t, j + 1);
            const bool back = place(s, i) == place(t, j + 1) && place(s, i + 1) == place(t, j);
            if ((ahead || back) && s.edge[i].is_valid() != t.edge[j].is_valid()) return true;
        }
    return false;
}

TriangleCorners corners_of(const InterferenceModelData& model, std::uint32_t triangle) {
    TriangleCorners c;
    for (std::size_t i = 0; i < 3; ++i) c[i] = model.position(model.triangles[triangle].vertex[i]);
    return c;
}

Vector3 unit(const Vector3& v) {
    const double length = std::sqrt(dot(v, v));
    return {v[0] / length, v[1] / length, v[2] / length};
}

// Two rays p and two rays q from one point, whose components are off by at most `error`: whether
// the angles that they span certainly have nothing else in common. Bounds as in
// error_bounds.h.
bool only_apex_in_common(const std::array<Vector3, 2>& p, const std::array<Vector3, 2>& q,
                         double error) {
    const double g = std::max(std::max(largest_component(p[0]), largest_component(p[1])),
                              std::max(largest_component(q[0]), largest_component(q[1])));
    const double bound = difference_determinant_bound(g, error);
    const auto sides = [&](const Vector3& normal, const Vector3& v, const Vector3& w) {
        return std::pair(certain_sign(dot(normal, v), bound), certain_sign(dot(normal, w), bound));
    };
    const auto [q0, q1] = sides(cross(p[0], p[1]), q[0], q[1]);
    if (q0 * q1 > 0) return true;
    const auto [p0, p1] = sides(cross(q[0], q[1]), p[0], p[1]);
    if (p0 * p1 > 0) return true;
    // Across the way between the middles.
    Vector3 way = minus(unit(p[0]), unit(q[0]));
    const Vector3 other_way = minus(unit(p[1]), unit(q[1]));
    for (std::size_t k = 0; k < 3; ++k) way[k] += other_way[k];
    const double slack =
        (std::abs(way[0]) + std::abs(way[1]) + std::abs(way[2])) * (error + 0x1p-49 * g);
    if (dot(way, p[0]) > slack && dot(way, p[1]) > slack && dot(way, q[0]) < -slack &&
        dot(way, q[1]) < -slack)
        return true;
    // Planes through a side of each, with the other sides strictly on both sides of it.
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
            const auto [a, b] = sides(cross(p[i], q[j]), p[1 - i], q[1 - j]);
            if (a * b < 0) return true;
        }
    return false;
}

bool meet_in_corner_only(const InterferenceModelData& model, std::uint32_t s, std::uint32_t t,
                         const CommonCorners& common) {
    const TriangleCorners p = corners_of(model, s);
    const TriangleCorners q = corners_of(model, t);
    const auto rays = [](const TriangleCorners& c, std::size_t apex) {
        return std::array{minus(c[(apex + 1) % 3], c[apex]), minus(c[(apex + 2) % 3], c[apex])};
    };
    return only_apex_in_common(rays(p, common.of_s), rays(q, common.of_t),
                               2 * model.position_error);
}

PosedPair in_place(const InterferenceModelData& model) {
    const Lattice lattice = model.brep.lattice();
    return {Pose(), lattice, Pose(), lattice};
}

// Whether two triangles have a point in common that is not a corner of both.
bool meet_beside_corners(const InterferenceModelData& model, TrianglePairTest& test,
                         std::uint32_t s, std::uint32_t t) {
    const TriangleContact c = test(posed_triangle(model, s), posed_triangle(model, t));
    return std::ranges::any_of(c.corners(), [&](const MeetingPoint& p) {
        return !p.a.is_corner() || !p.b.is_corner() ||
               model.place[model.triangles[s].vertex[p.a.index()].index] !=
                   model.place[model.triangles[t].vertex[p.b.index()].index];
    });
}

bool find_self_contact(const InterferenceModelData& model) {
    const PosedModels models{model, model, in_place(model)};
    TrianglePairTest test(models.poses);
    return for_candidate_pairs(models, [&](std::uint32_t i, std::uint32_t j, PairVerdict) {
        if (i >= j) return false;
        const ModelTriangle& s = model.triangles[i];
        const ModelTriangle& t = model.triangles[j];
        const CommonCorners common = common_corners(model, s, t);
        // The triangles of a face fill it.
        if (s.face == t.face) return false;
        // Triangles with a common side lie on different sides of it or in different planes.
        if (common.count >= 2) return has_edge_in_face(model, s, t);
        if (common.count == 1 && meet_in_corner_only(model, i, j, common)) return false;
        return meet_beside_corners(model, test, i, j);
    });
}

// Around a triangle, along the axes of its tree.
OrientedBox box_around(const InterferenceModelData& model, const TriangleCorners& corners) {
    const ObbTree& tree = model.boxes;
    OrientedBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [lo, hi] = std::minmax({corners[0][k], corners[1][k], corners[2][k]});
        const double center = ((lo + hi) / 2 - tree.origin[k]) / tree.unit;
        const double half = (hi - lo) / 2 / tree.unit;
        box.axis[k][k] = 1;
        box.center[k] = static_cast<float>(center);
        // Rounding the centre moves it by 2^-24 of a number below 1.
        box.half[k] = static_cast<float>(
            1.001 *
            (half + 0x1p-23 + (model.position_error + 0x1p-50 * model.largest) / tree.unit));
    }
    return box;
}

// visit(t) for all triangles t that meet a triangle anywhere but in common corners and sides, until
// it returns true.
template <class Visit>
void for_touching(const InterferenceModelData& model, std::uint32_t s, Visit&& visit) {
    const ObbTree& tree = model.boxes;
    const TriangleCorners p = corners_of(model, s);
    const OrientedBox box = box_around(model, p);
    const ObbPose pose(tree, tree, ApproximateMap{});
    const double error = 2 * model.position_error;
    std::optional<PosedPair> poses;
    std::optional<TrianglePairTest> test;
    const auto keeps_off = [&](std::uint32_t t) {
        // The triangles of a face fill it.
        if (model.triangles[t].face == model.triangles[s].face) return true;
        const CommonCorners common = common_corners(model, model.triangles[s], model.triangles[t]);
        if (common.count >= 2) return true;
        if (common.count == 1
                ? meet_in_corner_only(model, s, t, common)
                : compare_triangles(p, corners_of(model, t), error) == PairVerdict::Apart)
            return true;
        if (!test) test.emplace(poses.emplace(in_place(model)));
        return !meet_beside_corners(model, *test, s, t);
    };
    std::vector<std::uint32_t> nodes{0};
    while (!nodes.empty()) {
        const ObbNode& node = tree.nodes[nodes.back()];
        nodes.pop_back();
        const unsigned hits = pose.overlaps(box, node);
        for (std::uint32_t lane = 0; lane < 4; ++lane) {
            if ((hits >> lane & 1U) == 0) continue;
            const ObbChild child = node.child[lane];
            if (!child.is_leaf()) {
                nodes.push_back(child.node());
                continue;
            }
            for (std::uint32_t k = 0; k < child.count(); ++k) {
                const std::uint32_t t = tree.order[child.first() + k];
                if (!keeps_off(t) && visit(t)) return;
            }
        }
    }
}

bool find_clear(const InterferenceModelData& model, std::uint32_t s) {
    bool is_clear = true;
    for_touching(model, s, [&is_clear](std::uint32_t) {
        is_clear = false;
        return true;
    });
    return is_clear;
}

}  // namespace

bool InterferenceModelData::touches_itself() const {
    work_once(self_contact_once_,
              [this] { touches_itself_ = !is_empty() && find_self_contact(*this); });
    return touches_itself_;
}

bool InterferenceModelData::is_clear(std::uint32_t triangle) const {
    enum State : std::uint8_t { Unknown, Clear, NotClear };
    // Two threads may find the same thing twice.
    std::uint8_t state = clear_[triangle].load(std::memory_order_relaxed);
    if (state == Unknown) {
        state = find_clear(*this, triangle) ? Clear : NotClear;
        clear_[triangle].store(state, std::memory_order_relaxed);
    }
    return state == Clear;
}

std::vector<std::uint32_t> touching_triangles(const InterferenceModelData& model,
                                              std::uint32_t triangle) {
    std::vector<std::uint32_t> touching;
    for_touching(model, triangle, [&touching](std::uint32_t t) {
        touching.push_back(t);
        return false;
    });
    return touching;
}

TellingCrossings::TellingCrossings(const InterferenceModelData& a, const InterferenceModelData& b,
                                   const ApproximateMap& to_a)
    : a_(a),
      b_(b),
      to_a_(to_a),
      error_(a.position_error + to_a.error_below(b.largest, b.position_error)) {}

// Null when patience is at its end.
const std::vector<std::uint32_t>* TellingCrossings::touching(const InterferenceModelData& model,
                                                             std::uint32_t triangle,
                                                             Touching& known) {
    for (const auto& [t, all] : known)
        if (t == triangle) return &all;
    if (known.size() == patience) return nullptr;
    known.emplace_back(triangle, model.is_clear(triangle) ? std::vector<std::uint32_t>{}
                                                          : touching_triangles(model, triangle));
    return &known.back().second;
}

bool TellingCrossings::tells(std::uint32_t i, std::uint32_t j) {
    if (a_.is_clear(i) && b_.is_clear(j)) return true;
    const auto* at_i = touching(a_, i, known_a_);
    const auto* at_j = touching(b_, j, known_b_);
    if (at_i == nullptr || at_j == nullptr) return false;
    const auto are_apart = [this](std::uint32_t s, std::uint32_t t) {
        TriangleCorners q = corners_of(b_, t);
        for (auto& corner : q) corner = to_a_(corner);
        return compare_triangles(corners_of(a_, s), q, error_) == PairVerdict::Apart;
    };
    return std::ranges::all_of(*at_i, [&](std::uint32_t s) { return are_apart(s, j); }) &&
           std::ranges::all_of(*at_j, [&](std::uint32_t t) { return are_apart(i, t); });
}

}  // namespace trisect::detail
