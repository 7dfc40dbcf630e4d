// SPDX-License-Identifier: Apache-2.0
//
// Sorting half-planes around a line without angles.
//
// Let d be the reference direction of the edge and let a face with outward normal n use the edge
// in direction s·d, s = ±1. Seen from outside, the face lies to the left of its edge, so it extends
// from the edge in direction
//
//     t = s · n × d.
//
// Look at the plane across the edge with d pointing at the viewer. n × d is n turned clockwise by a
// quarter (and scaled by |d|), the same turn for every face, so the t are in the same circular
// order as the vectors m = s·n. For two of them
//
//     sign d·(m_a × m_b) = s_a s_b · sign d·(n_a × n_b),      sign m_a·m_b = s_a s_b · sign
//     n_a·n_b,
//
// and n_a × n_b is parallel to d, so one component of it and of d decide the first sign. The naive
// way, angles of rounded normals, fails exactly for the faces that matter: nearly coplanar ones.
//
// Which wedges are solid? d × t = s·n·|d|², so turning counter-clockwise from a face with s = +1
// leads to the side of its outward normal: the solid lies clockwise of it and the face *closes* a
// solid wedge in counter-clockwise order. A face with s = -1 *opens* one. Around an edge of a
// regular solid the two kinds alternate, and each opening face pairs with the next closing one: the
// material of a wedge stays connected, the wedges come apart, and the result is a manifold after
// an infinitesimal separation. Pairing across the empty wedges would be just as consistent, but
// would weld solids that merely touch.
//
// Two faces in the same half-plane with opposite senses are either a slit without width between two
// solid wedges or a surface without thickness. A regular solid has neither; the boundary of two
// solids that touch in a face has the slit. Closing faces come first, which means the slit.

#include <trisect/brep/radial_order.h>

#include <algorithm>
#include <numeric>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/predicates.h>

namespace trisect {

namespace {

class RadialSorter {
public:
    RadialSorter(std::span<const RadialFace> faces, AxisDirection direction)
        : faces_(faces), direction_(direction), order_(faces.size()) {}

    // Face indices counter-clockwise around the direction.
    std::vector<std::uint32_t> sorted() {
        std::iota(order_.begin(), order_.end(), 0U);
        half_.resize(faces_.size());
        for (std::uint32_t i = 0; i < faces_.size(); ++i) half_[i] = half(i);
        std::sort(order_.begin(), order_.end(),
                  [this](std::uint32_t a, std::uint32_t b) { return before(a, b); });
        return std::move(order_);
    }

private:
    int sense(std::uint32_t a, std::uint32_t b) const {
        return faces_[a].along == faces_[b].along ? 1 : -1;
    }
    int cross(std::uint32_t a, std::uint32_t b) const {
        return sense(a, b) * direction_.sign *
               sign_of_cross(*faces_[a].plane, *faces_[b].plane, direction_.axis);
    }
    // 0 for angles in [0, pi) from face 0, 1 for [pi, 2 pi).
    int half(std::uint32_t i) const {
        if (i == 0) return 0;
        const int c = cross(0, i);
        if (c != 0) return c > 0 ? 0 : 1;
        return sense(0, i) * sign_of_dot(*faces_[0].plane, *faces_[i].plane) > 0 ? 0 : 1;
    }
    bool before(std::uint32_t a, std::uint32_t b) const {
        if (half_[a] != half_[b]) return half_[a] < half_[b];
        if (const int c = cross(a, b); c != 0) return c > 0;
        if (faces_[a].along != faces_[b].along) return faces_[a].along;
        return a < b;
    }

    std::span<const RadialFace> faces_;
    AxisDirection direction_;
    std::vector<std::uint32_t> order_;
    std::vector<int> half_;
};

// Where to start reading the circle so that no wedge is closed before it was opened.
std::size_t start_of_parentheses(std::span<const RadialFace> faces,
                                 std::span<const std::uint32_t> order) {
    int depth = 0;
    int lowest = 0;
    std::size_t start = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        depth += faces[order[i]].along ? -1 : 1;
        if (depth < lowest) {
            lowest = depth;
            start = i + 1;
        }
    }
    TRISECT_EXPECTS(depth == 0, "faces around an edge come in pairs of opposite sense");
    return start;
}

}  // namespace

AxisDirection direction_between(const Point& from, const Point& to) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto c = compare_coordinate(from, to, axis);
        if (c != 0) return {axis, c < 0 ? 1 : -1};
    }
    TRISECT_EXPECTS(false, "direction between equal points");
    return {};
}

std::vector<std::uint32_t> pair_across_inside(std::span<const RadialFace> faces,
                                              AxisDirection direction) {
    const std::vector<std::uint32_t> order = RadialSorter(faces, direction).sorted();
    const std::size_t start = start_of_parentheses(faces, order);
    std::vector<std::uint32_t> partner(faces.size());
    std::vector<std::uint32_t> open;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::uint32_t face = order[(start + i) % order.size()];
        if (!faces[face].along) {
            open.push_back(face);
            continue;
        }
        partner[face] = open.back();
        partner[open.back()] = face;
        open.pop_back();
    }
    return partner;
}

}  // namespace trisect
