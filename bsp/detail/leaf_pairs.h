// SPDX-License-Identifier: Apache-2.0
//
// Pairs of polygons of a leaf: which of them cut, cover or merely touch each other.
#pragma once

#include <trisect/bsp/detail/leaf_work.h>

namespace trisect::detail {

/// Compares the polygons whose boxes meet and that are not of one embedded operand. Fills in
/// `cutters`, `covers` and `touched` of the items and declares planes the same that are.
class LeafPairs {
public:
    explicit LeafPairs(LeafWork& work) : work_(work) {}
    void relate_all();

private:
    void relate(LeafIndex s, LeafIndex t);
    void relate_coplanar(LeafIndex s, LeafIndex t);
    [[nodiscard]] bool separated_by_edges_of(LeafIndex s, LeafIndex t);

    LeafWork& work_;
};

}  // namespace trisect::detail
