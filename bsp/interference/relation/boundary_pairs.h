// SPDX-License-Identifier: Apache-2.0
//
// BoundaryPairs: the exactly intersecting triangle pairs of two posed models.
#pragma once

#include <cstdint>
#include <optional>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/boxes/moved_triangle_pair.h>
#include <trisect/bsp/interference/boxes/obb_walk.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/pose.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect::detail {

/// Two models in two poses. The exact relative pose is made when doubles cannot decide something,
/// which in general position never happens. For one thread; models and poses must outlive it.
class BoundaryPairs {
public:
    /// \pre both models have triangles. The stack is scratch memory that the caller may keep.
    BoundaryPairs(const InterferenceModelData& a, const Pose& pose_a,
                  const InterferenceModelData& b, const Pose& pose_b, ObbWalk::Stack& stack);

    /// A pair of triangles that meet.
    struct Meeting {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
        bool crossing = false;  ///< known to cross; others may
    };
    /// Some pair of triangles that meet, if there is one; crossing ones are found by doubles alone.
    [[nodiscard]] std::optional<Meeting> any();
    /// visit(meeting) for all pairs that meet, each once, until it returns true. Those that doubles
    /// find crossing are not looked at more closely. Returns whether it was stopped.
    template <class Visit>
    bool all(Visit&& visit) {
        ObbWalk walk(a_->boxed(), b_->boxed(), map_, *stack_);
        const bool stopped = walk.run([&](std::uint32_t i, std::uint32_t j, PairVerdict verdict) {
            if (verdict == PairVerdict::Crossing) return visit(Meeting{i, j, true});
            const TriangleContact contact = exact(i, j);
            return contact.meets() && visit(Meeting{i, j, contact.crossing});
        });
        counters_ += walk.counters();
        return stopped;
    }

    /// The exact contact of two triangles, by their numbers in the models.
    [[nodiscard]] TriangleContact exact(std::uint32_t a, std::uint32_t b);
    /// Made at the first call. \throw LimitError when its numbers do not fit.
    [[nodiscard]] const PosedPair& poses();
    [[nodiscard]] const ApproximateMap& map() const { return map_; }
    /// Of all walks so far.
    [[nodiscard]] const WalkCounters& counters() const { return counters_; }

private:
    const InterferenceModelData* a_;
    const InterferenceModelData* b_;
    const Pose* pose_a_;
    const Pose* pose_b_;
    ObbWalk::Stack* stack_;
    ApproximateMap map_;
    std::optional<PosedPair> poses_;
    std::optional<TrianglePairTest> test_;
    WalkCounters counters_;
};

[[nodiscard]] PosedTriangle posed_triangle(const InterferenceModelData& m, std::uint32_t triangle);

}  // namespace trisect::detail
