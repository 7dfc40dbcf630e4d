// SPDX-License-Identifier: Apache-2.0
//
// Pairs of polygons of a leaf: which of them cut, cover or merely touch each other.
#pragma once

#include <utility>
#include <vector>

#include <trisect/bsp/detail/leaf_work.h>

namespace trisect::detail {

/// Compares the polygons whose boxes meet and that are not of one embedded operand. Finds their
/// contacts, fills in `cut` and `covered`, and declares planes the same that are.
///
/// Candidates come from a sweep along the axis on which the boxes are shortest; then the supports
/// separate most of them exactly, with signs that the filter decides. Scratch memory that is kept
/// from leaf to leaf.
class LeafPairs {
public:
    void relate_all(LeafWork& work);

private:
    struct Span {
        std::int64_t lo;
        std::int64_t hi;
        LeafIndex item;
        bool skips_own;  // of an embedded operand
    };
    void list_candidates(const LeafWork& work);
    [[nodiscard]] int best_axis(const LeafWork& work) const;
    void sweep(LeafWork& work, int axis);

    std::vector<Box> operand_boxes_;
    std::vector<Span> spans_;
    std::vector<std::pair<LeafIndex, LeafContact>> contacts_;
};

}  // namespace trisect::detail
