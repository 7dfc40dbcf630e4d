// SPDX-License-Identifier: Apache-2.0
//
// ObbWalk: possibly intersecting triangle pairs, by simultaneous traversal of two trees.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/boxes/obb_pose.h>
#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/bsp/interference/boxes/triangle_filter.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

/// What a walk did: N_bv and N_p of the cost function F = N_bv C_bv + N_p C_p.
struct WalkCounters {
    std::uint64_t node_tests = 0;      ///< tests of one box against four
    std::uint64_t triangle_pairs = 0;  ///< pairs of triangles compared in doubles
    std::uint64_t apart = 0;           ///< of these certainly apart,
    std::uint64_t crossing = 0;        ///< certainly crossing,
    std::uint64_t unknown = 0;         ///< left to exact tests
    std::uint64_t by_balls = 0;        ///< questions that balls inside both solids decided
    std::uint64_t plane_tests = 0;     ///< tests of a box against four by planes that were kept

    WalkCounters& operator+=(const WalkCounters& o) {
        node_tests += o.node_tests;
        triangle_pairs += o.triangle_pairs;
        apart += o.apart;
        crossing += o.crossing;
        unknown += o.unknown;
        by_balls += o.by_balls;
        plane_tests += o.plane_tests;
        return *this;
    }
};

class ObbWalk {
public:
    struct Pair {
        ObbId a;
        ObbId b;
    };
    using Stack = std::vector<Pair>;

    /// \pre both trees have boxes. The stack is scratch memory that the caller may keep.
    ObbWalk(const BoxedTriangles& a, const BoxedTriangles& b, const ApproximateMap& b_to_a,
            Stack& stack)
        : a_(a),
          b_(b),
          map_(b_to_a),
          pose_(*a.tree, *b.tree, b_to_a),
          error_(a.position_error + b_to_a.error_below(b.largest, b.position_error)),
          stack_(stack) {}

    /// visit(triangle of a, triangle of b, verdict) for every pair that is not certainly apart;
    /// stops when it returns true. Returns whether it was stopped.
    template <class Visit>
    bool run(Visit&& visit) {
        stack_.clear();
        if (pose_.is_apart()) return false;
        ++counters_.node_tests;
        if ((pose_.overlaps(a_.tree->box(ObbId{}), b_.tree->nodes[0]) & 1U) == 0) return false;
        stack_.push_back({});
        while (!stack_.empty()) {
            const Pair pair = stack_.back();
            stack_.pop_back();
            const bool leaf_a = a_.tree->is_leaf(pair.a);
            const bool leaf_b = b_.tree->is_leaf(pair.b);
            if (leaf_a && leaf_b) {
                if (compare_leaves(a_.tree->child(pair.a), b_.tree->child(pair.b), visit))
                    return true;
            } else if (leaf_a || (!leaf_b && b_is_larger(pair))) {
                check_stop();
                ++counters_.node_tests;
                const std::uint32_t node = b_.tree->child(pair.b).node();
                const unsigned hits = pose_.overlaps(a_.tree->box(pair.a), b_.tree->nodes[node]);
                for (std::uint32_t k = 0; k < 4; ++k)
                    if ((hits >> k & 1U) != 0) stack_.push_back({pair.a, ObbId::of(node, k)});
            } else {
                check_stop();
                ++counters_.node_tests;
                const std::uint32_t node = a_.tree->child(pair.a).node();
                const unsigned hits = pose_.overlaps(a_.tree->nodes[node], b_.tree->box(pair.b));
                for (std::uint32_t k = 0; k < 4; ++k)
                    if ((hits >> k & 1U) != 0) stack_.push_back({ObbId::of(node, k), pair.b});
            }
        }
        return false;
    }

    [[nodiscard]] const WalkCounters& counters() const { return counters_; }

private:
    [[nodiscard]] bool b_is_larger(const Pair& p) const {
        const auto size = [](const ObbTree& t, ObbId id) {
            const ObbNode& n = t.nodes[id.node()];
            return n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()];
        };
        return pose_.scale() * size(*b_.tree, p.b) > size(*a_.tree, p.a);
    }

    template <class Visit>
    bool compare_leaves(ObbChild ca, ObbChild cb, Visit& visit) {
        for (std::uint32_t j = 0; j < cb.count(); ++j) {
            TriangleCorners q;
            for (std::size_t i = 0; i < 3; ++i)
                q[i] = map_((*b_.positions)[b_.tree->corners[cb.first() + j][i]]);
            for (std::uint32_t k = 0; k < ca.count(); ++k) {
                TriangleCorners p;
                for (std::size_t i = 0; i < 3; ++i)
                    p[i] = (*a_.positions)[a_.tree->corners[ca.first() + k][i]];
                ++counters_.triangle_pairs;
                const PairVerdict verdict = compare_triangles(p, q, error_);
                if (verdict == PairVerdict::Apart) {
                    ++counters_.apart;
                    continue;
                }
                ++(verdict == PairVerdict::Crossing ? counters_.crossing : counters_.unknown);
                if (visit(a_.tree->order[ca.first() + k], b_.tree->order[cb.first() + j], verdict))
                    return true;
            }
        }
        return false;
    }

    BoxedTriangles a_;
    BoxedTriangles b_;
    ApproximateMap map_;
    ObbPose pose_;
    double error_;
    Stack& stack_;
    WalkCounters counters_;
};

}  // namespace trisect::detail
