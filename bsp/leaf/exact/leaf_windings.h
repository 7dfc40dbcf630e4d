// SPDX-License-Identifier: Apache-2.0
//
// Winding numbers in a leaf from exact traces.
#pragma once

#include <vector>

#include <trisect/bsp/cells/trace/trace.h>
#include <trisect/bsp/leaf/leaf_work.h>

namespace trisect::detail {

/// Traces from the leaf's reference point, or from another one that it finds when segments from
/// there are degenerate. Costs one pass over the boxes of the leaf's items.
class LeafWindings {
public:
    /// Before the first trace of a leaf.
    void start(LeafWork& work);

    /// Winding numbers just above a part of an item which everything else is on one side of. Those
    /// of operands with `known[o]` are left as they are. `step`: how they change from above to
    /// below. Returns where in the part that was.
    Approximation windings_above(LeafIndex item, const WorkPolygon& part,
                                 const std::vector<int>& step, const std::vector<char>& known,
                                 std::vector<int>& windings);

    /// Winding numbers at a point, with a meaningless one for `own`. False when the segment to it
    /// is degenerate or it lies on the surface of another operand.
    [[nodiscard]] bool at_point(const TraceTarget& target, LeafIndex own, std::vector<int>& w);
    /// Moves to another reference point; with luck, segments from there are not degenerate.
    void next_reference();

private:
    [[nodiscard]] bool trace(const TraceTarget& target, PlaneId own_class,
                             const std::vector<char>& known, std::vector<int>& w);

    LeafWork* work_ = nullptr;
    FinePoint reference_;
    Approximation reference_approximation_;
    std::vector<int> reference_windings_;
    std::vector<int> traced_;
    std::vector<char> own_;
    int reference_attempt_ = 0;
};

/// The barycentre of three well-separated corners of a part.
[[nodiscard]] TraceTarget middle_of(const Workbench& bench, const WorkPolygon& part);

}  // namespace trisect::detail
