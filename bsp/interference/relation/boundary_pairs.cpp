// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/relation/boundary_pairs.h>

#include <vector>

namespace trisect::detail {

PosedTriangle posed_triangle(const InterferenceModelData& m, std::uint32_t triangle) {
    const ModelTriangle& t = m.triangles[triangle];
    PosedTriangle r;
    for (std::size_t i = 0; i < 3; ++i) r.corner[i] = &m.brep.point(t.vertex[i]);
    r.plane = &m.brep.plane(t.face);
    return r;
}

BoundaryPairs::BoundaryPairs(const InterferenceModelData& a, const Pose& pose_a,
                             const InterferenceModelData& b, const Pose& pose_b,
                             ObbWalk::Stack& stack)
    : a_(&a),
      b_(&b),
      pose_a_(&pose_a),
      pose_b_(&pose_b),
      stack_(&stack),
      map_(approximate_map(pose_a, a.brep.lattice(), pose_b, b.brep.lattice())) {
    if (!map_.is_usable() && poses().to_a.has_doubles()) map_ = approximate_map(poses().to_a);
}

const PosedPair& BoundaryPairs::poses() {
    if (!poses_) poses_.emplace(*pose_a_, a_->brep.lattice(), *pose_b_, b_->brep.lattice());
    return *poses_;
}

TriangleContact BoundaryPairs::exact(std::uint32_t a, std::uint32_t b) {
    if (!test_) test_.emplace(poses());
    return (*test_)(posed_triangle(*a_, a), posed_triangle(*b_, b));
}

std::optional<BoundaryPairs::Meeting> BoundaryPairs::any() {
    std::optional<Meeting> found;
    // What doubles cannot decide waits a while: a crossing may make it superfluous.
    constexpr std::size_t patience = 32;
    std::vector<Meeting> unknown;
    const auto ask = [&] {
        for (std::size_t k = 0; k < unknown.size() && !found; ++k) {
            const TriangleContact contact = exact(unknown[k].a, unknown[k].b);
            if (contact.meets()) found = Meeting{unknown[k].a, unknown[k].b, contact.crossing};
        }
        unknown.clear();
        return found.has_value();
    };
    ObbWalk walk(a_->boxed(), b_->boxed(), map_, *stack_);
    const bool stopped = walk.run([&](std::uint32_t i, std::uint32_t j, PairVerdict verdict) {
        if (verdict == PairVerdict::Crossing) {
            found = Meeting{i, j, true};
            return true;
        }
        unknown.push_back({i, j, false});
        return unknown.size() == patience && ask();
    });
    counters_ += walk.counters();
    if (!stopped) (void)ask();
    return found;
}

}  // namespace trisect::detail
