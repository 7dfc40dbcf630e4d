// SPDX-License-Identifier: Apache-2.0
//
// What the formula says on both sides of a polygon of a leaf: winding numbers from exact traces.
#pragma once

#include <optional>
#include <vector>

#include <trisect/bsp/detail/leaf_work.h>
#include <trisect/bsp/detail/residual.h>
#include <trisect/bsp/detail/trace.h>

namespace trisect::detail {

/// The value of the formula just above and just below a polygon, in the sense of its support.
struct LeafSides {
    bool above = false;
    bool below = false;
    /// Such a polygon bounds the result.
    [[nodiscard]] bool differ() const { return above != below; }
};

/// Traces from the leaf's reference point, or from another one that it finds when segments from
/// there are degenerate.
class LeafWindings {
public:
    LeafWindings(LeafWork& work, SlotValues& values);

    /// Both sides of a part of an item which everything else is on one side of. `step`: how winding
    /// numbers change from below to above.
    [[nodiscard]] LeafSides sides_of(LeafIndex item, const WorkPolygon& part,
                                     const std::vector<int>& step);

private:
    [[nodiscard]] bool trace(const TraceTarget& target, PlaneId own_class, LeafIndex own_operand,
                             std::vector<int>& w);
    [[nodiscard]] bool formula_at(const std::vector<int>& windings);
    void next_reference();

    LeafWork& work_;
    SlotValues& values_;
    FinePoint reference_;
    Approximation reference_approximation_;
    std::vector<int> reference_windings_;
    int reference_attempt_ = 0;
};

}  // namespace trisect::detail
