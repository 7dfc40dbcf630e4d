// SPDX-License-Identifier: Apache-2.0
//
// Leaf arrangement of any polygons.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/leaf/exact/leaf_anchors.h>
#include <trisect/bsp/leaf/exact/leaf_classification.h>
#include <trisect/bsp/leaf/exact/leaf_cutting.h>
#include <trisect/bsp/leaf/exact/leaf_links.h>
#include <trisect/bsp/leaf/exact/leaf_pairs.h>
#include <trisect/bsp/leaf/exact/leaf_windings.h>
#include <trisect/bsp/leaf/leaf_arrangement.h>
#include <trisect/bsp/leaf/leaf_formula.h>
#include <trisect/bsp/leaf/leaf_work.h>

namespace trisect::detail {

/// Cuts and classifies polygons by the names of their planes, on integers. It serves every leaf.
class ExactLeaf final : public LeafArrangement {
private:
    [[nodiscard]] std::optional<LeafResult> try_to_arrange(const LeafProblem& problem,
                                                           LeafFindings& findings) override;
    void arrange_embedded();
    void arrange_any();
    void emit_remains(LeafIndex i, const LeafRemains& remains);
    void emit_all();
    void emit_pieces(LeafIndex i, std::size_t first, std::size_t last);
    void emit(const PolygonRef& ref, bool inside_above);

    LeafWork work_;
    LeafPairs pairs_;
    LeafLinks links_;
    LeafClassification classes_;
    LeafWindings windings_;
    LeafAnchors anchors_;
    LeafCutting cutting_;
    LeafFormula formula_;
    bool may_cross_straight_ = false;
    std::vector<bool> has_common_lines_;  // by item; see make_pieces
    std::vector<std::pair<const WorkPolygon*, LeafSides>> kept_;
};

}  // namespace trisect::detail
