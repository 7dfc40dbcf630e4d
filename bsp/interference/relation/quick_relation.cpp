// SPDX-License-Identifier: Apache-2.0
//
// Exact arithmetic is for what touches. Two solids that do not, or cross properly, are the common
// case, and making the exact relative pose alone would cost more than the whole answer in doubles.
//
// A vertex is moved in doubles, with an error e. If no oriented box of the other boundary comes
// within e of where it is put, the exact place is on the same side as the double one, which the
// other solid's index locates exactly. In units of the tree, p in floats: with reach r of the boxes
// and e' = e / unit, rounding p costs u |p|, the difference to a centre u (|p| + r), the product
// with an axis 3 u (|p| + r) and the exact place is √3 e' away: all below 2^-20 (|p| + r) + 2 e'.

#include <trisect/bsp/interference/relation/quick_relation.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/relation/boundary_flags.h>
#include <trisect/bsp/interference/relation/coincident_triangles.h>
#include <trisect/bsp/interference/relation/inside_balls.h>
#include <trisect/bsp/interference/relation/self_contact.h>

namespace trisect::detail {

namespace {

// Whether some box at a leaf is within the error of the point, as far as floats can decide.
bool is_near_boundary(const ObbTree& tree, const std::array<double, 3>& p, double error) {
    std::array<float, 3> x{};
    double size = tree.reach;
    for (std::size_t k = 0; k < 3; ++k) {
        const double c = (p[k] - tree.origin[k]) / tree.unit;
        x[k] = static_cast<float>(c);
        size += std::abs(c);
    }
    if (!(size < 1e30)) return true;
    const Float4 margin =
        all_lanes(static_cast<float>(0x1p-20 * size + 2.0001 * error / tree.unit));
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
        const ObbNode& n = tree.nodes[stack.back()];
        stack.pop_back();
        Mask4 away{};
        std::array<Float4, 3> d;
        for (std::size_t k = 0; k < 3; ++k) d[k] = all_lanes(x[k]) - n.center[k];
        for (std::size_t i = 0; i < 3; ++i)
            away |= magnitude((n.axis[i][0] * d[0] + n.axis[i][1] * d[1]) + n.axis[i][2] * d[2]) >
                    n.half[i] + margin;
        const unsigned near = ~bits_of(away) & 15U;
        for (std::uint32_t k = 0; k < 4; ++k) {
            if ((near >> k & 1U) == 0) continue;
            if (n.child[k].is_leaf()) return true;
            stack.push_back(n.child[k].node());
        }
    }
    return false;
}

}  // namespace

std::optional<bool> is_certainly_inside(const InterferenceModelData& model, VertexId v,
                                        const ApproximateMap& to_other,
                                        const InterferenceModelData& other) {
    const std::array<double, 3> x = to_other(model.position(v));
    const double error = to_other.error_below(model.largest, model.position_error);
    for (std::size_t k = 0; k < 3; ++k)
        if (x[k] - error > other.hi[k] || x[k] + error < other.lo[k]) return false;
    if (is_near_boundary(other.boxes, x, error)) return std::nullopt;
    std::array<double, 3> place{};
    for (std::size_t k = 0; k < 3; ++k) {
        place[k] = std::ldexp(x[k], other.brep.lattice().exponent);
        if (std::ldexp(place[k], -other.brep.lattice().exponent) != x[k]) return std::nullopt;
    }
    return other.model.index().locate(place).location == Location::Inside;
}

std::optional<Relation> relation_of_apart(const InterferenceModelData& a, const Pose& pose_a,
                                          const InterferenceModelData& b, const Pose& pose_b,
                                          const ApproximateMap& to_a) {
    const ApproximateMap to_b = approximate_map(pose_b, b.brep.lattice(), pose_a, a.brep.lattice());
    if (!to_b.is_usable()) return std::nullopt;
    BoundaryFlags flags;
    for (const VertexId v : a.shell_vertex) {
        const auto inside = is_certainly_inside(a, v, to_b, b);
        if (!inside) return std::nullopt;
        (*inside ? flags.a_in : flags.a_out) = true;
    }
    for (const VertexId v : b.shell_vertex) {
        const auto inside = is_certainly_inside(b, v, to_a, a);
        if (!inside) return std::nullopt;
        (*inside ? flags.b_in : flags.b_out) = true;
    }
    return flags.relation();
}

std::optional<Relation> quick_relation(const InterferenceModelData& a, const Pose& pose_a,
                                       const InterferenceModelData& b, const Pose& pose_b,
                                       ObbWalk::Stack& stack, WalkCounters* counters,
                                       CandidatePairs* candidates) {
    const ApproximateMap to_a = approximate_map(pose_a, a.brep.lattice(), pose_b, b.brep.lattice());
    if (!to_a.is_usable()) return std::nullopt;
    if (const InsideBalls* balls_a = a.balls_in_time())
        if (const InsideBalls* balls_b = b.balls_in_time())
            if (const auto r = relation_by_balls(a, *balls_a, b, *balls_b, to_a)) {
                if (counters != nullptr) ++counters->by_balls;
                return r;
            }
    // Pairs that doubles cannot decide are passed over: flush solids have many of them, and a
    // crossing elsewhere is Overlapping whatever they are.
    ObbWalk walk(a.boxed(), b.boxed(), to_a, stack);
    constexpr std::size_t many = 1024;
    TellingCrossings crossings(a, b, to_a);
    CandidatePairs uncertain;
    bool is_uncertain = false;
    const bool stopped = walk.run([&](std::uint32_t i, std::uint32_t j, PairVerdict verdict) {
        if (verdict == PairVerdict::Crossing && crossings.tells(i, j)) return true;
        is_uncertain = true;
        if (candidates == nullptr) return false;
        uncertain.pairs.push_back({i, j, verdict});
        if (uncertain.pairs.size() == many)
            uncertain.may_coincide = may_coincide(a, b, to_a, uncertain.pairs);
        return uncertain.may_coincide;
    });
    if (counters != nullptr) *counters += walk.counters();
    if (stopped && !uncertain.may_coincide) return Relation::Overlapping;
    if (is_uncertain) {
        uncertain.is_complete = !stopped;
        if (candidates != nullptr) *candidates = std::move(uncertain);
        return std::nullopt;
    }

    return relation_of_apart(a, pose_a, b, pose_b, to_a);
}

}  // namespace trisect::detail
