// SPDX-License-Identifier: Apache-2.0
//
// PairStructure: interface for candidate triangle pairs of two placed solids.
// Bounding volume hierarchies, partitions of space and tracked features implement it, so that the
// same exact test at the leaves (queries.h) makes the same answers of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/volume_outline.h>
#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/boxes/cost.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/pose.h>
#include <trisect/kernel/support/function_ref.h>

namespace trisect::hierarchies {

/// Of triangles by their numbers in the models (InterferenceModelData::triangles); true stops.
using PairVisit = FunctionRef<bool(std::uint32_t triangle_of_a, std::uint32_t triangle_of_b)>;
/// Returns the limit from now on, never above the one before.
using NearVisit = FunctionRef<double(std::uint32_t triangle_of_a, std::uint32_t triangle_of_b)>;

/// Where B is, seen from A: what structures work with.
///
/// Everything happens in lattice units of A. A vertex of B with position x (InterferenceModelData)
/// is within `b_error` of to_a(x) in each coordinate there, a vertex of A within its model's
/// `position_error` of its position.
struct Placement {
    detail::ApproximateMap to_a;
    double b_error = 0;
};

/// A structure over two models, which it keeps. For one thread.
///
/// Lifetime: built once, then placed and queried any number of times. Queries before the first
/// place() is answered for identical poses.
class PairStructure {
public:
    /// \throw UsageError when one of the models is empty: queries answer that without a structure.
    PairStructure(const InterferenceModel& a, const InterferenceModel& b);
    PairStructure(const PairStructure&) = delete;
    PairStructure& operator=(const PairStructure&) = delete;
    virtual ~PairStructure();

    /// As in StructureKind: "aabb", "kdop18", "octree", ...
    [[nodiscard]] virtual std::string_view name() const = 0;
    [[nodiscard]] virtual BuildReport build_report() const = 0;

    /// Brings the structure to new poses: refits, turns volumes, files moved triangles in cells.
    /// Counts `updates`. \throw LimitError when the poses are too wide for each other.
    void place(const Pose& a, const Pose& b, CostCounters& counters);

    /// B in another shape: the same triangles (deformation.h) with corners elsewhere. Refits what
    /// is there to them and is true, or leaves everything as it was and is false: the triangles are
    /// others, or this kind of structure has to be built anew. Poses are to be placed again. Counts
    /// `updates`. Only trees of volumes refit; answers stay exact, and trees become looser than new
    /// ones where parts that were near each other no longer are.
    bool deform_b(const InterferenceModel& b, CostCounters& counters);

    /// Visits every pair of triangles that has a common point, each pair at most once, and others
    /// that the structure cannot decide apart. Returns whether it was stopped. Counts
    /// `volume_tests`; what the pairs cost, the caller counts.
    bool candidates(PairVisit visit, CostCounters& counters);

    /// Visits every pair of triangles whose distance, in lattice units of A, is not above the limit
    /// that is current when it comes up. In any order; nearest first is best. A negative limit ends
    /// it. May be infinite.
    void near(double limit, NearVisit visit, CostCounters& counters);

    /// The relation, where the structure can prove it without comparing any triangles: partitions
    /// that distinguish inside from outside may. Costs a little where it cannot.
    [[nodiscard]] std::optional<Relation> early_relation(CostCounters& counters);

    /// Volumes of a tree's first levels, a parent before its children, in the user's units of A:
    /// around A, or around B as they are at the current pose. Of partitions the cells of A; B has
    /// none. None where the structure has neither, or doubles do not suffice for the pose. \pre
    /// place() was called
    [[nodiscard]] std::vector<VolumeOutline> outlines_of_a(unsigned levels);
    [[nodiscard]] std::vector<VolumeOutline> outlines_of_b(unsigned levels);

    [[nodiscard]] const InterferenceModel& model_a() const { return a_; }
    [[nodiscard]] const InterferenceModel& model_b() const { return b_; }
    [[nodiscard]] const Pose& pose_a() const { return pose_a_; }
    [[nodiscard]] const Pose& pose_b() const { return pose_b_; }
    /// Whether doubles suffice for these poses. Otherwise all pairs are visited and the structure
    /// is not used.
    [[nodiscard]] bool has_doubles() const { return placement_.to_a.is_usable(); }
    [[nodiscard]] const Placement& placement() const { return placement_; }

protected:
    /// \pre has_doubles(), for all three.
    virtual void update(CostCounters& counters) = 0;
    virtual bool find_candidates(PairVisit visit, CostCounters& counters) = 0;
    virtual void find_near(double limit, NearVisit visit, CostCounters& counters) = 0;
    /// B is the deformed model now, and triangle t has become now[t].
    virtual bool refit_b(std::span<const std::uint32_t> /*now*/, CostCounters& /*counters*/) {
        return false;
    }
    virtual std::optional<Relation> find_early_relation(CostCounters&) { return std::nullopt; }
    virtual std::vector<VolumeOutline> list_outlines(bool /*of_b*/, unsigned /*levels*/) {
        return {};
    }

    [[nodiscard]] const detail::InterferenceModelData& data_a() const {
        return trisect::detail::data_of(a_);
    }
    [[nodiscard]] const detail::InterferenceModelData& data_b() const {
        return trisect::detail::data_of(b_);
    }

private:
    InterferenceModel a_;
    InterferenceModel b_;
    Pose pose_a_;
    Pose pose_b_;
    Placement placement_;
    bool placed_ = false;
};

}  // namespace trisect::hierarchies
