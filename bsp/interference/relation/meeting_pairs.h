// SPDX-License-Identifier: Apache-2.0
//
// Intersecting triangle pairs of two posed models, and their consequences.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/boxes/moved_triangle_pair.h>
#include <trisect/bsp/interference/boxes/obb_walk.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/relation/boundary_flags.h>
#include <trisect/bsp/interference/relation/boundary_pairs.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect::detail {

struct MeetingPair {
    std::uint32_t a = 0;  ///< numbers of triangles
    std::uint32_t b = 0;
    TriangleContact contact;
};

/// Two models with their places.
struct PosedModels {
    const InterferenceModelData& a;
    const InterferenceModelData& b;
    PosedPair poses;
};

/// The smallest entity that a feature of a triangle is on; a diagonal is in its face. Of copies the
/// one with the smallest id.
[[nodiscard]] BoundaryEntity entity_of(const InterferenceModelData& model, std::uint32_t triangle,
                                       Feature feature);

/// Calls visit(i, j, verdict) for pairs of triangles that may meet, all that do among them, until
/// it returns true. Returns whether it was stopped. \pre neither model is empty
template <class Visit>
bool for_candidate_pairs(const PosedModels& models, Visit&& visit) {
    if (models.poses.to_a.has_doubles()) {
        ObbWalk::Stack stack;
        ObbWalk walk(models.a.boxed(), models.b.boxed(), approximate_map(models.poses.to_a), stack);
        return walk.run(visit);
    }
    // Beyond the range of doubles nothing is known before the exact tests.
    for (std::uint32_t i = 0; i < models.a.triangles.size(); ++i)
        for (std::uint32_t j = 0; j < models.b.triangles.size(); ++j)
            if (visit(i, j, PairVerdict::Unknown)) return true;
    return false;
}

/// What follows from pairs of triangles, one at a time, wherever they come from.
class MeetingCollector {
public:
    /// With `all` every pair that meets is noted; otherwise only until the relation is decided.
    MeetingCollector(const PosedModels& models, bool all)
        : models_(models), all_(all), test_(models.poses) {}

    /// Compares two triangles exactly, unless they cross and that is all that matters. Returns
    /// whether no more need to come.
    bool operator()(std::uint32_t a, std::uint32_t b, PairVerdict verdict);

    std::vector<MeetingPair> pairs;
    BoundaryFlags flags;

private:
    [[nodiscard]] bool tells(std::uint32_t a, std::uint32_t b) const;

    const PosedModels& models_;
    bool all_;
    TrianglePairTest test_;
};

/// All pairs of triangles that meet, and the flags that they set by themselves. Unless `all` is set
/// it stops when the relation is decided. In interference.cpp.
[[nodiscard]] std::vector<MeetingPair> meeting_pairs(const PosedModels& models, bool all,
                                                     BoundaryFlags& flags);

/// All contacts of entities, in ascending order.
[[nodiscard]] std::vector<Contact> contacts_of(const PosedModels& models,
                                               const std::vector<MeetingPair>& pairs);

/// The common points of the boundaries, joined into regions; coordinates in the world, into which
/// A's pose takes A.
[[nodiscard]] std::vector<ContactRegion> regions_of(const PosedModels& models,
                                                    const std::vector<MeetingPair>& pairs,
                                                    const Pose& pose_a);

/// The open segment between two neighbouring corners of an intersection is on the side that both
/// are on, or in the interior.
[[nodiscard]] Feature feature_between(Feature p, Feature q);

/// What the contact vertices say: at each the two cones are compared. Stops early when the relation
/// is decided.
void add_flags_at_contacts(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                           BoundaryFlags& flags);

/// What the shells say that meet nothing. Stops early when the relation is decided. In
/// interference.cpp.
void add_flags_of_shells(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                         BoundaryFlags& flags);

}  // namespace trisect::detail
