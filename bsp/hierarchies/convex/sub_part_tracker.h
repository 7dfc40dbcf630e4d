// SPDX-License-Identifier: Apache-2.0
//
// SubPartTracker: distance of two boundaries from closest features of hulls.
// Concavities are opened only where a closest feature is on a face that closes one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/hierarchies/convex/common_frame.h>
#include <trisect/bsp/hierarchies/convex/feature_walk.h>
#include <trisect/bsp/hierarchies/convex/hull_tree.h>
#include <trisect/bsp/hierarchies/convex/walk_memory.h>
#include <trisect/kernel/pose.h>

namespace trisect::hierarchies {

/// What a tracker did at a pose.
struct SubPartCounts {
    WalkCounts walks;
    std::uint64_t accepted = 0;  ///< pairs of hulls above leaves that were an answer by themselves
    std::uint64_t opened = 0;    ///< pairs of hulls that were not, and were replaced by children
};

/// Over two trees of hulls with one triangle a leaf. Hulls that are apart and whose closest
/// features are boundary are as far apart as the boundaries in them, so they are not opened; hulls
/// that meet in features that are boundary meet there. Otherwise that hull is opened whose feature
/// bridges a concavity.
///
/// Exact. For one thread; trees must outlive it. Starts from the features of the last pose.
/// Source: Ponamgi, Manocha, Lin (TVCG 3(1), 1997); the tree is that of Ehmann and Lin (2001).
class SubPartTracker {
public:
    /// \throw UsageError for leaves of more than one triangle, UnsupportedError for models whose
    /// vertices are not all lattice points: their hulls are larger than what they contain.
    SubPartTracker(const InterferenceModel& model_a, const HullTree& a,
                   const InterferenceModel& model_b, const HullTree& b);

    /// Finds the closest pairs of hulls. \throw nothing but std::bad_alloc: any poses will do.
    void update(const Pose& a, const Pose& b);

    /// Whether the boundaries have a common point.
    [[nodiscard]] bool meet() const { return meet_; }
    /// lower <= distance of the boundaries <= upper, in the user's units.
    [[nodiscard]] FeatureWalk::Bounds bounds() const { return bounds_; }
    /// Exactly; 0 when they meet.
    [[nodiscard]] ExactRational squared_distance();
    /// Of the last update.
    [[nodiscard]] const SubPartCounts& counts() const { return counts_; }

private:
    struct Entry {
        double least;
        std::uint32_t a;
        std::uint32_t b;
        bool open_a;  // the feature of A bridges a concavity
        bool open_b;
    };
    void visit(std::uint32_t a, std::uint32_t b, double parent);
    void open(const Entry& e);

    const HullTree* a_;
    const HullTree* b_;
    Lattice lattice_a_;
    Lattice lattice_b_;
    CommonFrame frame_;
    WalkMemory memory_;
    std::vector<Entry> heap_;
    std::vector<Entry> nearest_;  // pairs that may be the closest
    FeatureWalk::Bounds bounds_;
    bool meet_ = false;
    SubPartCounts counts_;
};

}  // namespace trisect::hierarchies
