// SPDX-License-Identifier: Apache-2.0
//
// Patches: untouched facets of a leaf that have the same on either side.
#pragma once

#include <vector>

#include <trisect/bsp/detail/flat_map.h>
#include <trisect/bsp/detail/leaf_work.h>

namespace trisect::detail {

/// Untouched whole facets of one operand that share an edge with an end in the cell lie in one
/// patch: nothing else comes near that edge, so both have the same on either side. Where a boundary
/// that may meet itself has more than two facets at an edge, they are different sheets.
class LeafPatches {
public:
    /// \pre pairs were related.
    explicit LeafPatches(const LeafWork& work);

    [[nodiscard]] LeafIndex patch_of(LeafIndex item);
    /// One of the patch's facets that lies in the cell, -1 when there is none.
    [[nodiscard]] LeafIndex facet_within_cell(LeafIndex patch) const {
        return within_cell_[LeafWork::u(patch)];
    }

private:
    struct EdgeUsers {
        std::array<LeafIndex, 2> item{};
        LeafIndex count = 0;
    };
    [[nodiscard]] bool edge_ends_in_cell(const LeafItem& item, int k) const;
    [[nodiscard]] static Key128 edge_key(const LeafItem& item, int k);

    const LeafWork& work_;
    FlatMap edge_ids_;
    std::vector<EdgeUsers> edge_users_;
    std::vector<LeafIndex> patch_;
    std::vector<LeafIndex> within_cell_;
};

}  // namespace trisect::detail
